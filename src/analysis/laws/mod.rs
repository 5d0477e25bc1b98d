//! Closed forms to compare with: drops, menisci in pores, flows. Angles in rad through the wetting phase, lengths in m.

pub mod drops;
pub mod flow;
pub mod pores;
pub mod slit;
pub mod waves;
