//! Pore networks: extraction from the exact geometry, menisci in throats, displacement, conductance and permeability.

pub mod cycles;
pub mod displacement;
pub mod graph;
pub mod menisci;
pub mod setup;
pub mod solver;

mod extraction_pending;
mod layers;
mod measures;
mod openpnm;
mod pictures;
mod summary;
mod tables;
pub use extraction_pending::{ExtractError, extract};
