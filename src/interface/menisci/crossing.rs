//! Intersections of two curves.

use crate::geometry::curve::{Curve, cross};
use crate::math::{Vec2, perpendicular};

/// The points at which two curves intersect, ends included; none for collinear segments that overlap.
pub(super) fn meetings(one: &Curve, other: &Curve) -> [Option<Vec2>; 2] {
    // Rounding of positions, relative to their size.
    let slack = 1e-12 * (one.bounds().size().norm() + other.bounds().size().norm());
    let on_both =
        |x: &Vec2| (one.project(*x).point - x).norm() <= slack && (other.project(*x).point - x).norm() <= slack;
    let (a, b) = (one.bounds().grown(slack), other.bounds());
    if (0..2).any(|i| a.max[i] < b.min[i] || b.max[i] < a.min[i]) {
        return [None, None];
    }
    let found = match (*one, *other) {
        (Curve::Segment { a, b }, Curve::Segment { a: c, b: d }) => {
            let (along, across) = (b - a, d - c);
            [Some(a + along * (cross(c - a, across) / cross(along, across))), None]
        }
        (Curve::Segment { a, b }, Curve::Arc { center, radius, .. })
        | (Curve::Arc { center, radius, .. }, Curve::Segment { a, b }) => {
            let t = (b - a).normalize();
            let middle = a + t * (center - a).dot(&t);
            let miss = (center - middle).norm();
            let half = ((radius - miss) * (radius + miss)).max(0.0).sqrt();
            [half, -half].map(|h| Some(middle + t * h))
        }
        (Curve::Arc { center: c1, radius: r1, .. }, Curve::Arc { center: c2, radius: r2, .. }) => {
            circle_circle(c1, r1, c2, r2)
        }
    };
    // Infinite or NaN where the lines do not intersect: on neither.
    found.map(|x| x.filter(on_both))
}

/// Intersections of two circles: the same point twice where they are tangent within rounding.
pub(super) fn circle_circle(c1: Vec2, r1: f64, c2: Vec2, r2: f64) -> [Option<Vec2>; 2] {
    let line = c2 - c1;
    let distance = line.norm();
    let slack = 1e-12 * (r1 + r2);
    if !(distance <= r1 + r2 + slack && distance >= (r1 - r2).abs() - slack && distance > 0.0) {
        return [None, None];
    }
    let t = line / distance;
    let along = 0.5 * (distance + (r1 - r2) * (r1 + r2) / distance);
    let half = ((r1 - along) * (r1 + along)).max(0.0).sqrt();
    [half, -half].map(|h| Some(c1 + t * along + perpendicular(t) * h))
}
