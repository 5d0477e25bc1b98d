//! Steps of the particles by the library diffsol: ESDIRK34 for stiff films, Tsit45 as the explicit pair.
//!
//! The stiff method sees the recursive sums as further, algebraic unknowns: M y' = F(y), `system.rs`, handed to the library by
//! `operators.rs`. Each step begins from places, time and step alone, so that a resumed run gives the same bits; the library's multistep
//! method would lose its history. It leaves out the lattice energy, and takes the sums recursively.

mod operators;
mod steps;
mod system;

pub use steps::step;
