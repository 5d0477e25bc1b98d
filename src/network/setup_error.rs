//! Why a network cannot be set up.

use super::ExtractError;
use crate::geometry::GeometryError;

/// A network that cannot be set up.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// The shapes make no sense.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// The pores cannot be told apart.
    #[error("{0}")]
    Extract(#[from] ExtractError),
    /// Entry pressures that were measured in another geometry.
    #[error(
        "the measured entry pressures (network.measured) are those of another geometry: its hash is {expected}, that of this one is {found}; measure \
         them anew with `meniscus network verify`, or leave the key out"
    )]
    OtherGeometry {
        /// Hash of the geometry that they were measured in.
        expected: String,
        /// Hash of this one.
        found: String,
    },
    /// The domain is solid.
    #[error("there is no pore in the domain: the solids fill all of it")]
    NoPore,
    /// A state that does not belong to the network.
    #[error(
        "the state in {} (network.initial) has {found} elements, and this network has {expected}: {why}; run this case without \
         network.initial, and take a state that it writes", file.display()
    )]
    OtherState {
        /// Its file.
        file: std::path::PathBuf,
        /// Its elements.
        found: usize,
        /// Those of the network.
        expected: usize,
        /// What is different.
        why: &'static str,
    },
    /// A displacement in time begins with more of the invading phase than its pores at the inlet hold.
    #[error(
        "at the beginning the invading phase would hold {asked:.4} of the pore space (network.dynamic.initial-saturation), and the pores that are open at \
         the inlet are {found:.4} of it; take a share from 0 to that, or leave the key out: these pores are full then"
    )]
    InletTooSmall {
        /// Share that is asked for.
        asked: f64,
        /// That of the pores at the inlet.
        found: f64,
    },
    /// An open side is closed by solids.
    #[error(
        "no pore opens at the side `{side}`, which is the {role} (network.{role}): solids close all of it; choose another side, or \
         cut the shapes there with a smaller domain"
    )]
    NoOpening {
        /// The side.
        side: &'static str,
        /// `inlet` or `outlet`.
        role: &'static str,
    },
}

impl SetupError {
    /// The key of the case that a user would change.
    pub(crate) fn key(&self) -> String {
        match self {
            Self::Extract(ExtractError::NotOpen { .. }) => "network".to_owned(),
            Self::Geometry(_) | Self::Extract(_) | Self::NoPore => "geometry".to_owned(),
            Self::OtherGeometry { .. } => "network.measured".to_owned(),
            Self::OtherState { .. } => "network.initial".to_owned(),
            Self::InletTooSmall { .. } => "network.dynamic.initial-saturation".to_owned(),
            Self::NoOpening { role, .. } => format!("network.{role}"),
        }
    }
}
