//! One drainage or imbibition: the invading phase, the conditions, and the end.

use super::displacement::Conditions;
use super::films::FilmTerms;
use meniscus_case::FluidPhase;
use meniscus_case::network::Stop;

/// One drainage or imbibition.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfCycle {
    /// The invading phase.
    pub invading: FluidPhase,
    /// Angles, open sides and the largest applied curvature.
    pub conditions: Conditions,
    /// Its early end.
    pub(crate) stop: Stop,
    /// The corner films, if any.
    pub(crate) films: Option<FilmTerms>,
}
