//! What walls do: no slip, and fields carried from the fluid into the wall particles.

pub mod no_slip;
pub mod shepard;
