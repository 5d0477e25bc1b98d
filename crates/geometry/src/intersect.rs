//! Intersections of two curves: the parameters at which one has to be split before its parts are classified as inside or outside.
//!
//! Intersections of segments and circles in closed form. Coincident curves are split at the ends of the other curve. Tangent circles give one point or two
//! near ones; an extra split is harmless.

use crate::curve::{Curve, cross};
use meniscus_core::math::{Vec2, perpendicular};

/// Lines and circles that are tangent within this fraction of the radii count; the caller decides.
const SLACK: f64 = 1e-9;

/// Adds to `found` the parameters on `curve` at its intersections with `other`, within `tolerance` in m.
pub fn intersections(curve: &Curve, other: &Curve, tolerance: f64, found: &mut Vec<f64>) {
    let mut keep = |x: Vec2| {
        let (here, there) = (curve.project(x), other.project(x));
        if (here.point - x).norm() <= tolerance && (there.point - x).norm() <= tolerance {
            found.push(here.u);
        }
    };
    if !other.is_closed() {
        keep(other.point(0.0));
        keep(other.point(1.0));
    }
    crossings(curve, other).into_iter().for_each(keep);
}

/// The intersections of the lines and circles that contain two curves.
pub(crate) fn crossings(curve: &Curve, other: &Curve) -> Vec<Vec2> {
    match (*curve, *other) {
        (Curve::Segment { a, b }, Curve::Segment { a: c, b: d }) => line_line(a, b - a, c, d - c).into_iter().collect(),
        (Curve::Segment { a, b }, Curve::Arc { center, radius, .. })
        | (Curve::Arc { center, radius, .. }, Curve::Segment { a, b }) => {
            line_circle(a, b - a, center, radius, SLACK).into_iter().flatten().collect()
        }
        (Curve::Arc { center, radius, .. }, Curve::Arc { center: c, radius: r, .. }) => {
            circle_circle(center, radius, c, r, SLACK).into_iter().flatten().collect()
        }
    }
}

fn line_line(a: Vec2, along: Vec2, c: Vec2, other: Vec2) -> Option<Vec2> {
    let determinant = cross(along, other);
    // Parallel up to rounding: split only at the ends of the pieces.
    if determinant.abs() <= 1e-14 * along.norm() * other.norm() {
        return None;
    }
    Some(a + along * (cross(c - a, other) / determinant))
}

/// The intersections of a line and a circle, twice the same point where they are tangent within `slack` (relative).
pub(crate) fn line_circle(a: Vec2, along: Vec2, center: Vec2, radius: f64, slack: f64) -> [Option<Vec2>; 2] {
    let Some(t) = along.try_normalize(0.0) else { return [None, None] };
    let middle = a + t * (center - a).dot(&t);
    let miss = (center - middle).norm();
    if miss > radius * (1.0 + slack) {
        return [None, None];
    }
    let half = ((radius - miss).max(0.0) * (radius + miss)).sqrt();
    [Some(middle - t * half), Some(middle + t * half)]
}

/// The intersections of two circles, twice the same point where they are tangent within `slack` (relative).
pub(crate) fn circle_circle(c1: Vec2, r1: f64, c2: Vec2, r2: f64, slack: f64) -> [Option<Vec2>; 2] {
    let between = c2 - c1;
    let distance = between.norm();
    let slack = slack * (r1 + r2);
    if distance == 0.0 || distance > r1 + r2 + slack || distance < (r1 - r2).abs() - slack {
        return [None, None];
    }
    let t = between / distance;
    let along = 0.5 * (distance + (r1 - r2) * (r1 + r2) / distance);
    let half = ((r1 - along) * (r1 + along)).max(0.0).sqrt();
    let n = perpendicular(t);
    [Some(c1 + t * along + n * half), Some(c1 + t * along - n * half)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters(a: &Curve, b: &Curve) -> Vec<f64> {
        let mut found = Vec::new();
        intersections(a, b, 1e-9, &mut found);
        found.sort_by(f64::total_cmp);
        found
    }

    #[test]
    fn crossing_circles_meet_twice_at_points_of_both() {
        let (a, b) = (Curve::circle(Vec2::zeros(), 1.0), Curve::circle(Vec2::new(1.0, 0.5), 0.7));
        let found = parameters(&a, &b);
        assert_eq!(found.len(), 2);
        for u in found {
            assert!(((a.point(u) - Vec2::new(1.0, 0.5)).norm() - 0.7).abs() < 1e-12);
        }
    }

    #[test]
    fn segments_that_share_a_part_are_split_at_its_ends() {
        let a = Curve::Segment { a: Vec2::zeros(), b: Vec2::new(4.0, 0.0) };
        let b = Curve::Segment { a: Vec2::new(3.0, 0.0), b: Vec2::new(1.0, 0.0) };
        assert_eq!(parameters(&a, &b), [0.25, 0.75]);
    }

    #[test]
    fn a_segment_that_ends_short_of_a_circle_does_not_meet_it() {
        let segment = Curve::Segment { a: Vec2::new(-3.0, 0.0), b: Vec2::new(-1.5, 0.0) };
        assert!(parameters(&segment, &Curve::circle(Vec2::zeros(), 1.0)).is_empty());
    }
}
