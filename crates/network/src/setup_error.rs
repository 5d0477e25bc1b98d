//! Errors in the setup of a network, with the responsible key of the case.

use super::ExtractError;
use meniscus_geometry::GeometryError;

/// Why a network cannot be set up.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// The shapes are invalid.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// The network cannot be extracted.
    #[error("{0}")]
    Extract(#[from] ExtractError),
    /// Measured entry pressures belong to another geometry.
    #[error(
        "the measured entry pressures (network.measured) are those of another geometry: its hash is {expected}, that of this one is {found}; measure \
         them anew with `meniscus network verify`, or leave the key out"
    )]
    OtherGeometry {
        /// Hash of the geometry in which they were measured.
        expected: String,
        /// Hash of this one.
        found: String,
    },
    /// The domain is solid.
    #[error("there is no pore in the domain: the solids fill all of it")]
    NoPore,
    /// A saved state does not belong to the network.
    #[error(
        "the state in {} (network.initial) has {found} elements, and this network has {expected}: {why}; run this case without \
         network.initial, and take a state that it writes", file.display()
    )]
    OtherState {
        /// Its file.
        file: std::path::PathBuf,
        /// Its number of elements.
        found: usize,
        /// That of the network.
        expected: usize,
        /// The difference.
        why: &'static str,
    },
    /// The initial saturation of a dynamic displacement exceeds the pores at the inlet.
    #[error(
        "at the beginning the invading phase would hold {asked:.4} of the pore space (network.dynamic.initial-saturation), and the pores that are open at \
         the inlet are {found:.4} of it; take a share from 0 to that, or leave the key out: these pores are full then"
    )]
    InletTooSmall {
        /// Requested saturation.
        asked: f64,
        /// Share of the pores at the inlet.
        found: f64,
    },
    /// A region of saturations without a pore that counts.
    #[error(
        "there is no pore space in the region from {min:?} to {max:?} m (network.region) but what opens at the inlet or the outlet; choose a larger region, \
         or one with pores"
    )]
    EmptyRegion {
        /// Its lower left corner.
        min: [f64; 2],
        /// Its upper right corner.
        max: [f64; 2],
    },
    /// The disc that is the inlet lies within solids.
    #[error(
        "no pore lies under the disc at {center:?} m with the radius {radius:e} m, which is the inlet (network.inlet-disc): solids close all of it; \
         move it, make it larger, or exchange solid and pore (`invert`)"
    )]
    NoPoreUnderDisc {
        /// Its center in m.
        center: [f64; 2],
        /// Its radius in m.
        radius: f64,
    },
    /// An open side is closed by solids.
    #[error(
        "no pore opens at the side `{side}`, which is the {role} (network.{role}): solids close all of it; choose another side, or \
         cut the shapes there with a smaller domain (`window`), or exchange solid and pore (`invert`)"
    )]
    NoOpening {
        /// The side.
        side: &'static str,
        /// `inlet` or `outlet`.
        role: &'static str,
    },
}

impl SetupError {
    /// The key of the case to change.
    pub fn key(&self) -> String {
        match self {
            Self::Extract(ExtractError::NotOpen { .. }) => "network".to_owned(),
            Self::Geometry(_) | Self::Extract(_) | Self::NoPore => "geometry".to_owned(),
            Self::OtherGeometry { .. } => "network.measured".to_owned(),
            Self::OtherState { .. } => "network.initial".to_owned(),
            Self::InletTooSmall { .. } => "network.dynamic.initial-saturation".to_owned(),
            Self::EmptyRegion { .. } => "network.region".to_owned(),
            Self::NoPoreUnderDisc { .. } => "network.inlet-disc".to_owned(),
            Self::NoOpening { role, .. } => format!("network.{role}"),
        }
    }
}
