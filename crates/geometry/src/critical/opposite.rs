//! Points between two opposite wall points: every saddle of the wall distance, and maxima between two walls.
//!
//! Two points are opposite if the segment between them is normal to both walls, or lies in the cone of normals of a vertex, and the disc whose diameter they
//! span contains only pore. In closed form for all pieces: the line through two centers, through a center normal to a segment, from a vertex, between two
//! vertices.

use crate::critical::candidates::Pair;
use crate::critical::walls::{Contact, Walls};
use crate::curve::{Curve, cross};
use meniscus_core::math::{Vec2, perpendicular};

/// Rounding of directions, in rad: pieces of imported curves join within it.
pub const SAME_DIRECTION: f64 = 1e-7;

/// Rounding of distances, over the distance.
pub(crate) const SAME_DISTANCE: f64 = 1e-9;

/// Relative difference within which further walls count as equally near. A saddle and a maximum that differ by less are one point: their distances differ by
/// no more than its square.
pub(crate) const TIE: f64 = 1e-6;

/// Two opposite wall points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opposite {
    /// The points.
    pub contacts: [Contact; 2],
    /// Their midpoint in m.
    pub center: Vec2,
    /// Half their distance in m.
    pub half: f64,
}

impl Opposite {
    /// Two wall points with their midpoint.
    pub(crate) fn between(contacts: [Contact; 2]) -> Self {
        let [p, q] = contacts.map(|contact| contact.point);
        Self { contacts, center: 0.5 * (p + q), half: 0.5 * (q - p).norm() }
    }

    /// The unit vector from the first point to the second.
    pub(crate) fn across(&self) -> Vec2 {
        (self.contacts[1].point - self.contacts[0].point) / (2.0 * self.half)
    }

    /// Whether a unit vector from the midpoint leads to neither of the two points nor to a neighbor of one.
    pub(crate) fn leads_elsewhere(&self, v: Vec2) -> bool {
        // A wall point within this angle in rad of one of the two is a neighbor of that; it follows from the rounding of distances.
        let beside = (10.0 * SAME_DISTANCE).sqrt();
        v.dot(&self.across()).abs() < 1.0 - 0.5 * beside * beside
    }

    /// Whether no wall is nearer to the midpoint than the two points, up to rounding.
    pub(crate) fn is_empty(&self, walls: &Walls) -> bool {
        walls.distance(self.center) >= self.half - slack(walls, self.half)
    }

    /// The same, but a third wall may be nearer within [`TIE`].
    fn is_nearly_empty(&self, walls: &Walls) -> bool {
        let (distance, inner) = (walls.distance(self.center), self.half - slack(walls, self.half));
        distance >= inner
            || distance >= self.half * (1.0 - TIE)
                && walls
                    .contacts(self.center, inner)
                    .iter()
                    .all(|contact| self.leads_elsewhere((contact.point - self.center).normalize()))
    }
}

/// Tolerance of a distance `d` in m.
pub(crate) fn slack(walls: &Walls, d: f64) -> f64 {
    // Rounding of positions over the tolerance of the geometry.
    const ROUNDING: f64 = 1e-5;
    SAME_DISTANCE * d + ROUNDING * walls.tolerance
}

/// Opposite points of a pair of pieces, saddles of the wall distance \[Lieutier2004\]. For pieces at a constant distance, those next to the point of the pair.
pub(crate) fn opposite_points(walls: &Walls, pair: &Pair, include_ends: bool) -> Vec<Opposite> {
    let curves = [walls.curve(pair.walls[0], [0, 0]), walls.curve(pair.walls[1], pair.shift)];
    let mut found = Vec::new();
    let mut offer = |u: [f64; 2]| {
        let [p, q] = [curves[0].point(u[0]), curves[1].point(u[1])];
        let width = (q - p).norm();
        if width <= walls.tolerance {
            return;
        }
        let v = (q - p) / width;
        if !(faces(&curves[0], u[0], v) && faces(&curves[1], u[1], -v)) {
            return;
        }
        let contacts = [
            Contact { wall: pair.walls[0], shift: [0, 0], u: walls.snapped(&curves[0], u[0]), point: p },
            Contact { wall: pair.walls[1], shift: pair.shift, u: walls.snapped(&curves[1], u[1]), point: q },
        ];
        let opposite = Opposite::between(contacts.map(|contact| walls.at_vertex(contact)));
        let across = opposite.across();
        if walls.is_visible(&opposite.contacts[0], across)
            && walls.is_visible(&opposite.contacts[1], -across)
            && walls.is_within(opposite.center)
            && opposite.is_nearly_empty(walls)
        {
            found.push(opposite);
        }
    };
    if let Some(u) = level_parameters(&curves[0], &curves[1], pair.between) {
        offer(u);
    }
    if !include_ends {
        return found;
    }
    interior_points(&curves[0], &curves[1], &mut offer);
    let ends = |curve: &Curve| if curve.is_closed() { &[][..] } else { &[0.0, 1.0][..] };
    for &u in ends(&curves[0]) {
        for w in normals_through(&curves[1], curves[0].point(u)) {
            offer([u, w]);
        }
        ends(&curves[1]).iter().for_each(|&w| offer([u, w]));
    }
    for &w in ends(&curves[1]) {
        for u in normals_through(&curves[0], curves[1].point(w)) {
            offer([u, w]);
        }
    }
    found
}

/// Whether a curve faces the direction of the unit vector `v` at `u`: the curve lies behind that point.
fn faces(curve: &Curve, u: f64, v: Vec2) -> bool {
    match u {
        _ if curve.is_closed() => curve.normal(u).dot(&v) > 0.0,
        0.0 => curve.tangent(0.0).dot(&v) <= SAME_DIRECTION,
        1.0 => curve.tangent(1.0).dot(&v) >= -SAME_DIRECTION,
        _ => curve.normal(u).dot(&v) > 0.0,
    }
}

/// Proposes the opposite points interior to two pieces whose distance is not constant.
fn interior_points(a: &Curve, b: &Curve, offer: &mut impl FnMut([f64; 2])) {
    let direction = match (*a, *b) {
        (Curve::Segment { .. }, Curve::Segment { .. }) => return,
        (Curve::Segment { a, b }, Curve::Arc { .. }) | (Curve::Arc { .. }, Curve::Segment { a, b }) => {
            (b - a).try_normalize(0.0).map(perpendicular)
        }
        (Curve::Arc { center, .. }, Curve::Arc { center: other, .. }) => (other - center).try_normalize(0.0),
    };
    let Some(direction) = direction else { return };
    let anchor = match (*a, *b) {
        (Curve::Arc { center, .. }, _) | (_, Curve::Arc { center, .. }) => center,
        _ => return,
    };
    for u in crossings(a, anchor, direction).into_iter().flatten() {
        for w in crossings(b, anchor, direction).into_iter().flatten() {
            offer([u, w]);
        }
    }
}

/// Parameters of a piece's points on the line along `direction` through `anchor`: for an arc the line passes through its center.
fn crossings(curve: &Curve, anchor: Vec2, direction: Vec2) -> [Option<f64>; 2] {
    match *curve {
        Curve::Segment { a, b } => {
            let u = (anchor - a).dot(&(b - a)) / (b - a).norm_squared();
            [(u > 0.0 && u < 1.0).then_some(u), None]
        }
        Curve::Arc { .. } => [angle_parameter(curve, direction), angle_parameter(curve, -direction)],
    }
}

/// The parameter of an arc's point in the given `direction` from its center.
fn angle_parameter(arc: &Curve, direction: Vec2) -> Option<f64> {
    let Curve::Arc { start, sweep, .. } = *arc else { return None };
    let turned = ((direction.y.atan2(direction.x) - start) * sweep.signum()).rem_euclid(std::f64::consts::TAU);
    let u = turned / sweep.abs();
    if arc.is_closed() {
        // Just before the start of a circle the angle rounds to a whole turn.
        return Some(if u < 1.0 { u } else { 0.0 });
    }
    (u > 0.0 && u < 1.0).then_some(u)
}

/// Parameters of a piece at which its normal line passes through `x`.
fn normals_through(curve: &Curve, x: Vec2) -> impl Iterator<Item = f64> + use<> {
    let parameters = match *curve {
        Curve::Segment { .. } => crossings(curve, x, Vec2::zeros()),
        Curve::Arc { center, .. } => match (x - center).try_normalize(0.0) {
            Some(direction) => crossings(curve, center, direction),
            None => [None, None],
        },
    };
    parameters.into_iter().flatten()
}

/// Parameters of two pieces between which the wall distance is constant along the medial axis, as near as possible to the point `near`.
fn level_parameters(a: &Curve, b: &Curve, near: Vec2) -> Option<[f64; 2]> {
    // Minimum distance from the ends of the common part, as a fraction of it.
    const WITHIN: f64 = 1e-3;
    match (*a, *b) {
        (Curve::Segment { a: p, b: q }, Curve::Segment { a: r, b: s }) => {
            let t = (q - p).try_normalize(0.0)?;
            let w = (s - r).try_normalize(0.0)?;
            if cross(t, w).abs() > SAME_DIRECTION || t.dot(&w) > 0.0 || perpendicular(t).dot(&(r - p)) > 0.0 {
                return None;
            }
            let along = |x: Vec2| t.dot(&(x - p));
            let (low, high) = (along(s).max(0.0), along(r).min(along(q)));
            let margin = WITHIN * (high - low);
            if !(margin > 0.0) {
                return None;
            }
            let middle = along(near).clamp(low + margin, high - margin);
            Some([middle / along(q), (middle - along(r)) / (along(s) - along(r))])
        }
        (Curve::Arc { center: c, radius, sweep, .. }, Curve::Arc { center: d, radius: other, sweep: turn, .. }) => {
            // A convex arc within a concave one.
            if (d - c).norm() > SAME_DIRECTION * radius.min(other) || sweep * turn > 0.0 {
                return None;
            }
            let convex_is_inner = if sweep > 0.0 { radius < other } else { other < radius };
            if !convex_is_inner {
                return None;
            }
            common_angle(a, b, c, near, WITHIN)
        }
        _ => None,
    }
}

/// The direction from the common center of two arcs, interior to both, that is nearest to the direction of `near`, as parameters.
fn common_angle(a: &Curve, b: &Curve, center: Vec2, near: Vec2, within: f64) -> Option<[f64; 2]> {
    let both = |x: Vec2| {
        let direction = x - center;
        Some([angle_parameter(a, direction)?, angle_parameter(b, direction)?])
    };
    if let Some(found) = both(near) {
        return Some(found);
    }
    // Just inside the ends.
    let ends = [a, b].into_iter().flat_map(|curve| [within, 1.0 - within].map(|u| curve.point(u)));
    let angle = |x: Vec2| cross(near - center, x - center).atan2((near - center).dot(&(x - center))).abs();
    ends.filter(|&x| both(x).is_some()).min_by(|x, y| angle(*x).total_cmp(&angle(*y))).and_then(both)
}
