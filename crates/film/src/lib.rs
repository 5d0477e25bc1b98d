//! The Geometric Thin-Film Equation of Pang and Ó Náraigh 2022: droplets spreading on a flat wall.
//!
//! h_t = −∂ₓ( h h̄² ∂ₓ( h̄ₓₓ + (ξ² − Bo) h̄ ) ), h̄ = Φ∗h, by particles and by implicit finite differences; also the equations with a slip length and with a
//! precursor film, which regularize the contact line in other ways. Everything except the case and the output of the solver is dimensionless; [`scales`]
//! converts.
#![warn(unreachable_pub)]

pub mod backward_euler;
pub mod cells;
mod diagrams;
pub mod droplet;
pub mod equilibrium;
pub(crate) mod film;
mod grid;
pub mod grid_film;
pub(crate) mod history;
mod implicit_particles;
pub mod kernel;
mod measures;
mod model;
mod observed;
pub mod ode;
pub mod particles;
pub mod profile;
pub mod ring;
pub(crate) mod scales;
pub mod setup;
pub(crate) mod similarity;
pub(crate) mod solver;
pub(crate) mod sparse;
pub mod sums;
mod warnings;
