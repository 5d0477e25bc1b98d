//! Closed loops of walls and gates.

use crate::graph::{Stretch, WallPiece};
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::{ClosestPoint, Curve, cross};

/// A crossing between two stretches of wall on a loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// The gate.
    pub(crate) gate: GateId,
    /// Start of its chord in m, the end of the stretch of wall before it.
    pub(crate) from: Vec2,
    /// End of its chord in m.
    pub(crate) to: Vec2,
}

/// The type of a crossing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum GateId {
    /// A throat of the network, from its first (0) or second (1) region.
    Throat(u32, u8),
    /// An opening of an open side.
    Opening(u32),
    /// A segment that divides a region, with the number of its side.
    Segment(u32, u8),
}

impl GateId {
    /// Numbers a segment, one of a region by itself so far, from `first` on.
    pub(super) fn number_from(&mut self, first: usize) {
        if let Self::Segment(segment, _) = self {
            *segment += first as u32;
        }
    }
}

/// A closed loop: each stretch of wall is followed by a crossing; the pore lies on the right.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Loop {
    /// Stretches of wall; one is empty where two crossings share a point.
    pub(crate) walls: Vec<Stretch>,
    /// As many crossings, each after the stretch of the same number.
    pub(crate) crossings: Vec<Crossing>,
    /// Openings along whole sides without walls.
    pub(crate) apart: Vec<Crossing>,
    /// Whether somewhere a curve does not begin at the end of the previous one, as around a periodic domain.
    pub(crate) has_seam: bool,
}

/// A point of a stretch of wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct WallPoint {
    pub(crate) piece: usize,
    pub(crate) u: f64,
    pub(crate) point: Vec2,
}

impl WallPoint {
    pub(super) fn of(piece: usize, at: ClosestPoint) -> Self {
        Self { piece, u: at.u, point: at.point }
    }
}

impl Loop {
    /// Shift of the wall before crossing `k` so that it ends there: a whole period at the seam of a loop around a periodic domain, else zero.
    pub(crate) fn wall_before(&self, k: usize) -> Vec2 {
        let end = self.walls[k].last().map(|piece| piece.curve.point(1.0));
        self.seam(end, self.crossings[k].from)
    }

    /// The same for the wall after crossing `k`.
    pub(crate) fn wall_after(&self, k: usize) -> Vec2 {
        let start = self.walls[(k + 1) % self.walls.len()].first().map(|piece| piece.curve.point(0.0));
        self.seam(start, self.crossings[k].to)
    }

    fn seam(&self, end: Option<Vec2>, crossing: Vec2) -> Vec2 {
        if !self.has_seam {
            return Vec2::zeros();
        }
        const ROUNDING: f64 = 1e-6;
        let chord = |c: &Crossing| (c.to - c.from).norm();
        let shortest = self.crossings.iter().map(chord).filter(|&length| length > 0.0).fold(f64::INFINITY, f64::min);
        end.map(|end| crossing - end).filter(|gap| gap.norm() > ROUNDING * shortest).unwrap_or_default()
    }

    /// All curves of the loop in order, including chords and straight connections across the seam of a region around a periodic domain.
    pub(crate) fn curves(&self) -> Vec<Curve> {
        self.connected().0
    }

    /// The curves of the loop, and whether it has a seam.
    pub(crate) fn connected(&self) -> (Vec<Curve>, bool) {
        const ROUNDING: f64 = 1e-9;
        let mut curves: Vec<Curve> = Vec::new();
        let mut has_seam = false;
        let mut length = 0.0;
        let mut ends: Option<[Vec2; 2]> = None;
        let mut add = |curve: Curve| {
            let (start, end) = (curve.point(0.0), curve.point(1.0));
            length += curve.length();
            if let Some([_, last]) = ends
                && (start - last).norm() > ROUNDING * length
            {
                curves.push(Curve::Segment { a: last, b: start });
                has_seam = true;
            }
            curves.push(curve);
            ends = Some([ends.map_or(start, |[first, _]| first), end]);
        };
        for (k, wall) in self.walls.iter().enumerate() {
            wall.iter().for_each(|piece| add(piece.curve));
            if let Some(chord) = self.crossings.get(k).map(|c| Curve::Segment { a: c.from, b: c.to })
                && chord.length() > 0.0
            {
                add(chord);
            }
        }
        if let Some([first, last]) = ends
            && (first - last).norm() > ROUNDING * length
        {
            curves.push(Curve::Segment { a: last, b: first });
            has_seam = true;
        }
        (curves, has_seam)
    }

    /// Area in m², closed form (Green).
    pub(crate) fn area(&self) -> f64 {
        let curves = self.curves();
        let Some(origin) = curves.first().map(|curve| curve.point(0.0)) else { return 0.0 };
        -curves.iter().map(|curve| curve.area_about(origin)).sum::<f64>()
    }

    /// The same without spare memory.
    pub(super) fn fitted(mut self) -> Self {
        self.walls.shrink_to_fit();
        self.crossings.shrink_to_fit();
        self
    }

    /// The two parts of the loop on both sides of a segment from a point of wall `a` to one of wall `b`.
    pub(super) fn cut(&self, (a, p): (usize, WallPoint), (b, q): (usize, WallPoint), segment: usize) -> [Self; 2] {
        let count = self.walls.len();
        // From the point on wall `from` around to the point on wall `to`, and back along the segment.
        let part = |(from, start): (usize, WallPoint), (to, end): (usize, WallPoint), side: u8| {
            let mut part = Self::default();
            let mut k = from;
            while k != to {
                let wall = &self.walls[k];
                part.walls.push(if k == from { after(wall, start) } else { wall.clone() });
                part.crossings.push(self.crossings[k]);
                k = (k + 1) % count;
            }
            part.walls.push(before(&self.walls[to], end));
            part.crossings.push(Crossing {
                gate: GateId::Segment(segment as u32, side),
                from: end.point,
                to: start.point,
            });
            part.fitted()
        };
        [part((a, p), (b, q), 0), part((b, q), (a, p), 1)]
    }
}

/// A stretch of wall up to a point.
pub(super) fn before(wall: &[WallPiece], end: WallPoint) -> Stretch {
    let mut kept = wall[..end.piece].to_vec();
    if end.u > 0.0 {
        kept.push(WallPiece { curve: wall[end.piece].curve.part(0.0, end.u), ..wall[end.piece] });
    }
    kept.into()
}

/// A stretch of wall from a point on.
pub(super) fn after(wall: &[WallPiece], start: WallPoint) -> Stretch {
    let mut kept = Vec::new();
    if start.u < 1.0 {
        kept.push(WallPiece { curve: wall[start.piece].curve.part(start.u, 1.0), ..wall[start.piece] });
    }
    kept.extend_from_slice(&wall[start.piece + 1..]);
    kept.into()
}

/// Whether the wall turns away from the pore by more than rounding where two of its pieces meet (a concave corner of the wall turns
/// towards the pore), by the sine of the turning angle, positive to the left.
pub(super) fn turn(one: &Curve, next: &Curve) -> f64 {
    let (t, s) = (one.tangent(1.0), next.tangent(0.0));
    cross(t, s).atan2(t.dot(&s))
}
