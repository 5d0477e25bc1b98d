//! Angles of walls where pieces join, and clipping of walls at the sides of the domain.

use std::f64::consts::PI;

use crate::boundary::divided;
use crate::curve::{Curve, cross};
use crate::intersect::intersections;
use meniscus_core::math::{Bounds, perpendicular};

/// The angle in rad, positive to the left, from the end of one curve to the start of the next one.
pub(super) fn turn(from: &Curve, to: &Curve, near: f64) -> f64 {
    let (t, s) = (from.tangent(1.0), to.tangent(0.0));
    let angle = cross(t, s).atan2(t.dot(&s));
    // At a cusp the angle is ±π: the sign follows from the curves themselves.
    const CUSP: f64 = 1e-4;
    if PI - angle.abs() > CUSP {
        return angle;
    }
    let reach = (1e3 * near).max(0.1 * from.length().min(to.length()));
    let back = from.point(1.0 - (reach / from.length()).min(0.5));
    let ahead = to.project(back).point;
    if (ahead - back).dot(&-perpendicular(t)) > 0.0 { -PI } else { PI }
}

/// The parts of a curve within a box along non-periodic axes, and along periodic ones if the curve is longer than the box. A part along a side of the box is
/// kept if its pore lies within.
pub(super) fn clipped(curve: &Curve, frame: Bounds, periodic: [bool; 2], tolerance: f64) -> Vec<Curve> {
    let bounds = curve.bounds();
    let cuts = |i: usize| !periodic[i] || bounds.max[i] - bounds.min[i] > 1.5 * frame.size()[i];
    let leaves =
        |i: usize| cuts(i) && (bounds.min[i] < frame.min[i] + tolerance || bounds.max[i] > frame.max[i] - tolerance);
    if !leaves(0) && !leaves(1) {
        return vec![*curve];
    }
    let mut parameters = Vec::new();
    let far = frame.grown(bounds.size().norm() + frame.size().norm());
    for i in (0..2).filter(|&i| cuts(i)) {
        for level in [frame.min[i], frame.max[i]] {
            let (mut a, mut b) = (far.min, far.max);
            (a[i], b[i]) = (level, level);
            intersections(curve, &Curve::Segment { a, b }, tolerance, &mut parameters);
        }
    }
    parameters.retain(|u| u.is_finite());
    let part = |[from, to]: [f64; 2]| if [from, to] == [0.0, 1.0] { *curve } else { curve.part(from, to) };
    let is_kept = |part: &Curve| {
        let (middle, normal) = (part.point(0.5), part.normal(0.5));
        (0..2).filter(|&i| cuts(i)).all(|i| {
            let (low, high) = (middle[i] - frame.min[i], frame.max[i] - middle[i]);
            low > -tolerance
                && high > -tolerance
                && (low > tolerance || normal[i] > 0.0)
                && (high > tolerance || normal[i] < 0.0)
        })
    };
    divided(curve, parameters, tolerance).into_iter().map(part).filter(is_kept).collect()
}
