//! Pore networks: extraction from the exact geometry, menisci in throats, displacement, conductance and permeability.

mod channel;
pub mod conductance;
pub mod cycles;
pub mod displacement;
pub mod extract;
pub mod graph;
pub mod menisci;
pub mod permeability;
pub mod setup;
pub mod solver;

mod flow;
mod layers;
mod measures;
mod merge;
mod openpnm;
mod pictures;
mod summary;
mod tables;

pub use extract::{ExtractError, extract};
pub use summary::geometry_hash;
