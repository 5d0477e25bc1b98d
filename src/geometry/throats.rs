//! The narrowest passages between solids.
//!
//! Definition. A throat is a pair of wall points with nothing but pore in the disc whose diameter they span, at a local
//! minimum of the pore's width along the medial axis. Its width is the distance of the two points; for discs this is the
//! gap of two neighboring grains on the line of their centers. Where walls run parallel, the middle of that part of the
//! domain stands for all of it. Only throats whose middle lies in the domain count.
//!
//! The candidates are the nearest points of all pairs of wall pieces, in closed form; the cost grows with the square of the
//! number of pieces (5000 pieces: some seconds).

use rayon::prelude::*;

use crate::geometry::boundary::Piece;
use crate::geometry::curve::Curve;
use crate::geometry::intersect::meeting_places;
use crate::geometry::solid::Geometry;
use crate::math::{Bounds, Vec2, perpendicular};

/// Relative size of differences in width that are rounding.
const ROUNDING: f64 = 1e-7;

/// Steps along the medial axis away from a throat, over its width: near enough to see a short minimum, then along a level part.
const FIRST_STEP: f64 = 0.02;
const NEXT_STEP: f64 = 0.1;

/// A narrow passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Throat {
    /// Distance of the walls in m.
    pub width: f64,
    /// The two wall points in m.
    pub ends: [Vec2; 2],
    /// Their middle in m.
    pub center: Vec2,
}

impl Throat {
    fn between(p: Vec2, q: Vec2) -> Self {
        Self { width: (q - p).norm(), ends: [p, q], center: 0.5 * (p + q) }
    }
}

impl Geometry {
    /// The narrowest throat, if there is one.
    #[must_use]
    pub fn narrowest_throat(&self) -> Option<Throat> {
        throats(self).into_iter().next()
    }
}

/// All throats, the narrowest first; the definition stands at the top of this module.
#[must_use]
pub fn throats(geometry: &Geometry) -> Vec<Throat> {
    let pieces: Vec<(Piece, Bounds)> = geometry.boundary.pieces.iter().map(|p| (*p, p.curve.bounds())).collect();
    let reach = geometry.bounds().grown(geometry.bounds().size().norm());
    let per_piece: Vec<Vec<Throat>> = (0..pieces.len())
        .into_par_iter()
        .map(|i| {
            let mut found = Vec::new();
            if overlaps(&pieces[i].1, &reach) {
                for other in pieces[i + 1..].iter().filter(|other| overlaps(&other.1, &reach)) {
                    let candidate = nearest_pair(&pieces[i].0.curve, &other.0.curve, geometry);
                    found.extend(candidate.filter(|throat| is_throat(geometry, throat)));
                }
            }
            found
        })
        .collect();
    let mut all: Vec<Throat> = per_piece.into_iter().flatten().collect();
    all.sort_by(|a, b| {
        let keys = |t: &Throat| [t.width, t.center.x, t.center.y];
        keys(a).partial_cmp(&keys(b)).unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut kept: Vec<Throat> = Vec::new();
    for throat in all {
        if !kept.iter().any(|other| is_same_passage(geometry, other, &throat)) {
            kept.push(throat);
        }
    }
    kept
}

fn overlaps(a: &Bounds, b: &Bounds) -> bool {
    (0..2).all(|i| a.min[i] <= b.max[i] && b.min[i] <= a.max[i])
}

/// The nearest points of two pieces; of parallel segments the middle of the part that lies in the domain.
fn nearest_pair(a: &Curve, b: &Curve, geometry: &Geometry) -> Option<Throat> {
    let mut meetings = Vec::new();
    meeting_places(a, b, geometry.tolerance(), &mut meetings);
    if !meetings.is_empty() {
        return None;
    }
    if let (Curve::Segment { a: p, b: q }, Curve::Segment { a: r, b: s }) = (a, b)
        && let Some(throat) = between_parallels([*p, *q], [*r, *s], geometry.bounds())
    {
        return Some(throat);
    }
    let mut best: Option<Throat> = None;
    let mut offer = |p: Vec2, q: Vec2| {
        let throat = Throat::between(p, q);
        if best.is_none_or(|b| throat.width < b.width) {
            best = Some(throat);
        }
    };
    for u in [0.0, 1.0] {
        let (p, q) = (a.point(u), b.point(u));
        offer(p, b.project(p).point);
        offer(a.project(q).point, q);
    }
    // Nearest points off the ends lie on the normal through a center: once or twice back and forth finds them.
    if let Curve::Arc { center, .. } = a {
        let q = b.project(*center).point;
        let p = a.project(q).point;
        offer(p, b.project(p).point);
    }
    if let Curve::Arc { center, .. } = b {
        let p = a.project(*center).point;
        let q = b.project(p).point;
        offer(a.project(q).point, q);
    }
    best
}

/// The middle of the common part of two parallel segments within the domain, if they run parallel and side by side.
fn between_parallels(one: [Vec2; 2], other: [Vec2; 2], domain: Bounds) -> Option<Throat> {
    let t = (one[1] - one[0]).try_normalize(0.0)?;
    let w = (other[1] - other[0]).try_normalize(0.0)?;
    if crate::geometry::curve::cross(t, w).abs() > ROUNDING {
        return None;
    }
    let origin = 0.5 * (one[0] + other[0]);
    let n = perpendicular(t);
    let across = |x: Vec2| n * n.dot(&(x - origin));
    // Center line: halfway between both, clipped to the domain along t.
    let middle_line = origin + 0.5 * (across(one[0]) + across(other[0]));
    let span = |points: [Vec2; 2]| {
        let s = points.map(|x| t.dot(&(x - origin)));
        (s[0].min(s[1]), s[0].max(s[1]))
    };
    let (a, b) = (span(one), span(other));
    let (mut low, mut high) = (a.0.max(b.0), a.1.min(b.1));
    for i in 0..2 {
        if t[i] != 0.0 {
            let (s, e) = ((domain.min[i] - middle_line[i]) / t[i], (domain.max[i] - middle_line[i]) / t[i]);
            low = low.max(s.min(e) + t.dot(&(middle_line - origin)));
            high = high.min(s.max(e) + t.dot(&(middle_line - origin)));
        }
    }
    (low < high).then(|| {
        let along = t * (0.5 * (low + high));
        Throat::between(origin + along + across(one[0]), origin + along + across(other[0]))
    })
}

/// Whether the pair satisfies the definition.
fn is_throat(geometry: &Geometry, throat: &Throat) -> bool {
    let half = 0.5 * throat.width;
    let domain = geometry.bounds();
    let in_domain = (0..2).all(|i| {
        // With periodic sides, left and right are the same place: it counts once.
        let is_before_end = if geometry.periodic()[i] { throat.center[i] < domain.max[i] } else { true };
        throat.center[i] >= domain.min[i] && throat.center[i] <= domain.max[i] && is_before_end
    });
    if !in_domain || half <= geometry.tolerance() {
        return false;
    }
    let slack = ROUNDING * half;
    if geometry.signed_distance(throat.center) < half - slack {
        return false;
    }
    // The width along the medial axis must not fall on either side, nor be level on one side and fall on the other.
    let across = (throat.ends[1] - throat.ends[0]) / throat.width;
    let along = perpendicular(across);
    let longest = domain.size().norm();
    [1.0, -1.0].into_iter().all(|side| {
        // A level part is followed to its end, or to the end of the domain; the first step may leave it.
        let mut travel = FIRST_STEP * throat.width;
        while travel < longest {
            let at = throat.center + along * (side * travel);
            let radius = radius_across(geometry, at, across, half);
            if radius > half + slack {
                return true;
            }
            if radius < half - slack {
                return false;
            }
            if !domain.contains(geometry.wrapped(at)) {
                return true;
            }
            travel += NEXT_STEP * throat.width;
        }
        true
    })
}

/// The largest wall distance (m) on the line across the passage through `at`, within half a width: the medial axis.
fn radius_across(geometry: &Geometry, at: Vec2, across: Vec2, half: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let value = |s: f64| geometry.signed_distance(at + across * s);
    let (mut low, mut high) = (-0.5 * half, 0.5 * half);
    let mut best = value(0.0);
    while high - low > 1e-9 * half {
        let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        let (fa, fb) = (value(a), value(b));
        best = best.max(fa).max(fb);
        if fa < fb { low = a } else { high = b }
    }
    best
}

/// Whether two throats are one: at the same place, or of the same width with a level passage between them.
fn is_same_passage(geometry: &Geometry, a: &Throat, b: &Throat) -> bool {
    if (a.width - b.width).abs() > 10.0 * ROUNDING * a.width {
        return false;
    }
    let between = b.center - a.center;
    if between.norm() <= 1e-3 * a.width {
        return true;
    }
    // The line from one to the other must stay in the middle of the passage.
    const PROBES: usize = 16;
    let half = 0.5 * a.width;
    (1..PROBES).all(|k| {
        let x = a.center + between * (k as f64 / PROBES as f64);
        (geometry.signed_distance(x) - half).abs() <= 10.0 * ROUNDING * half
    })
}
