//! Wall boundary conditions: no slip, and extrapolation of fields from the fluid into the wall particles.

pub(crate) mod no_slip;
pub(crate) mod shepard;
