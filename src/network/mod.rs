//! Pore networks: extraction from the exact geometry, menisci in throats, displacement, conductance and permeability.

pub mod displacement;
pub mod graph;
pub mod menisci;
