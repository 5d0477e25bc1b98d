//! A symmetric matrix with non-positive off-diagonal entries: that of Eq. (30) times −V_a, and its coarse-level versions.

use std::sync::Arc;

use crate::conjugate_gradients::{SymmetricMatrix, Unknown};
use crate::parallel::each;

/// Number of independent partial sums in [`weighted_sum`].
const LANES: usize = 4;

/// M = D − A with A ≥ 0 off the diagonal: (M x)_a = D_a x_a − Σ_b A_ab x_b. Columns may repeat within a row.
#[derive(Debug, Clone, Default)]
pub struct Matrix {
    /// Row starts, shared with the pairs from which the matrix was assembled; one more than rows.
    pub start: Arc<Vec<usize>>,
    /// Columns of the off-diagonal entries.
    pub column: Arc<Vec<u32>>,
    /// A_ab, the negative off-diagonal entries, in single precision: the rounded values define the matrix in all sums, to the last bit.
    pub coupling: Vec<f32>,
    /// D_a.
    pub diagonal: Vec<f64>,
}

impl Matrix {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.diagonal.len()
    }

    /// Columns and couplings of a row.
    #[inline]
    pub fn row(&self, a: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let row = self.start[a]..self.start[a + 1];
        self.column[row.clone()]
            .iter()
            .zip(&self.coupling[row])
            .map(|(&b, &coupling)| (b as usize, f64::from(coupling)))
    }

    /// Σ_b A_ab x_b.
    #[inline]
    pub(crate) fn coupled<T: Unknown>(&self, a: usize, x: &[T]) -> T {
        self.coupled_by(a, |b| x[b])
    }

    /// Σ_b A_ab x(b).
    #[inline]
    pub(crate) fn coupled_by<T: Unknown>(&self, a: usize, x: impl Fn(usize) -> T) -> T {
        let row = self.start[a]..self.start[a + 1];
        sum_of(&self.column[row.clone()], &self.coupling[row], x)
    }

    /// Memory in bytes, including a pattern shared with the pairs.
    pub(crate) fn bytes(&self) -> usize {
        self.start.len() * 8 + (self.column.len() + self.coupling.len()) * 4 + self.diagonal.len() * 8
    }
}

/// Σ_k w_k x_{b_k}.
#[inline]
pub fn weighted_sum<T: Unknown>(columns: &[u32], weights: &[f32], x: &[T]) -> T {
    sum_of(columns, weights, |b| x[b])
}

/// Σ_k w_k x(b_k), as four independent partial sums: in a single one each addition would wait for the one before.
#[inline]
fn sum_of<T: Unknown>(columns: &[u32], weights: &[f32], x: impl Fn(usize) -> T) -> T {
    let term = |(&b, &w): (&u32, &f32)| x(b as usize) * f64::from(w);
    let mut sums = [T::ZERO; LANES];
    let (columns, weights) = (columns.chunks_exact(LANES), weights.chunks_exact(LANES));
    let rest = columns.remainder().iter().zip(weights.remainder());
    for (columns, weights) in columns.zip(weights) {
        for (sum, pair) in sums.iter_mut().zip(columns.iter().zip(weights)) {
            *sum += term(pair);
        }
    }
    rest.for_each(|pair| sums[0] += term(pair));
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

impl<T: Unknown> SymmetricMatrix<T> for Matrix {
    fn apply(&self, x: &[T], y: &mut [T]) {
        each(y, |a| x[a] * self.diagonal[a] - self.coupled(a, x));
    }

    fn residual(&self, b: &[T], x: &[T], r: &mut [T]) {
        each(r, |a| b[a] - x[a] * self.diagonal[a] + self.coupled(a, x));
    }
}
