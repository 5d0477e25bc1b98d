//! The pressure Poisson equation: matrix and solvers.
//!
//! Small systems are solved by sparse Cholesky, all others by conjugate gradients with a multigrid cycle as preconditioner.

mod aggregation;
mod assemble;
mod cholesky;
mod dirichlet;
mod matrix;
mod multigrid;
mod solve;

pub use crate::conjugate_gradients::Tolerance;
pub use assemble::{assemble, parts};
pub(crate) use dirichlet::impose;
pub use matrix::{Matrix, weighted_sum};
pub use multigrid::Multigrid;
pub use solve::{PressureSolve, System, Unknowns};
