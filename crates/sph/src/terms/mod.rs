//! The terms of the method, one function each: those of the paper with sums over pairs as printed, and those of others.
//!
//! Fields are slices with one entry per particle and image. Where the paper's sum runs over fluid particles only, the
//! function takes `fluid_volume`: V_b on fluid, 0 on walls.

pub(crate) mod average;
pub mod color;
pub mod curvature;
pub mod density;
pub mod divergence;
pub(crate) mod poisson;
pub mod pressure_gradient;
pub(crate) mod sharpening;
pub mod shifting;
pub mod surface_tension;
pub mod transposed_stress;
pub mod viscosity;
