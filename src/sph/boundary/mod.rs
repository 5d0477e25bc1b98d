//! What walls do: no slip, and fields carried from the fluid into the wall particles.

pub(crate) mod no_slip;
pub(crate) mod shepard;
