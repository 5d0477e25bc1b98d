//! One drainage or imbibition: which phase invades, under which conditions, and where it ends.

use super::displacement::Conditions;
use super::films::FilmTerms;
use crate::case::FluidPhase;

impl FluidPhase {
    /// Its name in files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Wetting => "wetting",
            Self::NonWetting => "non-wetting",
        }
    }

    /// Curvature of menisci bulging into the wetting phase in 1/m for one that bulges into the defending phase by `curvature` where this
    /// fluid invades, so that tension times it is p_n - p_w.
    pub(crate) fn towards_wetting(self, curvature: f64) -> f64 {
        match self {
            Self::NonWetting => curvature,
            Self::Wetting => -curvature,
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

/// Where a half cycle ends before it comes to rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct End {
    /// When the invading phase reaches the outlet.
    pub at_breakthrough: bool,
    /// When the invading phase fills this share of the pore space.
    pub at_saturation: Option<f64>,
}

/// One drainage or imbibition.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfCycle {
    /// The phase that invades.
    pub(crate) invading: FluidPhase,
    /// Angles, open sides and the largest applied curvature.
    pub conditions: Conditions,
    /// Where it ends early.
    pub end: End,
    /// The films in corners, where there are any.
    pub(crate) films: Option<FilmTerms>,
}

impl HalfCycle {
    /// `drainage` or `imbibition`.
    pub(crate) fn name(&self) -> &'static str {
        match self.invading {
            FluidPhase::NonWetting => "drainage",
            FluidPhase::Wetting => "imbibition",
        }
    }

    /// Curvature of menisci bulging into the wetting phase for one that bulges into the defending phase by `curvature`, so that
    /// tension times it is p_n - p_w.
    pub(crate) fn towards_wetting(&self, curvature: f64) -> f64 {
        self.invading.towards_wetting(curvature)
    }
}
