//! The Geometric Thin-Film Equation of Pang and Ó Náraigh 2022: droplets that spread on a flat wall.
//!
//! h_t = −∂ₓ( h h̄² ∂ₓ( h̄ₓₓ + ξ² h̄ ) ), h̄ = Φ∗h, by particles and by implicit finite differences. All but
//! the case and the output of the solver is dimensionless; [`scales`] stands between.

mod banded;
pub mod droplet;
pub mod equilibrium;
pub mod film;
pub mod finite_differences;
pub mod kernel;
mod measures;
pub mod ode;
pub mod particles;
pub mod profile;
pub mod scales;
pub mod setup;
pub mod solver;
pub mod sums;
