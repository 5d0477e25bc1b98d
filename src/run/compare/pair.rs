//! A pair of network and direct simulation to compare, and why they cannot be compared.

use std::path::Path;

use crate::run::execute::{Mode, RunError};
use crate::run::setup::SetupError;
use meniscus_case::network::NetworkDisplacement;
use meniscus_case::{Case, Model};
use meniscus_core::input::Problem;
use meniscus_core::solver::SolverError;

/// A network and a direct simulation to compare.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<'a> {
    /// The case of the network.
    pub network: &'a Case,
    /// The case of the direct simulation.
    pub direct: &'a Case,
    /// Number of compared states of the direct simulation.
    pub records: usize,
}

impl Pair<'_> {
    /// Whether the displacement of the network is in time.
    pub(crate) fn is_in_time(&self) -> bool {
        self.displacement().is_some_and(|displacement| displacement.dynamic.is_some())
    }

    /// The displacement of the network.
    pub(crate) fn displacement(&self) -> Option<&NetworkDisplacement> {
        match &self.network.model {
            Model::Network(network) => network.displacement.as_ref(),
            _ => None,
        }
    }
}

/// A comparison in a folder.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Task<'a> {
    /// Both cases.
    pub(crate) pair: Pair<'a>,
    /// The case file of the direct simulation with all defaults filled in.
    pub(crate) resolved: &'a str,
    /// The folder, which exists.
    pub(crate) folder: &'a Path,
    /// Whether the direct simulation starts anew or is resumed.
    pub(crate) mode: Mode,
}

/// One of both cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Of {
    /// The network.
    Network,
    /// The direct simulation.
    Direct,
}

/// Two cases that cannot be compared, or a run that failed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CompareError {
    /// The first case is not a network with a displacement.
    #[error("expected a network with a displacement; give the case [network] with an inlet")]
    NoNetwork,
    /// The page has nothing to play.
    #[error("a comparison of two networks shows their pages; leave [network.results] out")]
    NoPage,
    /// The network counts only a part of the pore space.
    #[error("a comparison is at equal saturations of the whole pore space; leave [network.region] out")]
    Region,
    /// The second case is not a direct simulation of two fluids.
    #[error("expected a direct simulation of two fluids; give the case [sph] with both phases")]
    NoDirect,
    /// The cases have different geometries.
    #[error("the cases are not of one geometry: {0}; let both name the same shape file")]
    OtherGeometry(String),
    /// The cases have different sides.
    #[error(
        "the cases differ in the side `{side}`: of the network {misfit}; walls and periodic sides must be the same"
    )]
    OtherSides {
        /// The side.
        side: &'static str,
        /// The difference.
        misfit: String,
    },
    /// A case cannot be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The network failed.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The direct simulation failed.
    #[error("{0}")]
    Failed(String),
    /// It was stopped on request, and can be resumed.
    #[error("interrupted")]
    Interrupted,
    /// The folder of the direct simulation, or a file in it.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl CompareError {
    /// What is wrong with which of both cases, at the keys that a user would change; `None` if a run failed or was stopped.
    pub(crate) fn problems(&self) -> Option<(Of, Vec<Problem>)> {
        let direct = |key: &str| Some((Of::Direct, vec![Problem::of_text(key, &self.to_string())]));
        match self {
            Self::NoNetwork => Some((Of::Network, vec![Problem::of_text("network", &self.to_string())])),
            Self::NoPage => Some((Of::Network, vec![Problem::of_text("network.results", &self.to_string())])),
            Self::Region => Some((Of::Network, vec![Problem::of_text("network.region", &self.to_string())])),
            Self::NoDirect => direct("sph"),
            Self::OtherGeometry(_) => direct("geometry"),
            Self::OtherSides { side, .. } => direct(&format!("sph.sides.{side}")),
            Self::Setup(misfit @ SetupError::Network(_)) => Some((Of::Network, misfit.problems())),
            Self::Setup(misfit) => Some((Of::Direct, misfit.problems())),
            Self::Solver(_) | Self::Failed(_) | Self::Interrupted | Self::Run(_) => None,
        }
    }
}
