//! Measurement on particles, and exact solutions: pure functions on points, fields and closures. No solver, no file, no geometry type.
//!
//! Particles are interpolated onto any nodes ([`resample`]) that a contour needs ([`near_level`]), by the neighbors of a place ([`cells`]); sums over particles
//! ([`phases`]), connected parts ([`blobs`]) and parts that are not resolved ([`resolution`]). Observed orders of
//! convergence ([`convergence`]). Exact solutions: [`laws`] and [`young_laplace`], which find their [`roots`] by bisection.

pub mod blobs;
pub mod cells;
pub mod convergence;
pub mod laws;
pub mod near_level;
pub mod phases;
pub mod resample;
pub mod resolution;
pub mod roots;
pub mod young_laplace;
