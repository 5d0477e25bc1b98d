//! Sparse Cholesky factorization by faer for small systems; the symbolic factorization is reused while the pattern is unchanged.

use std::sync::Arc;

use faer::prelude::*;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};

use crate::poisson::matrix::Matrix;
use meniscus_core::math::factor_in_one_thread;

/// A direct solver that caches the elimination order of the last pattern.
#[derive(Default)]
pub(crate) struct SparseCholesky {
    pattern: (Arc<Vec<usize>>, Arc<Vec<u32>>),
    symbolic: Option<SymbolicLlt<usize>>,
}

/// The factorization failed, with the message of the library.
#[derive(Debug, thiserror::Error)]
#[error("sparse Cholesky factorization: {0}")]
pub(crate) struct FactorizationError(String);

impl SparseCholesky {
    /// Solves M x = b. Each `part` without `has_dirichlet` is made definite at its first unknown, see [`Unknowns`](super::Unknowns).
    ///
    /// # Errors
    /// [`FactorizationError`] if the matrix is not positive definite then.
    pub(crate) fn solve(
        &mut self,
        matrix: &Matrix,
        part: &[u32],
        has_dirichlet: &[bool],
        b: &[f64],
        x: &mut [f64],
    ) -> Result<(), FactorizationError> {
        factor_in_one_thread();
        let lower = lower_triangle(matrix, part, has_dirichlet)?;
        let failed = |e: &dyn std::fmt::Debug| FactorizationError(format!("{e:?}"));
        if self.pattern.0 != matrix.start || self.pattern.1 != matrix.column {
            self.symbolic = None;
            self.pattern = (matrix.start.clone(), matrix.column.clone());
        }
        let symbolic = match self.symbolic.clone() {
            Some(symbolic) => symbolic,
            None => SymbolicLlt::try_new(lower.symbolic(), Side::Lower).map_err(|e| failed(&e))?,
        };
        self.symbolic = Some(symbolic.clone());
        let factor = Llt::try_new_with_symbolic(symbolic, lower.as_ref(), Side::Lower).map_err(|e| failed(&e))?;
        let solution = factor.solve(Col::from_fn(b.len(), |i| b[i]));
        x.iter_mut().enumerate().for_each(|(i, x)| *x = solution[i]);
        Ok(())
    }
}

fn lower_triangle(
    matrix: &Matrix,
    part: &[u32],
    has_dirichlet: &[bool],
) -> Result<SparseColMat<usize, f64>, FactorizationError> {
    let mut fixed = Vec::new();
    let mut entries = Vec::with_capacity(matrix.column.len() / 2 + matrix.rows());
    for (a, part) in part.iter().enumerate().take(matrix.rows()) {
        // Doubling one diagonal entry per part fixes the constant there and leaves the solution for b in the range of M otherwise unchanged.
        let first = !fixed.contains(&part) && !has_dirichlet.get(*part as usize).copied().unwrap_or(false);
        if first {
            fixed.push(part);
        }
        entries.push(Triplet::new(a, a, matrix.diagonal[a] * if first { 2.0 } else { 1.0 }));
        for (b, coupling) in matrix.row(a).filter(|&(b, _)| b <= a) {
            entries.push(Triplet::new(a, b, -coupling));
        }
    }
    SparseColMat::try_new_from_triplets(matrix.rows(), matrix.rows(), &entries)
        .map_err(|e| FactorizationError(format!("{e:?}")))
}
