//! Pore networks: extraction from the exact geometry, menisci in throats, displacement, conductance and permeability.

pub mod conductance;
pub mod graph;
pub mod menisci;
pub mod permeability;
