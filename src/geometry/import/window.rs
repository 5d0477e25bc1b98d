//! A window in a larger drawing: shapes that do not reach into it are left out; [`cut`](crate::geometry::import::cut) cuts the others.

use crate::geometry::body::Body;
use crate::geometry::curve::Curve;
use crate::geometry::import::build::Imported;
use crate::geometry::import::cut::crossings;
use crate::geometry::import::options::Options;
use crate::geometry::spec::{GeometrySpec, ShapeSpec, SolidSide};
use crate::input::problem::Problem;
use crate::math::Bounds;

/// Vertices nearer to a side than this share of the window's longer side are on it.
pub(crate) const ON_SIDE: f64 = 1e-9;

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
        // A part of its surface lies in the window, or the window lies in it.
        body.curves.iter().any(|curve| enters(curve, window, tolerance)) || body.signed_distance(window.center()) < 0.0
    })
}

fn enters(curve: &Curve, window: Bounds, tolerance: f64) -> bool {
    let inner = window.grown(-tolerance);
    let mut places = vec![0.0, 1.0];
    for axis in 0..2 {
        for at in [window.min[axis], window.max[axis]] {
            places.extend(crossings(curve, axis, at));
        }
    }
    places.sort_by(f64::total_cmp);
    places.windows(2).any(|pair| inner.contains(curve.point(0.5 * (pair[0] + pair[1]))))
}

/// A shape file of ours seen through the window of the options, solid and pore in turn where they say so.
///
/// # Errors
/// Problems with the keys `window` and `invert`.
pub(crate) fn windowed(mut spec: GeometrySpec, options: &Options) -> Result<Imported, Vec<Problem>> {
    let mut notes = Vec::new();
    if options.is_inverted() {
        spec.solid = if spec.solid == SolidSide::Inside { SolidSide::Outside } else { SolidSide::Inside };
    }
    if let Some([min, max]) = options.window {
        (spec.min, spec.max) = (min, max);
        let window = Bounds { min: min.into(), max: max.into() };
        let before = spec.shapes.len();
        spec.shapes.retain(|shape| reaches(shape, window));
        notes.push(format!("outside of the window: shapes ({})", before - spec.shapes.len()));
    }
    let key = if options.window.is_some() { "window" } else { "invert" };
    let problems = if options.window.is_some() || options.is_inverted() { spec.problems() } else { Vec::new() };
    if problems.is_empty() {
        return Ok(Imported { spec, notes });
    }
    Err(problems.into_iter().map(|problem| Problem { path: key.into(), ..problem }).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::spec::Disc;
    use crate::math::Vec2;

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
