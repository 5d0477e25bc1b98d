//! Multigrid by plain aggregation with a K-cycle, as preconditioner of conjugate gradients (Notay 2010, ETNA 37).
//!
//! Aggregates are squares of about 3 × 3 points, the coarse matrix sums the couplings between them, and the smoother is one forward and one backward
//! Gauss-Seidel sweep. All depends only on the matrix and the positions of the present step, so that a resumed run repeats it exactly. Blocks of fixed size
//! make the sweeps parallel with the same bits for any number of threads; since D ≥ Σ A the sweeps converge for any blocks.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rayon::prelude::*;

use crate::cells::members;
use crate::components::components;
use crate::conjugate_gradients::{SymmetricMatrix, Unknown};
use crate::parallel::total;
use crate::poisson::aggregation::{Aggregates, COARSENING};
use crate::poisson::matrix::Matrix;
use meniscus_core::math::Vec2;

/// A level of at most this many unknowns is solved by a dense factorization.
const DIRECT: usize = 150;

/// Rows of one Gauss-Seidel block.
const BLOCK: usize = 2048;

/// The second step of the K-cycle is skipped if the first reduced the residual below this fraction.
const GOOD_ENOUGH: f64 = 0.25;

/// Excess of the diagonal over the couplings, as a fraction of the diagonal, that counts as rounding: the component has no Dirichlet value.
const ROUNDING: f64 = 1e-10;

/// Number of parallel parts in which a coarse matrix is assembled; its rows do not depend on it.
const PARTS: usize = 16;

/// No index.
const NONE: usize = usize::MAX;

struct Level {
    matrix: Matrix,
    /// Aggregate of each unknown of the next finer level.
    aggregate: Vec<u32>,
}

/// The hierarchy of one matrix; the caller owns the finest matrix.
pub struct Multigrid {
    coarse: Vec<Level>,
    direct: Option<Cholesky<f64, Dyn>>,
}

impl Multigrid {
    /// Builds the hierarchy for `matrix`, whose unknowns lie at `points` about `spacing` (m) apart; `kind` as in `Aggregates::by_cell`.
    pub fn new(matrix: &Matrix, points: &[Vec2], kind: &[u8], spacing: f64) -> Self {
        let mut coarse: Vec<Level> = Vec::new();
        let (mut points, mut kind, mut width) = (points.to_vec(), kind.to_vec(), spacing);
        loop {
            let finest = coarse.last().map_or(matrix, |level| &level.matrix);
            if finest.rows() <= DIRECT {
                break;
            }
            width *= COARSENING;
            let aggregates = Aggregates::by_cell(&points, &kind, width);
            // Isolated points cannot be coarsened: stop once the cells are wide and still hardly join any.
            if aggregates.position.len() * 10 > finest.rows() * 9 && width > 1e3 * spacing {
                break;
            }
            let matrix = galerkin(finest, &aggregates.of, aggregates.position.len());
            (points, kind) = (aggregates.position, aggregates.kind);
            coarse.push(Level { matrix, aggregate: aggregates.of });
        }
        let coarsest = coarse.last().map_or(matrix, |level| &level.matrix);
        let direct = if coarsest.rows() <= 10 * DIRECT { factor(coarsest) } else { None };
        Self { coarse, direct }
    }

    /// z ≈ M⁻¹ r by one cycle from zero; vectors component by component, with common step lengths.
    pub fn precondition<T: Unknown>(&self, matrix: &Matrix, r: &[T], z: &mut [T]) {
        self.cycle(0, matrix, r, z);
    }

    /// z ≈ M⁻¹ r by one K-cycle from zero, from the level `depth` to the coarsest \[Notay2010\].
    fn cycle<T: Unknown>(&self, depth: usize, matrix: &Matrix, r: &[T], z: &mut [T]) {
        let Some(next) = self.coarse.get(depth) else {
            match &self.direct {
                Some(direct) => solve_dense(direct, r, z),
                None => forward_from_zero(matrix, r, z),
            }
            return;
        };
        forward_from_zero(matrix, r, z);
        let mut residual = vec![T::ZERO; r.len()];
        matrix.residual(r, z, &mut residual);
        let mut coarse_r = vec![T::ZERO; next.matrix.rows()];
        for (&value, &group) in residual.iter().zip(&next.aggregate) {
            coarse_r[group as usize] += value;
        }
        let coarse_z = self.inner(depth + 1, &next.matrix, &coarse_r);
        for (z, &group) in z.iter_mut().zip(&next.aggregate) {
            *z += coarse_z[group as usize];
        }
        residual.copy_from_slice(z);
        backward(matrix, r, &residual, z);
    }

    /// At most two steps of flexible conjugate gradients with the cycle of the level as preconditioner (Algorithm 3.2) \[Notay2010\].
    fn inner<T: Unknown>(&self, depth: usize, matrix: &Matrix, b: &[T]) -> Vec<T> {
        let n = b.len();
        let mut c = vec![T::ZERO; n];
        self.cycle(depth, matrix, b, &mut c);
        if depth == self.coarse.len() {
            return c;
        }
        let mut v = vec![T::ZERO; n];
        matrix.apply(&c, &mut v);
        let (rho, alpha) = (dot(&c, &v), dot(&c, b));
        if !(rho > 0.0) {
            return c;
        }
        let after_one_step = |c: Vec<T>| c.iter().map(|c| *c * (alpha / rho)).collect();
        let r: Vec<T> = b.iter().zip(&v).map(|(b, v)| *b - *v * (alpha / rho)).collect();
        if dot(&r, &r) <= GOOD_ENOUGH * GOOD_ENOUGH * dot(b, b) {
            return after_one_step(c);
        }
        let (mut d, mut w) = (vec![T::ZERO; n], vec![T::ZERO; n]);
        self.cycle(depth, matrix, &r, &mut d);
        matrix.apply(&d, &mut w);
        let (gamma, beta, alpha2) = (dot(&d, &v), dot(&d, &w), dot(&d, &r));
        let rho2 = beta - gamma * gamma / rho;
        if !(rho2 > 0.0) {
            return after_one_step(c);
        }
        let (x, y) = (alpha / rho - gamma * alpha2 / (rho * rho2), alpha2 / rho2);
        c.iter_mut().zip(&d).for_each(|(c, d)| *c = *c * x + *d * y);
        c
    }

    /// Memory in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.coarse.iter().map(|level| level.matrix.bytes() + level.aggregate.len() * 4).sum()
    }
}

fn dot<T: Unknown>(a: &[T], b: &[T]) -> f64 {
    total(a.len(), |i| a[i].times(&b[i]))
}

/// z = M⁻¹ r by the dense factor, component by component.
fn solve_dense<T: Unknown>(factor: &Cholesky<f64, Dyn>, r: &[T], z: &mut [T]) {
    let mut zero = T::ZERO;
    let right = DMatrix::from_fn(r.len(), zero.components().len(), |a, k| {
        let mut value = r[a];
        value.components()[k]
    });
    let solution = factor.solve(&right);
    for (a, z) in z.iter_mut().enumerate() {
        z.components().iter_mut().enumerate().for_each(|(k, z)| *z = solution[(a, k)]);
    }
}

/// Pᵀ M P for piecewise constant P: couplings between aggregates are summed, those within one cancel.
fn galerkin(fine: &Matrix, aggregate: &[u32], count: usize) -> Matrix {
    let (start, members) = members(aggregate, count);
    let groups: Vec<usize> = (0..count).collect();
    let parts: Vec<Rows> = groups
        .par_chunks(count.div_ceil(PARTS).max(1))
        .map(|groups| {
            let mut rows = Rows { index: vec![NONE; count], ..Rows::default() };
            groups
                .iter()
                .for_each(|&g| rows.push(fine, aggregate, g, &members[start[g] as usize..start[g + 1] as usize]));
            rows
        })
        .collect();
    let mut starts = vec![0];
    for length in parts.iter().flat_map(|part| &part.length) {
        starts.push(starts[starts.len() - 1] + length);
    }
    Matrix {
        start: Arc::new(starts),
        column: Arc::new(parts.iter().flat_map(|part| &part.column).copied().collect()),
        coupling: parts.iter().flat_map(|part| &part.coupling).map(|coupling| *coupling as f32).collect(),
        diagonal: parts.iter().flat_map(|part| &part.diagonal).copied().collect(),
    }
}

/// Consecutive rows of a coarse matrix.
#[derive(Default)]
struct Rows {
    length: Vec<usize>,
    column: Vec<u32>,
    coupling: Vec<f64>,
    diagonal: Vec<f64>,
    /// Index of the last coupling to each aggregate.
    index: Vec<usize>,
}

impl Rows {
    /// Appends the row of the aggregate `group` with its `members`.
    fn push(&mut self, fine: &Matrix, aggregate: &[u32], group: usize, members: &[u32]) {
        let first = self.column.len();
        // Excess of the diagonal over the couplings, from Dirichlet values.
        let mut excess = 0.0;
        for &a in members {
            let mut coupled = 0.0;
            for (b, value) in fine.row(a as usize) {
                coupled += value;
                let other = aggregate[b] as usize;
                let index = self.index[other];
                if other == group {
                    continue;
                }
                if index != NONE && index >= first {
                    self.coupling[index] += value;
                } else {
                    self.index[other] = self.column.len();
                    self.column.push(other as u32);
                    self.coupling.push(value);
                }
            }
            excess += fine.diagonal[a as usize] - coupled;
        }
        // The couplings as rounded in storage: a row without Dirichlet values sums to zero.
        let stored: f64 = self.coupling[first..].iter().map(|coupling| f64::from(*coupling as f32)).sum();
        self.diagonal.push(excess + stored);
        self.length.push(self.column.len() - first);
    }
}

/// The dense factor, with the diagonal entry of the first unknown of each connected component without a Dirichlet value doubled.
///
/// That makes the matrix positive definite and does not change the solution, up to a constant, for right-hand sides with zero sum over each component. A small
/// shift of the whole diagonal would instead amplify the rounding of that sum to a large constant, whose own rounding would limit conjugate gradients to 1e-8.
fn factor(matrix: &Matrix) -> Option<Cholesky<f64, Dyn>> {
    let n = matrix.rows();
    let mut dense = DMatrix::from_diagonal(&DVector::from_column_slice(&matrix.diagonal));
    let part = components(n, |a| matrix.row(a).map(|(b, _)| b));
    let mut excess = vec![(0.0, 0.0); n];
    for a in 0..n {
        let coupled: f64 = matrix.row(a).map(|(_, coupling)| coupling).sum();
        let (sum, size) = &mut excess[part[a] as usize];
        *sum += matrix.diagonal[a] - coupled;
        *size += matrix.diagonal[a];
    }
    let mut next = 0;
    for a in 0..n {
        // Components are numbered in the order of their first unknowns.
        if part[a] == next {
            let (sum, size) = excess[next as usize];
            if sum <= ROUNDING * size {
                dense[(a, a)] *= 2.0;
            }
            next += 1;
        }
        for (b, coupling) in matrix.row(a) {
            dense[(a, b)] -= coupling;
        }
    }
    Cholesky::new(dense)
}

/// z = (D − L)⁻¹ r, block by block: a forward Gauss-Seidel sweep from zero.
fn forward_from_zero<T: Unknown>(matrix: &Matrix, r: &[T], z: &mut [T]) {
    z.par_chunks_mut(BLOCK).enumerate().for_each(|(block, z)| {
        // Later rows are zero: adding them costs less than testing for them.
        z.fill(T::ZERO);
        let first = block * BLOCK;
        for i in 0..z.len() {
            let a = first + i;
            let known = matrix.coupled_by(a, |b| *z.get(b.wrapping_sub(first)).unwrap_or(&T::ZERO));
            z[i] = (r[a] + known) / matrix.diagonal[a];
        }
    });
}

/// A backward Gauss-Seidel sweep from `old`, block by block, with the old values of other blocks.
fn backward<T: Unknown>(matrix: &Matrix, r: &[T], old: &[T], z: &mut [T]) {
    z.par_chunks_mut(BLOCK).enumerate().for_each(|(block, z)| {
        let first = block * BLOCK;
        for i in (0..z.len()).rev() {
            let a = first + i;
            let coupled = matrix.coupled_by(a, |b| *z.get(b.wrapping_sub(first)).unwrap_or(&old[b]));
            z[i] = (r[a] + coupled) / matrix.diagonal[a];
        }
    });
}
