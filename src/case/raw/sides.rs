//! `[sph.sides]`: what stands at the four sides of the domain, walls that move, and open sides.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::RawPhase;

tables! {
    /// The four sides of the domain.
    pub struct RawSides {
        /// Kind of the side (default `wall`).
        pub left: RawSide,
        /// Kind of the side (default `wall`).
        pub right: RawSide,
        /// Kind of the side (default `wall`).
        pub bottom: RawSide,
        /// Kind of the side (default `wall`).
        pub top: RawSide,
        /// Speed of each wall side along itself (default: at rest).
        pub speed: RawWallSpeeds,
        /// What drives the flow through open sides, and what enters.
        pub open: RawOpenSides,
    }

    /// Speeds of the walls at the sides, each along itself.
    pub struct RawWallSpeeds {
        /// Speed along the side, towards positive x or y, in m/s (default 0.0).
        pub left: f64,
        /// Speed along the side, towards positive x or y, in m/s (default 0.0).
        pub right: f64,
        /// Speed along the side, towards positive x or y, in m/s (default 0.0).
        pub bottom: f64,
        /// Speed along the side, towards positive x or y, in m/s (default 0.0).
        pub top: f64,
    }

    /// The open sides: a table for each side that fluid passes through.
    pub struct RawOpenSides {
        /// Flow through the side.
        pub left: RawOpenSide,
        /// Flow through the side.
        pub right: RawOpenSide,
        /// Flow through the side.
        pub bottom: RawOpenSide,
        /// Flow through the side.
        pub top: RawOpenSide,
    }

    /// An inlet, an outlet, or a periodic side with a given flow; one of pressure, velocity and flow rate.
    pub struct RawOpenSide {
        /// Dirichlet pressure in Pa, in the phase that enters (default 0 at an outlet).
        pub pressure: f64,
        /// A pressure that rises in equal steps.
        pub pressure_steps: RawPressureSteps,
        /// Mean inward velocity over the opening in m/s.
        pub velocity: f64,
        /// Inward flow rate per depth in m²/s.
        pub flow_rate: f64,
        /// Velocity profile over the opening; at periodic sides the initial one (default `plug`).
        pub profile: RawProfile,
        /// Phase that enters (default: the phase there at time zero).
        pub phase: RawPhase,
    }

    /// A pressure that rises in equal steps, each held for the same time.
    pub struct RawPressureSteps {
        /// Pressure rise per step in Pa.
        pub rise: f64,
        /// Time for which each pressure is held, in s.
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
