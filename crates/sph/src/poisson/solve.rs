//! One pressure solve: the right-hand side made compatible, the solver chosen by size, the residual computed.

use crate::conjugate_gradients::{Convergence, SymmetricMatrix, Tolerance, conjugate_gradients};
use crate::parallel::total;
use crate::poisson::cholesky::SparseCholesky;
use crate::poisson::matrix::Matrix;
use crate::poisson::multigrid::Multigrid;
use meniscus_core::math::Vec2;

/// Systems up to this size are solved directly; for larger ones the iteration is faster (benches/poisson.rs).
const SMALL: usize = 300;

/// Largest residual over that of the solution of the step before: far below the error of the time step, which is of the order of the change itself.
const CHANGE: f64 = 0.01;

/// Largest factor on the tolerance of a solution that changes.
const MOST: f64 = 100.0;

/// The matrix of the pressure equation, and the points of its unknowns for the multigrid.
pub struct Unknowns<'a> {
    /// M.
    pub matrix: &'a Matrix,
    /// Positions in m.
    pub position: &'a [Vec2],
    /// Light or heavy fluid or given pressure: aggregates contain one kind only.
    pub kind: &'a [u8],
    /// Connected component of the pore space, numbered from 0.
    pub part: &'a [u32],
    /// Whether a pressure is given somewhere in the component; `false` for components beyond the end.
    pub has_dirichlet: &'a [bool],
    /// Spacing of neighboring points in m.
    pub spacing: f64,
}

/// One right-hand side of the pressure equation and its solution.
pub struct System<'a> {
    /// Right-hand side.
    pub b: &'a mut [f64],
    /// Initial guess, then the solution.
    pub x: &'a mut [f64],
    /// The solution of the step before: the error may be [`CHANGE`] of the change since then. Empty where there is none.
    pub before: &'a [f64],
    /// Stopping criterion; of a solution that changes the largest residual is at most [`MOST`] times as large.
    pub tolerance: Tolerance,
}

impl System<'_> {
    /// The tolerance for the change since the step before, and the better initial guess in x: that given, or the solution of that step.
    fn prepare(&mut self, matrix: &Matrix) -> Tolerance {
        let mut r = vec![0.0; self.b.len()];
        let mut relative = |x: &[f64]| {
            matrix.residual(self.b, x, &mut r);
            norm(&r) / norm(self.b)
        };
        if self.before.is_empty() {
            return self.tolerance;
        }
        let (of_before, of_guess) = (relative(self.before), relative(self.x));
        if !(of_guess < of_before) {
            self.x.copy_from_slice(self.before);
        }
        let residual = self.tolerance.residual;
        Tolerance { residual: (CHANGE * of_before).clamp(residual, MOST * residual), ..self.tolerance }
    }
}

/// |v|.
fn norm(v: &[f64]) -> f64 {
    total(v.len(), |i| v[i] * v[i]).sqrt()
}

/// Solver of the pressure Poisson equation, reused from step to step.
#[derive(Default)]
pub struct PressureSolve {
    cholesky: SparseCholesky,
    /// Memory in bytes of the matrix of the last solve, without the shared pattern, and of its hierarchy.
    bytes: [usize; 2],
}

impl PressureSolve {
    /// Solves M x = b for each system in turn, from the initial guesses `x`.
    ///
    /// Without a given pressure b must sum to zero over each component; the remainder of the discrete divergence is distributed by `volume`.
    /// Then x has zero mean over each such component.
    pub fn solve(&mut self, unknowns: &Unknowns, volume: &[f64], systems: &mut [System]) -> Vec<Convergence> {
        let matrix = unknowns.matrix;
        self.bytes[0] = matrix.coupling.len() * 4 + matrix.rows() * 8;
        systems.iter_mut().for_each(|system| subtract_mean(unknowns, volume, system.b));
        let convergence = if matrix.rows() <= SMALL {
            systems.iter_mut().map(|system| self.solve_directly(unknowns, system)).collect()
        } else {
            self.iterate(unknowns, systems)
        };
        let ones = vec![1.0; volume.len()];
        systems.iter_mut().for_each(|system| subtract_mean(unknowns, &ones, system.x));
        convergence
    }

    fn solve_directly(&mut self, unknowns: &Unknowns, system: &mut System) -> Convergence {
        let (b, x) = (&*system.b, &mut *system.x);
        if self.cholesky.solve(unknowns.matrix, unknowns.part, unknowns.has_dirichlet, b, x).is_err() {
            return self.iterate(unknowns, std::slice::from_mut(system))[0];
        }
        let mut r = vec![0.0; b.len()];
        unknowns.matrix.residual(b, x, &mut r);
        let residual = if norm(b) > 0.0 { norm(&r) / norm(b) } else { 0.0 };
        Convergence { iterations: 1, residual, tolerance: system.tolerance.residual }
    }

    fn iterate(&mut self, unknowns: &Unknowns, systems: &mut [System]) -> Vec<Convergence> {
        let multigrid = Multigrid::new(unknowns.matrix, unknowns.position, unknowns.kind, unknowns.spacing);
        self.bytes[1] = multigrid.bytes();
        let solve = |system: &mut System| {
            let tolerance = system.prepare(unknowns.matrix);
            conjugate_gradients(unknowns.matrix, system.b, system.x, tolerance, |r, z| {
                multigrid.precondition(unknowns.matrix, r, z);
            })
        };
        systems.iter_mut().map(solve).collect()
    }

    /// Memory of the last solve in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.bytes.iter().sum()
    }
}

/// Subtracts `weight`·(Σ values/Σ weight) from the values of each component without a given pressure, so that they sum to zero over it.
fn subtract_mean(unknowns: &Unknowns, weight: &[f64], values: &mut [f64]) {
    let part = unknowns.part;
    let count = part.iter().max().map_or(0, |m| *m as usize + 1);
    let (mut sum, mut total) = (vec![0.0; count], vec![0.0; count]);
    for ((&part, value), weight) in part.iter().zip(values.iter()).zip(weight) {
        sum[part as usize] += value;
        total[part as usize] += weight;
    }
    for (sum, _) in sum.iter_mut().zip(unknowns.has_dirichlet).filter(|(_, has_dirichlet)| **has_dirichlet) {
        *sum = 0.0;
    }
    for ((&part, value), weight) in part.iter().zip(values.iter_mut()).zip(weight) {
        *value -= weight * sum[part as usize] / total[part as usize];
    }
}
