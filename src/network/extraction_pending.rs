//! Stands in for the extraction until it is there.
use super::graph::{Network, Pores};
use crate::geometry::Geometry;

/// No network.
#[derive(Debug, thiserror::Error)]
#[error("the extraction is not there yet")]
pub struct ExtractError;

/// The network of a geometry.
///
/// # Errors
/// Always.
pub fn extract(_geometry: &Geometry, _open: [bool; 4]) -> Result<Network, ExtractError> {
    Err(ExtractError)
}

impl Pores {
    /// Regions as pores.
    #[must_use]
    pub fn merged(network: &Network, persistence: f64) -> Self {
        let count = network.regions.len();
        Self {
            persistence,
            pore_of: (0..count).collect(),
            main_region: (0..count).collect(),
            area: network.regions.iter().map(|region| region.area).collect(),
            throats: (0..network.throats.len()).collect(),
        }
    }
}
