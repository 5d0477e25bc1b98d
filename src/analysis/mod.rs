//! Measurement: pure functions on points, fields and closures. No solver, no file, no geometry type.
//!
//! The way of a measurement: particles are resampled onto a regular grid ([`resample`]), the c = 0.5 contour of the
//! smoothed color is traced ([`contour`]), circles, or under a body force arcs of Young and Laplace, are fitted to it ([`circle`], [`arc`]) and extrapolated to the wall, where
//! they give the contact angle with an error bar ([`contact`]). Sums over particles are in [`phases`], [`blobs`] and
//! [`moments`], oscillations are fitted by [`damped`], closed forms to compare with in [`laws`] and [`young_laplace`], observed orders in [`convergence`].

pub mod arc;
pub mod blobs;
pub mod cells;
pub mod circle;
pub mod contact;
pub mod contour;
pub mod convergence;
pub mod damped;
pub mod lattice;
pub mod laws;
pub mod lines;
pub mod meniscus;
pub mod moments;
pub mod near_level;
pub mod phases;
pub mod resample;
pub mod resolution;
pub mod roots;
pub mod wall;
pub mod young_laplace;

pub use wall::WallPoint;
