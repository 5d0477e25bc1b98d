//! Sparse matrices with a sparsity pattern that is constant during a run: LU factors by faer, with one symbolic factorization.
//!
//! Duplicate entries are added. A matrix of rank one can be added to a factored matrix by the Sherman-Morrison formula.

use std::fmt;
use std::sync::Arc;

use faer::prelude::*;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{Argsort, Pair, SparseColMat, SymbolicSparseColMat};

use meniscus_core::math::factor_in_one_thread;

/// The index type of the library: half the memory of a machine word.
type Count = u32;
/// Maximum number of entries of a pattern, such that those of its factors can be indexed too.
const MOST_ENTRIES: usize = 1 << 28;

/// A matrix that is too large for the memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a sparse matrix of {0} rows does not fit into the memory")]
pub struct TooLarge(pub usize);

/// The sparsity pattern of a matrix with its elimination order.
#[derive(Clone)]
pub(crate) struct Pattern(Arc<Structure>);

struct Structure {
    matrix: SymbolicSparseColMat<Count>,
    order: Argsort<Count>,
    elimination: SymbolicLu<Count>,
}

/// The LU factors of a matrix S, or of S + u vᵀ.
#[derive(Debug, Clone)]
pub struct Factors {
    sparse: Lu<Count, f64>,
    rank_one: Option<RankOne>,
}

/// v, S⁻¹u and 1 + v·S⁻¹u.
#[derive(Debug, Clone)]
struct RankOne {
    row: Vec<f64>,
    solved: Vec<f64>,
    denominator: f64,
}

impl Pattern {
    /// The pattern of a square matrix whose entries are given as row and column, in the order of `indices`.
    pub(crate) fn new(size: usize, indices: impl IntoIterator<Item = (usize, usize)>) -> Result<Self, TooLarge> {
        factor_in_one_thread();
        let pair = |(row, column): (usize, usize)| Pair { row: row as Count, col: column as Count };
        let pairs: Vec<Pair<Count, Count>> = indices.into_iter().map(pair).collect();
        if size > MOST_ENTRIES || pairs.len() > MOST_ENTRIES {
            return Err(TooLarge(size));
        }
        let (matrix, order) =
            SymbolicSparseColMat::try_new_from_indices(size, size, &pairs).map_err(|_| TooLarge(size))?;
        let elimination = SymbolicLu::try_new(matrix.as_ref()).map_err(|_| TooLarge(size))?;
        Ok(Self(Arc::new(Structure { matrix, order, elimination })))
    }

    /// Factors of the matrix with these values in the order of the pattern; `None` if it is singular or not finite.
    pub(crate) fn factor(&self, values: &[f64]) -> Option<Factors> {
        let Structure { matrix, order, elimination } = self.0.as_ref();
        if !values.iter().all(|value| value.is_finite()) {
            return None;
        }
        let matrix = SparseColMat::new_from_argsort(matrix.clone(), order, values).ok()?;
        let sparse = Lu::try_new_with_symbolic(elimination.clone(), matrix.as_ref()).ok()?;
        Some(Factors { sparse, rank_one: None })
    }
}

impl fmt::Debug for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Pattern").field("size", &self.0.matrix.nrows()).finish_non_exhaustive()
    }
}

impl Factors {
    /// The factors with the matrix `column` `row`ᵀ added; `None` if the sum is singular.
    pub(crate) fn with_rank_one(mut self, mut column: Vec<f64>, row: Vec<f64>) -> Option<Self> {
        self.solve(&mut column);
        let denominator = 1.0 + dot(&row, &column);
        let regular = denominator.is_finite() && denominator.abs() > f64::EPSILON;
        self.rank_one = Some(RankOne { row, solved: column, denominator });
        regular.then_some(self)
    }

    /// Replaces `b` by the solution of the factored system.
    pub(crate) fn solve(&self, b: &mut [f64]) {
        self.sparse.solve_in_place(ColMut::from_slice_mut(b).as_mat_mut());
        if let Some(RankOne { row, solved, denominator }) = &self.rank_one {
            let share = dot(row, b) / denominator;
            b.iter_mut().zip(solved).for_each(|(value, solved)| *value -= share * solved);
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cyclic matrix without diagonal dominance, with every entry given in two parts.
    fn ring(size: usize) -> (Vec<(usize, usize)>, Vec<f64>) {
        let mut indices = Vec::new();
        let mut values = Vec::new();
        for row in 0..size {
            for offset in 0..5 {
                let column = (row + size + offset - 2) % size;
                let value = (1.0 + (3 * row * row + 7 * column + 5 * row * column) as f64).sin();
                indices.extend([(row, column); 2]);
                values.extend([0.3 * value, 0.7 * value]);
            }
        }
        (indices, values)
    }

    fn times(indices: &[(usize, usize)], values: &[f64], x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        indices.iter().zip(values).for_each(|(&(row, column), value)| product[row] += value * x[column]);
        product
    }

    fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_solved_system_gives_back_its_right_side_with_and_without_a_matrix_of_rank_one() {
        for size in [5, 12, 80] {
            let (indices, values) = ring(size);
            let x: Vec<f64> = (0..size).map(|i| 1.0 + (0.7 * i as f64).cos()).collect();
            // A pattern serves many matrices.
            let pattern = Pattern::new(size, indices.clone()).unwrap();
            for scale in [1.0e6, -2.5, 1.0] {
                let values: Vec<f64> = values.iter().map(|value| scale * value).collect();
                let factors = pattern.factor(&values).unwrap();
                let product = times(&indices, &values, &x);
                let mut solved = product.clone();
                factors.solve(&mut solved);
                // Rounding times a condition number of several thousand.
                assert!(largest_difference(&solved, &x) < 1.0e-10, "{size} {scale}");

                let column: Vec<f64> = (0..size).map(|i| scale * (1.1 * i as f64).sin()).collect();
                let row: Vec<f64> = (0..size).map(|i| (0.3 * i as f64).cos()).collect();
                let share = dot(&row, &x);
                let mut solved: Vec<f64> = product.iter().zip(&column).map(|(p, u)| p + share * u).collect();
                factors.with_rank_one(column, row).unwrap().solve(&mut solved);
                assert!(largest_difference(&solved, &x) < 1.0e-10, "{size} {scale}");
            }
        }
    }

    #[test]
    fn what_cannot_be_factored_is_refused() {
        let pattern = Pattern::new(2, [(0, 0), (1, 1), (0, 1)]).unwrap();
        assert!(pattern.factor(&[1.0, f64::NAN, 0.0]).is_none());
        assert!(pattern.factor(&[1.0, f64::INFINITY, 0.0]).is_none());
        assert!(Pattern::new(MOST_ENTRIES + 1, []).is_err());
        // The sum with u vᵀ is singular.
        let unit = pattern.factor(&[1.0, 1.0, 0.0]).unwrap();
        assert!(unit.with_rank_one(vec![1.0, 0.0], vec![-1.0, 0.0]).is_none());
    }
}
