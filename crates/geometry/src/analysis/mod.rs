//! Measurements on particles: pure functions of points, fields and closures. No solver, no file, no geometry type.
//!
//! Interpolation of particles onto nodes ([`resample`]) near a contour ([`near_level`]), neighbor search ([`cells`]), sums over particles ([`phases`]), ganglia
//! ([`blobs`]) and unresolved parts ([`resolution`]). Observed orders of convergence ([`convergence`]), [`roots`] by bisection; moments, quantiles and Sobol
//! indices of [`samples`].

pub mod blobs;
pub(crate) mod cells;
pub mod convergence;
pub mod near_level;
pub mod phases;
pub mod resample;
pub mod resolution;
pub mod roots;
pub mod samples;
