//! One pressure solve: the right side made compatible, the solver chosen by size, the result checked.

use crate::math::Vec2;
use crate::sph::conjugate_gradients::{Convergence, SymmetricMatrix, Tolerance, conjugate_gradients};
use crate::sph::parallel::total;
use crate::sph::poisson::cholesky::SparseCholesky;
use crate::sph::poisson::matrix::Matrix;
use crate::sph::poisson::multigrid::Multigrid;

/// Systems up to this size are solved directly. Above it the factorization costs more than the iteration (benches/poisson.rs).
const SMALL: usize = 300;

/// The matrix of the pressure equation, and the points of its unknowns for the multigrid.
pub struct Unknowns<'a> {
    /// M.
    pub matrix: &'a Matrix,
    /// Positions in m.
    pub position: &'a [Vec2],
    /// Light or heavy fluid or wall: coarse unknowns join one kind only.
    pub kind: &'a [u8],
    /// Part of the pore space, numbered from 0.
    pub part: &'a [u32],
    /// Whether a pressure is given somewhere in the part; parts beyond the end have none.
    pub has_dirichlet: &'a [bool],
    /// Distance of neighboring points in m.
    pub spacing: f64,
}

/// One right side of the pressure equation and its solution.
pub struct System<'a> {
    /// Right side.
    pub b: &'a mut [f64],
    /// First guess, then the solution.
    pub x: &'a mut [f64],
    /// When its iteration stops.
    pub tolerance: Tolerance,
}

/// Solves the pressure Poisson equation step after step.
#[derive(Default)]
pub struct PressureSolve {
    cholesky: SparseCholesky,
    /// Bytes that the last solve held in its matrix, without the pattern that it shares, and in its hierarchy.
    bytes: [usize; 2],
}

impl PressureSolve {
    /// Solves M x = b, one system after the other, from the first guesses `x`.
    ///
    /// Without a given pressure b must sum to zero over each part; what is left over by the discrete divergence is spread by `volume`.
    /// Then x has mean zero over each such part.
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
        let norm = |v: &[f64]| total(v.len(), |i| v[i] * v[i]).sqrt();
        let residual = if norm(b) > 0.0 { norm(&r) / norm(b) } else { 0.0 };
        Convergence { iterations: 1, residual }
    }

    fn iterate(&mut self, unknowns: &Unknowns, systems: &mut [System]) -> Vec<Convergence> {
        let multigrid = Multigrid::new(unknowns.matrix, unknowns.position, unknowns.kind, unknowns.spacing);
        self.bytes[1] = multigrid.bytes();
        let solve = |System { b, x, tolerance }: &mut System| {
            conjugate_gradients(unknowns.matrix, b, x, *tolerance, |r, z| {
                multigrid.precondition(unknowns.matrix, r, z);
            })
        };
        systems.iter_mut().map(solve).collect()
    }

    /// Bytes that the last solve held.
    pub(crate) fn bytes(&self) -> usize {
        self.bytes.iter().sum()
    }
}

/// Takes `weight`·(Σ values/Σ weight) off the values of each part without a given pressure, so that they sum to zero over it.
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
