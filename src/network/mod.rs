//! Pore networks: extraction from the exact geometry, menisci in throats, displacement, conductance and permeability.

pub mod extract;
pub mod graph;
mod merge;

pub use extract::{ExtractError, extract};
