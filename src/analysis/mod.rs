//! Measurement on particles: pure functions on points, fields and closures. No solver, no file, no geometry type.
//!
//! Particles are interpolated onto any nodes ([`resample`]) that a contour needs ([`near_level`]), by the neighbors of a place ([`cells`]); sums over particles
//! ([`phases`]), connected parts ([`blobs`]) and parts that are not resolved ([`resolution`]). Observed orders of
//! convergence ([`convergence`]), [`roots`] by bisection, moments, quantiles and Sobol indices of [`samples`].

pub(crate) mod blobs;
pub(crate) mod cells;
pub(crate) mod convergence;
pub(crate) mod near_level;
pub mod phases;
pub mod resample;
pub(crate) mod resolution;
pub(crate) mod roots;
pub(crate) mod samples;
