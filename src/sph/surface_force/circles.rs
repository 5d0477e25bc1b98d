//! Circles through weighted points by least squares: free, held to an angle at a wall, and through a given point.
//!
//! A circle through points (u, v) in the frame of tangent and normal obeys v = a + b u + k (u² + v²)/2 with curvature
//! k/√(1 + b² − 2ka): linear in a, b and k, and exact for circles. At a wall the circle leaves the contact point with the
//! angle θ of the wetting law, so that only its curvature and the place of the contact point along the wall are free.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use crate::math::{Vec2, perpendicular};

/// Fewest points of a free fit: three unknowns and some redundancy.
const FEWEST: usize = 5;

/// Angles nearer than this to 0 or 180 degrees have no contact point to hold on to, in rad.
const SMALLEST_ANGLE: f64 = 0.2;

/// Steps of the fixed-point iteration for the place of the contact point; each gains about a digit at small angles.
const ITERATIONS: usize = 12;

/// A point of the window relative to the nearest one, with its weight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    pub(super) index: usize,
    pub(super) x: Vec2,
    pub(super) weight: f64,
}

/// Least squares of v = a + b u + k (u² + v²)/2 in the frame of `normal`; the curvature is k/√(1 + b² − 2ka).
pub(super) fn free_fit(near: &[Near], normal: Vec2) -> Option<f64> {
    if near.len() < FEWEST {
        return None;
    }
    let tangent = -perpendicular(normal);
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for q in near {
        let (u, v) = (q.x.dot(&tangent), q.x.dot(&normal));
        let row = Vector3::new(1.0, u, 0.5 * (u * u + v * v));
        matrix += q.weight * row * row.transpose();
        right += q.weight * v * row;
    }
    let solution = matrix.cholesky()?.solve(&right);
    let (a, b, k) = (solution[0], solution[1], solution[2]);
    let square = 1.0 + b * b - 2.0 * k * a;
    (square > 0.0).then(|| k / square.sqrt())
}

/// Curvature of the circle that leaves the wall at `contact` + δ ν with the `angle` (rad), and δ in m, which is fitted too.
///
/// `contact` in m from the point that `near` is relative to; ν along the wall and its normal.
pub(super) fn fit_from_contact(
    near: &[Near],
    contact: Vec2,
    (outwards, normal): (Vec2, Vec2),
    angle: f64,
) -> Option<(f64, f64)> {
    let angle = angle.clamp(SMALLEST_ANGLE, std::f64::consts::PI - SMALLEST_ANGLE);
    let n_e = -angle.sin() * outwards - angle.cos() * normal;
    let t_e = angle.sin() * normal - angle.cos() * outwards;
    let (mut delta, mut kappa) = (0.0, None);
    for _ in 0..ITERATIONS {
        let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
        for q in near {
            let x = q.x - contact;
            let v_0 = x.dot(&n_e);
            let (u, v) = (x.dot(&t_e) + delta * angle.cos(), v_0 + delta * angle.sin());
            let row = Vector2::new(1.0, 0.5 * (u * u + v * v));
            matrix += q.weight * row * row.transpose();
            right += q.weight * v_0 * row;
        }
        let solution = matrix.cholesky()?.solve(&right);
        delta = -solution[0] / angle.sin();
        kappa = Some((solution[1], delta));
    }
    kappa
}

/// Angle in rad at which the circle through `anchor` (m, from the point that `near` is relative to) meets the wall with the
/// normal `wall`; `normal` is about that of the interface.
///
/// Least squares of v = b u + k (u² + v²)/2 about the anchor: the normal there is (−b, 1)/√(1 + b²).
pub(super) fn angle_through(near: &[Near], anchor: Vec2, normal: Vec2, wall: Vec2) -> Option<f64> {
    let tangent = -perpendicular(normal);
    let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for q in near {
        let x = q.x - anchor;
        let (u, v) = (x.dot(&tangent), x.dot(&normal));
        let row = Vector2::new(u, 0.5 * (u * u + v * v));
        matrix += q.weight * row * row.transpose();
        right += q.weight * v * row;
    }
    let slope = matrix.cholesky()?.solve(&right)[0];
    let at_anchor = (normal - slope * tangent).normalize();
    Some((-at_anchor.dot(&wall)).clamp(-1.0, 1.0).acos())
}
