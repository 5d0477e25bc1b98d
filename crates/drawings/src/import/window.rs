//! A window in a larger drawing: shapes outside it are omitted; [`cut`](crate::import::cut) cuts the others.

use crate::import::cut::{ON_SIDE, crossings};
use meniscus_core::math::Bounds;
use meniscus_geometry::body::Body;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::spec::ShapeSpec;

/// Whether a shape and the box have more than a point in common.
pub(crate) fn reaches(shape: &ShapeSpec, window: Bounds) -> bool {
    let tolerance = ON_SIDE * window.size().max();
    Body::of(shape, 0, window).iter().any(|body| {
        if body.is_endless() {
            return true;
        }
        let (a, b) = (body.bounds, window);
        if (0..2).any(|i| a.max[i] <= b.min[i] + tolerance || b.max[i] - tolerance <= a.min[i]) {
            return false;
        }
        if (0..2).all(|i| b.min[i] <= a.min[i] && a.max[i] <= b.max[i]) {
            return true;
        }
        // A part of its surface lies in the window, or the window lies inside it.
        body.curves.iter().any(|curve| enters(curve, window, tolerance)) || body.signed_distance(window.center()) < 0.0
    })
}

fn enters(curve: &Curve, window: Bounds, tolerance: f64) -> bool {
    let inner = window.grown(-tolerance);
    let mut parameters = vec![0.0, 1.0];
    for axis in 0..2 {
        for at in [window.min[axis], window.max[axis]] {
            parameters.extend(crossings(curve, axis, at));
        }
    }
    parameters.sort_by(f64::total_cmp);
    parameters.windows(2).any(|pair| inner.contains(curve.point(0.5 * (pair[0] + pair[1]))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::math::Vec2;
    use meniscus_geometry::spec::Disc;

    fn disc(x: f64, y: f64, radius: f64) -> ShapeSpec {
        ShapeSpec::Disc(Disc { center: [x, y], radius })
    }

    #[test]
    fn shapes_reach_the_window_by_their_surface_and_not_by_their_box() {
        let window = Bounds { min: Vec2::zeros(), max: Vec2::new(4.0, 3.0) };
        for (shape, expected) in [
            (disc(5.0, 4.0, 1.2), false),
            (disc(5.0, 4.0, 1.5), true),
            (disc(5.0, 1.0, 1.0), false),
            (disc(2.0, 1.0, 90.0), true),
            (disc(2.0, 1.0, 0.1), true),
        ] {
            assert_eq!(reaches(&shape, window), expected, "{shape:?}");
        }
    }
}
