//! Incompressible SPH for two fluids with partial wetting.
