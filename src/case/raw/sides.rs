//! `[sph.sides]`: what stands at the four sides of the domain, walls that move, and open sides.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::RawPhase;

tables! {
    /// The four sides of the domain.
    pub struct RawSides {
        /// x = min (default `wall`).
        pub left: RawSide,
        /// x = max (default `wall`).
        pub right: RawSide,
        /// y = min (default `wall`).
        pub bottom: RawSide,
        /// y = max (default `wall`).
        pub top: RawSide,
        /// Speeds of walls along themselves (default at rest).
        pub speed: RawWallSpeeds,
        /// What drives the flow through open sides, and what comes in.
        pub open: RawOpenSides,
    }

    /// Speeds of the walls at the sides, each along itself.
    pub struct RawWallSpeeds {
        /// Along y in m/s (default 0).
        pub left: f64,
        /// Along y in m/s (default 0).
        pub right: f64,
        /// Along x in m/s (default 0).
        pub bottom: f64,
        /// Along x in m/s (default 0).
        pub top: f64,
    }

    /// The open sides: a table for each side that fluid passes through.
    pub struct RawOpenSides {
        /// Of the side at x = min.
        pub left: RawOpenSide,
        /// Of the side at x = max.
        pub right: RawOpenSide,
        /// Of the side at y = min.
        pub bottom: RawOpenSide,
        /// Of the side at y = max.
        pub top: RawOpenSide,
    }

    /// An inlet, an outlet, or a periodic side with a given flow; one of pressure, velocity and flow rate.
    pub struct RawOpenSide {
        /// Pressure at the side in Pa (inlet; outlet, default 0).
        pub pressure: f64,
        /// How a pressure rises in steps.
        pub pressure_steps: RawPressureSteps,
        /// Mean velocity inwards in m/s (inlet, periodic).
        pub velocity: f64,
        /// Area that comes in per time in m²/s: volume per time and depth (inlet, periodic).
        pub flow_rate: f64,
        /// How the velocity is spread over the side (default `plug`).
        pub profile: RawProfile,
        /// Phase that comes in (default: what stands at the side at the start).
        pub phase: RawPhase,
    }

    /// A pressure that rises in equal steps, each held for the same time.
    pub struct RawPressureSteps {
        /// Height of a step in Pa (required).
        pub rise: f64,
        /// Time for which each pressure is held in s (required).
        pub every_time: f64,
    }
}

/// What stands at a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawSide {
    /// Joined to the opposite side.
    Periodic,
    /// A solid no-slip wall; contact lines may stand on it.
    Wall,
    /// A no-slip wall by image particles; no contact angle is set on it.
    Image,
    /// A mirror: free slip.
    Symmetry,
    /// Open, with a velocity, a flow rate or a pressure.
    Inlet,
    /// Open, with a pressure.
    Outlet,
}

/// A side by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawSideName {
    /// x = min.
    Left,
    /// x = max.
    Right,
    /// y = min.
    Bottom,
    /// y = max.
    Top,
}

/// How the velocity of an inlet is spread over its side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawProfile {
    /// The same everywhere.
    Plug,
    /// A parabola that vanishes at walls.
    Parabolic,
}
