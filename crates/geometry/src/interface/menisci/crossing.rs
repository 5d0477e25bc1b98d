//! Intersections of two curves.

use crate::curve::{Curve, cross};
use crate::intersect::{circle_circle, line_circle};
use meniscus_core::math::Vec2;

/// Rounding of positions, relative to their size.
pub(super) const SLACK: f64 = 1e-12;

/// The points at which two curves intersect, ends included; none for collinear segments that overlap.
pub(super) fn meetings(one: &Curve, other: &Curve) -> [Option<Vec2>; 2] {
    let slack = SLACK * (one.bounds().size().norm() + other.bounds().size().norm());
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
            line_circle(a, b - a, center, radius, f64::INFINITY)
        }
        (Curve::Arc { center: c1, radius: r1, .. }, Curve::Arc { center: c2, radius: r2, .. }) => {
            circle_circle(c1, r1, c2, r2, SLACK)
        }
    };
    // Infinite or NaN where the lines do not intersect: on neither.
    found.map(|x| x.filter(on_both))
}
