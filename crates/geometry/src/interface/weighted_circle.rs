//! Circles through weighted points by linear least squares: free, at a given angle to a wall, and through a given point.
//!
//! Unlike the fit of [`circle`](super::circle), which minimizes distances and has standard errors, this one is a linear solve for three unknowns, cheap
//! enough for every particle in every step; its weights let points enter and leave smoothly, and the contact angle can be prescribed.
//!
//! A circle through points (u, v) in the frame of tangent and normal obeys v = a + b u + k (u² + v²)/2 with curvature k/√(1 + b² − 2ka): linear in a, b and
//! k, and exact for circles. At a wall the circle leaves the contact point at the angle θ of the wetting law, so that only its curvature and the position of
//! the contact point along the wall are free.

use std::f64::consts::PI;

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use meniscus_core::math::{Vec2, perpendicular};

/// Minimum number of points of a free fit: three unknowns and some redundancy.
const FEWEST: usize = 5;

/// Maximum number of Newton steps for the contact point; a few suffice.
const ITERATIONS: usize = 12;

/// The iteration for the contact point has converged when it moves by less than this fraction of the stencil.
const CONVERGED: f64 = 1e-9;

/// Minimum number of points of a fit from the wall: two unknowns and some redundancy. A fast line separates the particles at its tip, where few pairs span
/// the interface.
pub const FEWEST_FROM_CONTACT: usize = 3;

/// A point that a circle is fitted to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeightedPoint {
    /// Its index among the points of the interface.
    pub index: usize,
    /// Its position in m, relative to the origin of the fit.
    pub x: Vec2,
    pub weight: f64,
}

/// The circle v = a + b u + k (u² + v²)/2 in the frame of `tangent` and `normal`, with the origin of the points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeightedCircle {
    a: f64,
    b: f64,
    k: f64,
    tangent: Vec2,
    normal: Vec2,
}

impl WeightedCircle {
    /// Weighted least squares through `near` \[Pratt1987\], `None` for fewer than five points. `normal` is approximately that of the interface.
    pub fn through(near: &[WeightedPoint], normal: Vec2) -> Option<Self> {
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
        Some(Self { a: solution[0], b: solution[1], k: solution[2], tangent, normal })
    }

    /// k/√(1 + b² − 2ka) in 1/m, positive for a drop on the side of `normal`; `None` if there is no real circle.
    pub fn curvature(&self) -> Option<f64> {
        let square = 1.0 + self.b * self.b - 2.0 * self.k * self.a;
        (square > 0.0).then(|| self.k / square.sqrt())
    }

    /// The point of the circle nearest to `x` (m) and the unit normal there, `None` at the center \[Pratt1987\].
    ///
    /// F = a + b u + k (u² + v²)/2 − v is quadratic, and on the line through x along ∇F it is F − t|∇F| + k t²/2.
    pub fn closest_point(&self, x: Vec2) -> Option<(Vec2, Vec2)> {
        let slope = |u: f64, v: f64| Vec2::new(self.b + self.k * u, self.k * v - 1.0);
        let (u, v) = (x.dot(&self.tangent), x.dot(&self.normal));
        let off = self.a + self.b * u + 0.5 * self.k * (u * u + v * v) - v;
        let steep = slope(u, v).norm();
        let square = steep * steep - 2.0 * self.k * off;
        if steep == 0.0 || square < 0.0 {
            return None;
        }
        let t = 2.0 * off / (steep + square.sqrt());
        let closest = Vec2::new(u, v) - t / steep * slope(u, v);
        let normal = -slope(closest.x, closest.y).try_normalize(0.0)?;
        let turned = |y: Vec2| y.x * self.tangent + y.y * self.normal;
        Some((turned(closest), turned(normal)))
    }
}

/// Directions at a point of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallFrame {
    /// ν: unit vector along the wall, from the wetting to the other phase.
    pub outward: Vec2,
    /// Unit normal into the fluid.
    pub normal: Vec2,
}

/// Curvature of the circle that leaves the wall at `contact` + δ ν with the `angle` (rad), and δ in m, which is fitted too \[Pratt1987\].
///
/// `contact` in m relative to the origin of `near`. With the right contact point, the circle v = k (u² + v²)/2 passes through it; a fit of v = a + k (u² +
/// v²)/2 misses it by a, and Newton's method moves it until a = 0. At 0 and 180 degrees the circle is tangent to the wall: a shift δ along the wall changes v
/// by k u δ only, which is determined by the points farther from the wall. `None` if the points do not determine the fit.
pub fn fit_from_contact(near: &[WeightedPoint], contact: Vec2, wall: WallFrame, angle: f64) -> Option<(f64, f64)> {
    let WallFrame { outward, normal } = wall;
    let (sin, cos) = angle.clamp(0.0, PI).sin_cos();
    let extent = near.iter().map(|q| (q.x - contact).norm()).fold(0.0, f64::max);
    let mut delta = 0.0;
    let mut found = None;
    for _ in 0..ITERATIONS {
        let (mut matrix, mut missed, mut moved) = (Matrix2::zeros(), Vector2::zeros(), Vector2::zeros());
        for q in near {
            let x = q.x - contact;
            let (along, above) = (x.dot(&outward) - delta, x.dot(&normal));
            let row = Vector2::new(1.0, 0.5 * (along * along + above * above));
            matrix += q.weight * row * row.transpose();
            missed -= q.weight * (sin * along + cos * above) * row;
            moved += q.weight * along * row;
        }
        let matrix = matrix.cholesky()?;
        let [offset, kappa] = matrix.solve(&missed).into();
        found = Some(kappa);
        // Beyond the top of a low drop the circle would move backwards: there the slope from the angle alone is used.
        let slope = (sin + kappa * matrix.solve(&moved)[0]).max(0.5 * sin);
        let step = -offset / slope;
        if !(step.abs() > CONVERGED * extent) || !(slope > 0.0) {
            break;
        }
        delta += step.clamp(-0.5 * extent, 0.5 * extent);
    }
    found.map(|kappa| (kappa, delta))
}

/// Angle in rad at which the circle through `anchor` (m, relative to the origin of `near`) meets the wall with the normal `wall` \[Dussan1979\]. `normal` is
/// approximately that of the interface.
///
/// Least squares of v = b u + k (u² + v²)/2 about the anchor: the normal there is (−b, 1)/√(1 + b²). `None` if the points do not determine it.
pub fn angle_through(near: &[WeightedPoint], anchor: Vec2, normal: Vec2, wall: Vec2) -> Option<f64> {
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
