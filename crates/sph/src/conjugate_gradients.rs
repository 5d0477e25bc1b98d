//! Flexible preconditioned conjugate gradients (Notay 2000), with one dot product more than the standard form, since the
//! K-cycle of the pressure is not a fixed linear map. Unknowns are scalars (pressure) or vectors in the plane (viscosity).

use std::ops::{Add, AddAssign, Div, Mul, Sub, SubAssign};

use crate::parallel::{change_each, total};
use meniscus_core::math::Vec2;

/// Below this relative residual the recursive r drifts away from b − M x by rounding: it is recomputed before it counts as
/// converged, and after so many iterations.
const RELIABLE: f64 = 1e-9;
const RECOMPUTED_AFTER: usize = 5;

/// A recomputed residual that is not below this fraction of the one before has reached the limit set by rounding.
const PROGRESS: f64 = 0.5;

/// One unknown: a scalar, or a vector in the plane.
pub trait Unknown:
    Copy
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
    + AddAssign
    + SubAssign
{
    /// Zero.
    const ZERO: Self;

    /// Its components.
    fn components(&mut self) -> &mut [f64];

    /// The product; of vectors the inner product.
    fn times(&self, other: &Self) -> f64;
}

impl Unknown for f64 {
    const ZERO: Self = 0.0;

    fn components(&mut self) -> &mut [f64] {
        std::slice::from_mut(self)
    }

    fn times(&self, other: &Self) -> f64 {
        self * other
    }
}

impl Unknown for Vec2 {
    const ZERO: Self = Self::new(0.0, 0.0);

    fn components(&mut self) -> &mut [f64] {
        self.as_mut_slice()
    }

    fn times(&self, other: &Self) -> f64 {
        self.dot(other)
    }
}

/// A symmetric positive (semi)definite matrix M.
pub trait SymmetricMatrix<T> {
    /// y = M x.
    fn apply(&self, x: &[T], y: &mut [T]);

    /// r = b − M x.
    fn residual(&self, b: &[T], x: &[T], r: &mut [T]);
}

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convergence {
    /// Number of iterations.
    pub iterations: usize,
    /// |b − M x|/|b|.
    pub residual: f64,
    /// The largest residual that was asked for.
    pub tolerance: f64,
}

impl Convergence {
    /// Whether the residual is within the tolerance.
    pub fn is_reached(&self) -> bool {
        self.residual <= self.tolerance
    }
}

/// Stopping criterion of the iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Largest |b − M p|/|b|.
    pub residual: f64,
    /// Maximum number of iterations.
    pub iterations: usize,
}

/// Solves M x = b by flexible conjugate gradients \[Notay2000\], starting from the given x, until the residual b − M x is within the tolerance.
///
/// `b` must be in the range of M: for the pressure, zero sum over each component without a fixed value. `precondition(r, z)` sets z ≈ M⁻¹ r.
/// The iteration stops early where rounding allows no smaller residual.
pub fn conjugate_gradients<T: Unknown>(
    matrix: &impl SymmetricMatrix<T>,
    b: &[T],
    x: &mut [T],
    Tolerance { residual: tolerance, iterations: most }: Tolerance,
    precondition: impl Fn(&[T], &mut [T]),
) -> Convergence {
    let n = b.len();
    let dot = |a: &[T], b: &[T]| total(n, |i| a[i].times(&b[i]));
    let size = dot(b, b).sqrt();
    if size == 0.0 {
        x.fill(T::ZERO);
        return Convergence { iterations: 0, residual: 0.0, tolerance };
    }
    let [mut r, mut z, mut p, mut q, mut before] = [const { Vec::new() }; 5].map(|_: Vec<T>| vec![T::ZERO; n]);
    matrix.residual(b, x, &mut r);
    let (mut rho, mut iterations) = (1.0, 0);
    let (mut age, mut last_fresh, mut best) = (0, f64::INFINITY, Vec::new());
    loop {
        let mut residual = dot(&r, &r).sqrt() / size;
        let is_due = residual <= tolerance || age >= RECOMPUTED_AFTER;
        if is_due && age > 0 && residual < RELIABLE && tolerance < RELIABLE {
            matrix.residual(b, x, &mut r);
            residual = dot(&r, &r).sqrt() / size;
            age = 0;
            if residual > PROGRESS * last_fresh {
                // At the level of rounding the residual can grow again.
                if residual > last_fresh {
                    x.copy_from_slice(&best);
                    residual = last_fresh;
                }
                return Convergence { iterations, residual, tolerance };
            }
            last_fresh = residual;
            best = x.to_vec();
        }
        if residual <= tolerance || iterations == most || !residual.is_finite() {
            return Convergence { iterations, residual, tolerance };
        }
        precondition(&r, &mut z);
        let next = dot(&z, &r);
        let beta = if age == 0 { 0.0 } else { (next - dot(&z, &before)) / rho };
        rho = next;
        with(&mut p, &z, |p, z| *p = *z + *p * beta);
        matrix.apply(&p, &mut q);
        let alpha = rho / dot(&p, &q);
        before.copy_from_slice(&r);
        with(x, &p, |x, p| *x += *p * alpha);
        with(&mut r, &q, |r, q| *r -= *q * alpha);
        age += 1;
        iterations += 1;
    }
}

/// Updates each entry of `to` with the entry of `by` at the same index, in parallel.
fn with<T: Unknown>(to: &mut [T], by: &[T], change: impl Fn(&mut T, &T) + Sync) {
    change_each(to, |a, to| change(to, &by[a]));
}
