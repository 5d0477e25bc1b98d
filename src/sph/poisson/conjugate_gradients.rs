//! Flexible preconditioned conjugate gradients (Notay 2000) with one dot product more than the plain form, since the
//! K-cycle is not a fixed linear map.

use crate::sph::pairs::total;
use crate::sph::poisson::Matrix;

/// Below this relative residual the recursion's r drifts away from b − M x by rounding: it is computed anew before it is
/// believed, and after so many iterations.
const BELIEVED: f64 = 1e-9;
const ANEW_AFTER: usize = 5;

/// A residual computed anew that is not below this share of the one before is all that rounding allows.
const PROGRESS: f64 = 0.5;

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convergence {
    /// Iterations done.
    pub iterations: usize,
    /// |b − M x|/|b|.
    pub residual: f64,
}

/// Solves M x = b from the given x until |b − M x| ≤ `tolerance` |b|, at most `most` iterations.
///
/// `b` must be in the range of M: sum zero over each part without a fixed value. `precondition(r, z)` sets z ≈ M⁻¹ r.
/// Where rounding allows no smaller residual the iteration stops early.
pub fn conjugate_gradients(
    matrix: &Matrix,
    b: &[f64],
    x: &mut [f64],
    (tolerance, most): (f64, usize),
    precondition: impl Fn(&[f64], &mut [f64]),
) -> Convergence {
    let n = b.len();
    let dot = |a: &[f64], b: &[f64]| total(n, |i| a[i] * b[i]);
    let size = dot(b, b).sqrt();
    if size == 0.0 {
        x.fill(0.0);
        return Convergence { iterations: 0, residual: 0.0 };
    }
    let [mut r, mut z, mut p, mut q, mut before] = [const { Vec::new() }; 5].map(|_: Vec<f64>| vec![0.0; n]);
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
        p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + beta * *p);
        matrix.apply(&p, &mut q);
        let alpha = rho / dot(&p, &q);
        before.copy_from_slice(&r);
        x.iter_mut().zip(&p).for_each(|(x, p)| *x += alpha * p);
        r.iter_mut().zip(&q).for_each(|(r, q)| *r -= alpha * q);
        age += 1;
        iterations += 1;
    }
}
