//! Flexible preconditioned conjugate gradients (Notay 2000) with one dot product more than the plain form, since the
//! K-cycle is not a fixed linear map.

use crate::sph::pairs::total;
use crate::sph::poisson::Matrix;

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
    let mut rho = 1.0;
    for iterations in 0..=most {
        let residual = dot(&r, &r).sqrt() / size;
        if residual <= tolerance || iterations == most || !residual.is_finite() {
            return Convergence { iterations, residual };
        }
        precondition(&r, &mut z);
        let next = dot(&z, &r);
        let beta = if iterations == 0 { 0.0 } else { (next - dot(&z, &before)) / rho };
        rho = next;
        p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + beta * *p);
        matrix.apply(&p, &mut q);
        let alpha = rho / dot(&p, &q);
        before.copy_from_slice(&r);
        x.iter_mut().zip(&p).for_each(|(x, p)| *x += alpha * p);
        r.iter_mut().zip(&q).for_each(|(r, q)| *r -= alpha * q);
    }
    Convergence { iterations: most, residual: f64::NAN }
}
