//! `[thin-film]`: droplets on a flat wall. Keys as written, their checks, the checked film, and the film written out again.

mod bounds;
mod check;
pub mod checked;
mod droplets;
mod equation;
mod lattice;
mod method;
pub mod raw;
mod resolution;
mod resolve;
mod thinness;

pub(super) use check::thin_film;
pub(super) use resolve::raw as resolved;
