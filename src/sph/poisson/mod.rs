//! The pressure Poisson equation: its matrix, and how it is solved.
//!
//! Small systems go to sparse Cholesky, all others to conjugate gradients with a multigrid cycle as preconditioner.

mod aggregation;
mod assemble;
mod cholesky;
mod dirichlet;
mod matrix;
mod multigrid;
mod solve;

pub use crate::sph::conjugate_gradients::Tolerance;
pub use assemble::{assemble, parts};
pub(crate) use dirichlet::impose;
pub use matrix::{Matrix, weighted_sum};
pub use multigrid::Multigrid;
pub use solve::{PressureSolve, System, Unknowns};
