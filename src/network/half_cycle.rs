//! One drainage or imbibition: the invading phase, the conditions, and the end.

use super::displacement::Conditions;
use super::films::FilmTerms;
use crate::case::FluidPhase;
use crate::case::network::Stop;

impl FluidPhase {
    /// Its name in files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Wetting => "wetting",
            Self::NonWetting => "non-wetting",
        }
    }

    /// Converts a `curvature` (1/m) of menisci, positive into the defending phase while this fluid invades, to one that is positive into the
    /// wetting phase, so that tension times it is p_n - p_w.
    pub(crate) fn towards_wetting(self, curvature: f64) -> f64 {
        match self {
            Self::NonWetting => curvature,
            Self::Wetting => -curvature,
        }
    }

    /// `drainage` or `imbibition`: the process in which this fluid invades.
    pub(crate) fn process(self) -> &'static str {
        match self {
            Self::NonWetting => "drainage",
            Self::Wetting => "imbibition",
        }
    }

    /// The saturation of this fluid from that of the wetting one, or back.
    pub(crate) fn saturation(self, wetting: f64) -> f64 {
        match self {
            Self::NonWetting => 1.0 - wetting,
            Self::Wetting => wetting,
        }
    }

    /// The other fluid.
    pub(crate) fn other(self) -> Self {
        match self {
            Self::Wetting => Self::NonWetting,
            Self::NonWetting => Self::Wetting,
        }
    }
}

/// One drainage or imbibition.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfCycle {
    /// The invading phase.
    pub(crate) invading: FluidPhase,
    /// Angles, open sides and the largest applied curvature.
    pub conditions: Conditions,
    /// Its early end.
    pub(crate) stop: Stop,
    /// The corner films, if any.
    pub(crate) films: Option<FilmTerms>,
}
