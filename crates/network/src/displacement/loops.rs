//! Closed loops of walls and gates, and the division of loops between more than three walls.
//!
//! A meniscus that advances through a gate moves along two walls and may touch a third one. For each such event to have its own element, a pore region with
//! more than three stretches of wall on its loop is divided by the shortest segments from wall to wall inside it (for discs mostly the Delaunay edges of
//! neighbors without a throat), until each part has three stretches of wall or no segment is left. The parts tile the region.

use crate::graph::WallPiece;
use meniscus_core::math::Vec2;
use meniscus_geometry::closest::closest_points as closest;
use meniscus_geometry::curve::{ClosestPoint, Curve, cross};
use meniscus_geometry::intersect::intersections;

/// Relative tolerance of equal lengths.
const SAME_LENGTH: f64 = 1e-9;

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
    Throat(usize, usize),
    /// An opening of an open side.
    Opening(usize),
    /// A segment that divides a region, with the number of its side.
    Segment(usize, usize),
}

/// A closed loop: each stretch of wall is followed by a crossing; the pore lies on the right.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Loop {
    /// Stretches of wall; one is empty where two crossings share a point.
    pub(crate) walls: Vec<Vec<WallPiece>>,
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
    fn of(piece: usize, at: ClosestPoint) -> Self {
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

    /// The two parts of the loop on both sides of the shortest dividing segment; `None` if there is none. Segments of equal length that cross
    /// each other, as the diagonals of a square array, are not used.
    fn divided(&self, segment: usize) -> Option<[Self; 2]> {
        let count = self.walls.len();
        let mut candidates: Vec<(f64, usize, usize, WallPoint, WallPoint)> = Vec::new();
        for a in 0..count {
            for b in a + 2..count {
                if a == 0 && b == count - 1 {
                    continue;
                }
                if let Some((p, q)) = closest_points(&self.walls[a], &self.walls[b]) {
                    candidates.push(((p.point - q.point).norm(), a, b, p, q));
                }
            }
        }
        candidates.sort_by(|x, y| x.0.total_cmp(&y.0).then((x.1, x.2).cmp(&(y.1, y.2))));
        let curves = self.curves();
        let mut left =
            candidates.into_iter().filter(|(_, _, _, p, q)| holds_segment(&curves, p.point, q.point)).peekable();
        while let Some(shortest) = left.next() {
            let mut equal = vec![shortest];
            equal.extend(std::iter::from_fn(|| left.next_if(|next| next.0 <= shortest.0 * (1.0 + SAME_LENGTH))));
            let ends = |it: &(f64, usize, usize, WallPoint, WallPoint)| [it.3.point, it.4.point];
            let is_free = |one: &&_| equal.iter().all(|other| !do_cross(ends(one), ends(other)));
            if let Some(&(_, a, b, p, q)) = equal.iter().find(is_free) {
                return Some(self.cut((a, p), (b, q), segment));
            }
        }
        None
    }

    fn cut(&self, (a, p): (usize, WallPoint), (b, q): (usize, WallPoint), segment: usize) -> [Self; 2] {
        let count = self.walls.len();
        // From the point on wall `from` around to the point on wall `to`, and back along the segment.
        let part = |(from, start): (usize, WallPoint), (to, end): (usize, WallPoint), side: usize| {
            let mut part = Self::default();
            let mut k = from;
            while k != to {
                let wall = &self.walls[k];
                part.walls.push(if k == from { after(wall, start) } else { wall.clone() });
                part.crossings.push(self.crossings[k]);
                k = (k + 1) % count;
            }
            part.walls.push(before(&self.walls[to], end));
            part.crossings.push(Crossing { gate: GateId::Segment(segment, side), from: end.point, to: start.point });
            part
        };
        [part((a, p), (b, q), 0), part((b, q), (a, p), 1)]
    }
}

/// Whether two segments cross each other strictly between their ends.
fn do_cross([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    let slack = SAME_LENGTH * (b - a).norm() * (d - c).norm();
    let are_apart = |one: f64, other: f64| one.min(other) < -slack && one.max(other) > slack;
    are_apart(cross(b - a, c - a), cross(b - a, d - a)) && are_apart(cross(d - c, a - c), cross(d - c, b - c))
}

/// Whether the segment between two points on the walls of a loop lies inside it without meeting any of its curves in between.
pub(super) fn holds_segment(curves: &[Curve], p: Vec2, q: Vec2) -> bool {
    // Fraction of the segment at both ends that may meet its own walls.
    const AT_ENDS: f64 = 1e-6;
    let segment = Curve::Segment { a: p, b: q };
    let length = segment.length();
    if !(length > 0.0) {
        return false;
    }
    let mut parameters = Vec::new();
    for curve in curves {
        intersections(&segment, curve, 1e-9 * length, &mut parameters);
    }
    let middle = 0.5 * (p + q);
    // The pore lies on the right of the loop.
    let winding: f64 = curves.iter().map(|curve| curve.winding(middle)).sum();
    parameters.iter().all(|&u| !(AT_ENDS..=1.0 - AT_ENDS).contains(&u)) && winding < -std::f64::consts::PI
}

/// Divides a loop until each part has at most three stretches of wall or no dividing segment is left. Segments are numbered from
/// `segments` on, which is advanced.
pub(super) fn divide(whole: Loop, segments: &mut usize) -> Vec<Loop> {
    // The position of the seam is arbitrary, and segments must not depend on it.
    if whole.has_seam {
        return vec![whole];
    }
    // Around the grains of a domain whose sides are all open: no segment has the loop around it.
    if whole.area() < 0.0 {
        return vec![whole];
    }
    let (mut open, mut done) = (vec![whole], Vec::new());
    while let Some(part) = open.pop() {
        match if part.walls.len() > 3 { part.divided(*segments) } else { None } {
            Some(parts) => {
                *segments += 1;
                open.extend(parts);
            }
            None => done.push(part),
        }
    }
    done
}

pub(super) fn before(wall: &[WallPiece], end: WallPoint) -> Vec<WallPiece> {
    let mut kept = wall[..end.piece].to_vec();
    if end.u > 0.0 {
        kept.push(WallPiece { curve: wall[end.piece].curve.part(0.0, end.u), ..wall[end.piece] });
    }
    kept
}

pub(super) fn after(wall: &[WallPiece], start: WallPoint) -> Vec<WallPiece> {
    let mut kept = Vec::new();
    if start.u < 1.0 {
        kept.push(WallPiece { curve: wall[start.piece].curve.part(start.u, 1.0), ..wall[start.piece] });
    }
    kept.extend_from_slice(&wall[start.piece + 1..]);
    kept
}

fn project(wall: &[WallPiece], x: Vec2) -> Option<WallPoint> {
    let closest = wall.iter().enumerate().map(|(piece, wall)| (piece, wall.curve.project(x)));
    let distance = |point: Vec2| (point - x).norm_squared();
    let found = closest.min_by(|a, b| distance(a.1.point).total_cmp(&distance(b.1.point)));
    found.map(|(piece, closest)| WallPoint::of(piece, closest))
}

/// Number of points, of two, that are ends of their pieces.
fn ends(one: &WallPoint, other: &WallPoint) -> usize {
    // On an arc points as near to its end as this are as near to a facing wall, within rounding of distances.
    const AT_END: f64 = 1e-4;
    [one, other].into_iter().filter(|it| !(AT_END..=1.0 - AT_END).contains(&it.u)).count()
}

/// The closest points of two stretches of wall.
fn closest_points(one: &[WallPiece], other: &[WallPiece]) -> Option<(WallPoint, WallPoint)> {
    // Number of pairs of pieces up to which all are tried.
    const FEW: usize = 256;
    if one.len() * other.len() > FEW {
        return closest_of_many(one, other);
    }
    let mut best: Option<(f64, WallPoint, WallPoint)> = None;
    for (i, a) in one.iter().enumerate() {
        for (j, b) in other.iter().enumerate() {
            let [p, q] = closest(&a.curve, &b.curve);
            let distance = (p.point - q.point).norm();
            let found = (distance, WallPoint::of(i, p), WallPoint::of(j, q));
            // A corner is the end of two pieces; if one of them is parallel to the other wall, the middle of both counts.
            let is_closer = |best: (f64, WallPoint, WallPoint)| {
                let rounding = SAME_LENGTH * distance;
                distance < best.0 - rounding
                    || distance <= best.0 + rounding && ends(&found.1, &found.2) < ends(&best.1, &best.2)
            };
            if best.is_none_or(is_closer) {
                best = Some(found);
            }
        }
    }
    best.map(|(_, p, q)| (p, q))
}

/// The closest points of two stretches of many pieces: from samples, then by alternating projection until convergence.
fn closest_of_many(one: &[WallPiece], other: &[WallPiece]) -> Option<(WallPoint, WallPoint)> {
    const SAMPLES: usize = 16;
    const MOST_STEPS: usize = 60;
    let stride = one.len().div_ceil(SAMPLES).max(1);
    let mut best: Option<(f64, WallPoint, WallPoint)> = None;
    for (piece, wall) in one.iter().enumerate().step_by(stride) {
        for u in [0.0, 0.5, 1.0] {
            let p = WallPoint { piece, u, point: wall.curve.point(u) };
            let Some(q) = project(other, p.point) else { continue };
            let distance = (p.point - q.point).norm();
            if best.is_none_or(|(least, ..)| distance < least) {
                best = Some((distance, p, q));
            }
        }
    }
    let (mut distance, mut p, mut q) = best?;
    for _ in 0..MOST_STEPS {
        let Some(next) = project(one, q.point) else { break };
        let Some(facing) = project(other, next.point) else { break };
        let closer = (next.point - facing.point).norm();
        if closer >= distance {
            break;
        }
        let rests = distance - closer <= 1e-15 * distance;
        (distance, p, q) = (closer, next, facing);
        if rests {
            break;
        }
    }
    Some((p, q))
}

/// Whether the wall turns away from the pore by more than rounding where two of its pieces meet (a concave corner of the wall turns
/// towards the pore), by the sine of the turning angle, positive to the left.
pub(super) fn turn(one: &Curve, next: &Curve) -> f64 {
    let (t, s) = (one.tangent(1.0), next.tangent(0.0));
    cross(t, s).atan2(t.dot(&s))
}
