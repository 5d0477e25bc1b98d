//! Flexible preconditioned conjugate gradients (Notay 2000) with one dot product more than the plain form, since the
//! K-cycle of the pressure is not a fixed linear map. Unknowns are numbers (pressure) or vectors of the plane (viscosity).

use std::ops::{Add, AddAssign, Div, Mul, Sub, SubAssign};

use rayon::prelude::*;

use crate::math::Vec2;
use crate::sph::parallel::{GRAIN, total};

/// Below this relative residual the recursion's r drifts away from b − M x by rounding: it is computed anew before it is
/// believed, and after so many iterations.
const BELIEVED: f64 = 1e-9;
const ANEW_AFTER: usize = 5;

/// A residual computed anew that is not below this share of the one before is all that rounding allows.
const PROGRESS: f64 = 0.5;

/// One unknown: a number, or a vector of the plane.
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
    /// Nothing.
    const ZERO: Self;

    /// Number of components.
    const COMPONENTS: usize;

    /// Component `k`.
    fn component(&self, k: usize) -> f64;

    /// The unknown with these components.
    fn from_components(component: impl Fn(usize) -> f64) -> Self;

    /// The product of both; of vectors the inner one.
    fn times(&self, other: &Self) -> f64;
}

impl Unknown for f64 {
    const ZERO: Self = 0.0;
    const COMPONENTS: usize = 1;

    fn component(&self, _: usize) -> f64 {
        *self
    }

    fn from_components(component: impl Fn(usize) -> f64) -> Self {
        component(0)
    }

    fn times(&self, other: &Self) -> f64 {
        self * other
    }
}

impl Unknown for Vec2 {
    const ZERO: Self = Self::new(0.0, 0.0);
    const COMPONENTS: usize = 2;

    fn component(&self, k: usize) -> f64 {
        self[k]
    }

    fn from_components(component: impl Fn(usize) -> f64) -> Self {
        Self::new(component(0), component(1))
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
    /// Iterations done.
    pub iterations: usize,
    /// |b − M x|/|b|.
    pub residual: f64,
}

/// When the iteration stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Largest |b − M p|/|b|.
    pub residual: f64,
    /// Most iterations.
    pub iterations: usize,
}

/// Solves M x = b from the given x until |b − M x| is within the tolerance.
///
/// `b` must be in the range of M: of a pressure, sum zero over each part without a fixed value. `precondition(r, z)` sets z ≈ M⁻¹ r.
/// Where rounding allows no smaller residual the iteration stops early.
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
        return Convergence { iterations: 0, residual: 0.0 };
    }
    let [mut r, mut z, mut p, mut q, mut before] = [const { Vec::new() }; 5].map(|_: Vec<T>| vec![T::ZERO; n]);
    matrix.residual(b, x, &mut r);
    let (mut rho, mut iterations) = (1.0, 0);
    let (mut age, mut last_fresh, mut best) = (0, f64::INFINITY, Vec::new());
    loop {
        let mut residual = dot(&r, &r).sqrt() / size;
        let is_due = residual <= tolerance || age >= ANEW_AFTER;
        if is_due && age > 0 && residual < BELIEVED && tolerance < BELIEVED {
            matrix.residual(b, x, &mut r);
            residual = dot(&r, &r).sqrt() / size;
            age = 0;
            if residual > PROGRESS * last_fresh {
                // On rounding alone the iteration can lead away again.
                if residual > last_fresh {
                    x.copy_from_slice(&best);
                    residual = last_fresh;
                }
                return Convergence { iterations, residual };
            }
            last_fresh = residual;
            best = x.to_vec();
        }
        if residual <= tolerance || iterations == most || !residual.is_finite() {
            return Convergence { iterations, residual };
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

/// Changes each of `to` with its partner in `by`, in parallel.
fn with<T: Unknown>(to: &mut [T], by: &[T], change: impl Fn(&mut T, &T) + Sync) {
    to.par_iter_mut().zip(by).with_min_len(GRAIN).for_each(|(to, by)| change(to, by));
}
