//! Whether two curves have a point in common.

use crate::geometry::curve::{Curve, cross};
use crate::math::{Vec2, perpendicular};

/// Whether two curves meet; ends count.
pub(super) fn meet(one: &Curve, other: &Curve) -> bool {
    // Rounding of positions over their size.
    let slack = 1e-12 * (one.bounds().size().norm() + other.bounds().size().norm());
    let on_both = |x: Vec2| (one.project(x).point - x).norm() <= slack && (other.project(x).point - x).norm() <= slack;
    let (a, b) = (one.bounds().grown(slack), other.bounds());
    if (0..2).any(|i| a.max[i] < b.min[i] || b.max[i] < a.min[i]) {
        return false;
    }
    match (*one, *other) {
        (Curve::Segment { a, b }, Curve::Segment { a: c, b: d }) => {
            let side = |p: Vec2, q: Vec2, x: Vec2| cross(q - p, x - p);
            side(a, b, c) * side(a, b, d) <= 0.0 && side(c, d, a) * side(c, d, b) <= 0.0
        }
        (Curve::Segment { a, b }, Curve::Arc { center, radius, .. })
        | (Curve::Arc { center, radius, .. }, Curve::Segment { a, b }) => {
            let t = (b - a).normalize();
            let middle = a + t * (center - a).dot(&t);
            let miss = (center - middle).norm();
            let half = ((radius - miss) * (radius + miss)).max(0.0).sqrt();
            miss <= radius + slack && [half, -half].into_iter().any(|h| on_both(middle + t * h))
        }
        (Curve::Arc { center: c1, radius: r1, .. }, Curve::Arc { center: c2, radius: r2, .. }) => {
            let line = c2 - c1;
            let distance = line.norm();
            if distance == 0.0 || distance > r1 + r2 + slack || distance < (r1 - r2).abs() - slack {
                return false;
            }
            let t = line / distance;
            let along = 0.5 * (distance + (r1 - r2) * (r1 + r2) / distance);
            let half = ((r1 - along) * (r1 + along)).max(0.0).sqrt();
            [half, -half].into_iter().any(|h| on_both(c1 + t * along + perpendicular(t) * h))
        }
    }
}
