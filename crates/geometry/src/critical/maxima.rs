//! Local maxima of the wall distance between three walls: Newton's method on equal distances.
//!
//! If a nearer wall intrudes into the converged circle, it replaces the one beside it and the iteration continues, so that the initial guess need not contain
//! the right pieces. A maximum lies within the triangle of three of its wall points.

use crate::critical::candidates::Triple;
use crate::critical::opposite::{SAME_DIRECTION, TIE, slack};
use crate::critical::shift::{Shift, plus};
use crate::critical::walls::{Contact, Walls};
use crate::curve::Curve;
use meniscus_core::math::Vec2;

/// A local maximum of the wall distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Maximum {
    /// Its position in m, within the domain.
    pub center: Vec2,
    /// The wall distance there in m.
    pub radius: f64,
    /// The nearest wall points.
    pub contacts: Vec<Contact>,
}

/// If the gap of three wall points exceeds a half circle minus this angle (rad), two of them are opposite: the center is within [`TIE`] of their midpoint.
/// Straight walls have no such maxima unless they are parallel.
const HALF_CIRCLE: f64 = 2.0 * TIE;

const NEWTON_STEPS: usize = 40;
const EXCHANGES: usize = 12;

/// The maximum of the wall distance near a candidate \[Lieutier2004\].
pub(crate) fn maximum(walls: &Walls, triple: &Triple) -> Option<Maximum> {
    between_three(walls, triple).filter(|at| is_maximum(walls, at))
}

/// Two parallel segments on opposite sides of a point between three walls: it is an end of a level passage between them, and no maximum by itself.
pub(crate) fn parallel_walls(walls: &Walls, at: &Maximum) -> Option<[Contact; 2]> {
    let is_straight = |contact: &Contact| matches!(walls.curve(contact.wall, contact.shift), Curve::Segment { .. });
    let direction = |contact: &Contact| (contact.point - at.center) / at.radius;
    let sum = |a: &Contact, b: &Contact| (direction(a) + direction(b)).norm();
    let pairs = at.contacts.iter().enumerate().flat_map(|(k, a)| at.contacts[..k].iter().map(move |b| [*b, *a]));
    pairs
        .min_by(|[a, b], [c, d]| sum(a, b).total_cmp(&sum(c, d)))
        .filter(|[a, b]| sum(a, b) < HALF_CIRCLE && is_straight(a) && is_straight(b))
}

/// The point of equal distance from three walls near a candidate, if no other wall is nearer.
pub(crate) fn between_three(walls: &Walls, triple: &Triple) -> Option<Maximum> {
    let (mut of, mut ends) = (triple.walls, triple.ends);
    let with_ends = ends != [None; 3];
    let mut x = triple.start;
    for _ in 0..EXCHANGES {
        let (center, closest_points) = equidistant(walls, &of, &ends, x)?;
        x = center;
        let radius = (closest_points[0] - x).norm();
        if !walls.is_within(x) || radius <= walls.tolerance {
            return None;
        }
        let (distance, nearest) = walls.nearest(x)?;
        if distance >= radius - slack(walls, radius) {
            let is_in_pore = walls.is_visible(&nearest, x - nearest.point);
            return is_in_pore.then(|| at(walls, x, radius));
        }
        // The nearer wall replaces the one beside it.
        let v = nearest.point - x;
        let beside = |i: &usize| -(closest_points[*i] - x).dot(&v) / (closest_points[*i] - x).norm();
        let replaced = (0..3).min_by(|i, j| beside(i).total_cmp(&beside(j)))?;
        let end = walls.end_of_concave_arc(nearest.wall, nearest.u).filter(|_| with_ends);
        if (of[replaced], ends[replaced]) == ((nearest.wall, nearest.shift), end) {
            return None;
        }
        (of[replaced], ends[replaced]) = ((nearest.wall, nearest.shift), end);
    }
    None
}

/// Whether the wall points of a point leave no half circle free.
pub(crate) fn is_maximum(walls: &Walls, at: &Maximum) -> bool {
    let is_straight = |contact: &Contact| {
        contact.u > 0.0 && contact.u < 1.0 && matches!(walls.curve(contact.wall, contact.shift), Curve::Segment { .. })
    };
    // The end of a piece whose inside is nearer is no wall of its own, although it is nearly as near where a level passage ends soon.
    let is_end_of = |end: &Contact, other: &Contact| {
        let curve = walls.curve(other.wall, other.shift);
        let ends = || [0.0, 1.0].into_iter().map(|u| (curve.point(u) - end.point).norm());
        other.u > 0.0 && other.u < 1.0 && ends().any(|far| far <= walls.tolerance)
    };
    let own = at.contacts.iter().filter(|contact| {
        let is_end = contact.u <= 0.0 || contact.u >= 1.0;
        !(is_end && at.contacts.iter().any(|other| is_end_of(contact, other)))
    });
    let directions: Vec<(Vec2, bool)> = own.map(|contact| (contact.point - at.center, is_straight(contact))).collect();
    surrounded(&directions)
}

/// A maximum with all its wall points.
pub(crate) fn at(walls: &Walls, center: Vec2, radius: f64) -> Maximum {
    let y = walls.wrapped(center).0;
    let mut contacts = walls.contacts(y, radius * (1.0 + TIE) + slack(walls, radius));
    // Coincident points are merged.
    let mut kept: Vec<Contact> = Vec::new();
    contacts.retain(|contact| {
        let is_new = kept.iter().all(|other| (other.point - contact.point).norm() > 1e-6 * radius);
        if is_new {
            kept.push(*contact);
        }
        is_new
    });
    Maximum { center: y, radius, contacts: kept }
}

/// The largest angle in rad between neighboring nearest wall points of a maximum.
pub(crate) fn largest_gap(maximum: &Maximum) -> f64 {
    let mut angles: Vec<f64> =
        maximum.contacts.iter().map(|contact| contact.point - maximum.center).map(|v| v.y.atan2(v.x)).collect();
    angles.sort_by(f64::total_cmp);
    let around = angles.first().map(|first| first + std::f64::consts::TAU);
    let ends = angles.iter().skip(1).copied().chain(around);
    angles.iter().zip(ends).map(|(from, to)| to - from).fold(0.0, f64::max)
}

/// Whether directions, each with a flag for the interior of a segment, leave no half circle free.
fn surrounded(directions: &[(Vec2, bool)]) -> bool {
    let mut angles: Vec<(f64, bool)> =
        directions.iter().map(|(v, is_straight)| (v.y.atan2(v.x), *is_straight)).collect();
    angles.sort_by(|a, b| a.0.total_cmp(&b.0));
    (0..angles.len()).all(|k| {
        let ((from, first), (to, second)) = (angles[k], angles[(k + 1) % angles.len()]);
        let gap = if k + 1 < angles.len() { to - from } else { to + std::f64::consts::TAU - from };
        gap < std::f64::consts::PI - if first && second { SAME_DIRECTION } else { HALF_CIRCLE }
    })
}

/// The point near `x` that is equidistant from three walls, and the nearest points there.
fn equidistant(
    walls: &Walls,
    of: &[(usize, Shift); 3],
    ends: &[Option<f64>; 3],
    mut x: Vec2,
) -> Option<(Vec2, [Vec2; 3])> {
    let all_closest = |x: Vec2| {
        [0, 1, 2].map(|k| match (of[k], ends[k]) {
            ((wall, shift), Some(u)) => walls.curve(wall, shift).point(u),
            ((wall, shift), None) => closest(walls, of, wall, shift, x),
        })
    };
    let farthest = walls.domain.size().norm();
    let begin = x;
    for _ in 0..NEWTON_STEPS {
        let closest_points = all_closest(x);
        let d = closest_points.map(|closest| (x - closest).norm());
        if d.contains(&0.0) {
            return None;
        }
        let away: Vec<Vec2> = (0..3).map(|i| (x - closest_points[i]) / d[i]).collect();
        let (r, s) = (away[1] - away[0], away[2] - away[0]);
        let determinant = r.x * s.y - r.y * s.x;
        let (e, f) = (d[0] - d[1], d[0] - d[2]);
        let step = Vec2::new(e * s.y - f * r.y, f * r.x - e * s.x) / determinant;
        let length = step.norm();
        if !length.is_finite() {
            return None;
        }
        // A step beyond the nearest wall is meaningless.
        let longest = 0.5 * d[0].min(d[1]).min(d[2]);
        x += if length > longest { step * (longest / length) } else { step };
        if (x - begin).norm() > farthest {
            return None;
        }
        if length <= 1e-15 * farthest + 1e-14 * d[0] {
            let closest_points = all_closest(x);
            return Some((x, closest_points));
        }
    }
    let closest_points = all_closest(x);
    let d = closest_points.map(|closest| (x - closest).norm());
    let spread = d.iter().fold(0.0_f64, |most, other| most.max((other - d[0]).abs()));
    (spread <= slack(walls, d[0])).then_some((x, closest_points))
}

/// The nearest point of a piece or of the previous one, which shares its first vertex, unless that is one of the three itself.
fn closest(walls: &Walls, of: &[(usize, Shift); 3], wall: usize, shift: Shift, x: Vec2) -> Vec2 {
    let curve = walls.curve(wall, shift);
    let closest = curve.project(x);
    let before = walls.walls[wall].before.map(|before| (before.wall, plus(shift, before.shift)));
    match before.filter(|before| closest.u == 0.0 && !of.contains(before)) {
        Some(before) => {
            let other = walls.curve(before.0, before.1).project(x).point;
            if (other - x).norm_squared() < (closest.point - x).norm_squared() { other } else { closest.point }
        }
        None => closest.point,
    }
}

/// The center of a concave arc, if its points leave no half circle free.
pub(crate) fn center_of_arc(walls: &Walls, wall: usize) -> Option<Maximum> {
    let Curve::Arc { center, radius, sweep, .. } = walls.walls[wall].curve else { return None };
    if sweep > 0.0 || !walls.is_within(center) || walls.distance(center) < radius - slack(walls, radius) {
        return None;
    }
    let contacts = walls.contacts(center, radius + slack(walls, radius));
    let mut directions: Vec<(Vec2, bool)> = contacts.iter().map(|contact| (contact.point - center, false)).collect();
    for contact in &contacts {
        // For concentric arcs all points are nearest.
        let curve = walls.curve(contact.wall, contact.shift);
        if let Curve::Arc { center: other, .. } = curve
            && (other - center).norm() <= slack(walls, radius)
        {
            directions.extend((0..=12).map(|k| (curve.point(f64::from(k) / 12.0) - center, false)));
        }
    }
    surrounded(&directions).then(|| at(walls, center, radius))
}
