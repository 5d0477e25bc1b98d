//! The closest points of two curves, in closed form.
//!
//! At closest points interior to both curves the segment between them is normal to both: it lies on the line through the centers of two arcs, or on the
//! normal of a segment through the center of an arc. Otherwise one of them is an end of its curve.

use crate::curve::{ClosestPoint, Curve};
use meniscus_core::math::Vec2;

/// Relative difference below which squared distances are equal.
const LEVEL: f64 = 1e-9;

/// The closest points of two curves that do not cross, the first one on `one`. For curves at a constant distance, a pair in the middle.
pub fn closest_points(one: &Curve, other: &Curve) -> [ClosestPoint; 2] {
    let from_one = |x: Vec2| {
        let p = one.project(x);
        [p, other.project(p.point)]
    };
    let from_other = |x: Vec2| {
        let q = other.project(x);
        [one.project(q.point), q]
    };
    // Candidates are points of either curve with the nearest one of the other; the closest pair is among them.
    let mut best = from_one(one.point(0.0));
    let mut least = squared_distance(&best);
    let mut offer = |pair: [ClosestPoint; 2]| {
        let distance = squared_distance(&pair);
        if distance < least {
            (best, least) = (pair, distance);
        }
    };
    offer(from_one(one.point(1.0)));
    offer(from_other(other.point(0.0)));
    offer(from_other(other.point(1.0)));
    match (*one, *other) {
        (Curve::Segment { .. }, Curve::Segment { .. }) => {
            // For a constant distance, the middle of the common part.
            let ends = [
                from_one(one.point(0.0)),
                from_one(one.point(1.0)),
                from_other(other.point(0.0)),
                from_other(other.point(1.0)),
            ];
            let equal =
                ends.iter().filter(|pair| squared_distance(pair) <= least * (1.0 + LEVEL)).map(|pair| pair[0].u);
            let (low, high) = equal.fold((1.0_f64, 0.0_f64), |(low, high), u| (low.min(u), high.max(u)));
            return if high > low { from_one(one.point(0.5 * (low + high))) } else { best };
        }
        (Curve::Segment { .. }, Curve::Arc { center, .. }) => offer(from_one(center)),
        (Curve::Arc { center, .. }, Curve::Segment { .. }) => offer(from_other(center)),
        (Curve::Arc { center, radius, .. }, Curve::Arc { center: facing, .. }) => {
            if let Some(direction) = (facing - center).try_normalize(0.0) {
                offer(from_one(center + direction * radius));
                offer(from_one(center - direction * radius));
            }
        }
    }
    best
}

fn squared_distance([p, q]: &[ClosestPoint; 2]) -> f64 {
    (p.point - q.point).norm_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Curves without intersections: arcs with either orientation, segments horizontal and oblique.
    fn curves() -> Vec<Curve> {
        let arc = |x: f64, y: f64, radius: f64, start: f64, sweep: f64| Curve::Arc {
            center: Vec2::new(x, y),
            radius,
            start,
            sweep,
        };
        vec![
            arc(0.0, 0.0, 1.0, -0.4, 0.9),
            arc(3.0, 0.3, 1.5, 2.0, 2.5),
            arc(0.2, 0.1, 4.0, 0.3, -1.2),
            arc(-2.0, 1.0, 0.5, 0.0, 2.0 * PI),
            Curve::Segment { a: Vec2::new(-3.0, -1.5), b: Vec2::new(3.0, -1.8) },
            Curve::Segment { a: Vec2::new(0.1, 0.9), b: Vec2::new(0.3, 2.9) },
            Curve::Segment { a: Vec2::new(-4.0, -2.5), b: Vec2::new(2.5, -3.0) },
        ]
    }

    #[test]
    fn no_two_points_of_curves_are_closer_than_their_closest_points() {
        const SAMPLES: usize = 2000;
        for (i, one) in curves().iter().enumerate() {
            for other in &curves()[i + 1..] {
                let found = closest_points(one, other);
                let distance = squared_distance(&found).sqrt();
                let sampled = (0..=SAMPLES)
                    .map(|k| one.point(k as f64 / SAMPLES as f64))
                    .map(|x| (other.project(x).point - x).norm())
                    .fold(f64::INFINITY, f64::min);
                // Samples miss the closest point by up to their spacing, and its distance by the square of that or less unless it is an end.
                assert!(distance <= sampled + 1e-12, "{one:?} {other:?}: {distance} above {sampled}");
                assert!(sampled - distance < 1e-4, "{one:?} {other:?}: {distance} below {sampled}");
                assert!((one.point(found[0].u) - found[0].point).norm() < 1e-12);
                assert!((other.point(found[1].u) - found[1].point).norm() < 1e-12);
            }
        }
    }
}
