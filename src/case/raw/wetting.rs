//! `[sph.wetting]`: parts of the walls that differ; the tables of the models are in `crate::wetting`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::RawSideName;
use crate::wetting;

/// `[sph.wetting]` and `[network.wetting]`.
pub type RawWetting = wetting::RawWetting<RawWettingPatch>;

tables! {
    /// A part of the walls with angles of its own: those of the model.
    pub struct RawWettingPatch {
        /// Shape whose surface is the patch, counted from 0; not with `side` (default: all walls).
        pub shape: u32,
        /// Wall side that is the patch (default: all walls).
        pub side: RawSideName,
        /// Stripes of the patch (default: the whole patch).
        pub stripes: RawStripes,
        /// Static angle in degrees (required if the model has one).
        pub contact_angle_deg: f64,
        /// Advancing angle in degrees (required if the model has one).
        pub advancing_angle_deg: f64,
        /// Receding angle in degrees, 0 to the advancing one (required if the model has one).
        pub receding_angle_deg: f64,
    }

    /// Stripes of a wall.
    pub struct RawStripes {
        /// Coordinate across the stripes (default `x`).
        pub along: RawAxis,
        /// Start of the first stripe in m (default 0).
        pub start: f64,
        /// Width of a stripe in m.
        pub width: f64,
        /// Distance from stripe to stripe in m, at least the width (default: a single stripe).
        pub period: f64,
    }
}

/// An axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawAxis {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
}
