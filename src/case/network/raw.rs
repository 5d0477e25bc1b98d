//! The keys of `[network]` as written: all optional, nothing checked but names and types.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::raw::{RawInterface, RawPhases, RawSideName, RawWetting, tables};

tables! {
    /// A pore network: pores and throats of the geometry, and a displacement through them.
    pub struct RawNetwork {
        /// Side that the invading phase enters through (default none: the network is extracted and nothing is displaced).
        pub inlet: RawSideName,
        /// Side that the defending phase leaves through (default none: the defending phase has no way out, and none of it is trapped).
        pub outlet: RawSideName,
        /// What stands at the other sides (default walls).
        pub sides: RawNetworkSides,
        /// The fluids; only their viscosities count (default 1 Pa s for conductances; `dynamic` needs both).
        pub phases: RawPhases,
        /// Interface between the fluids.
        pub interface: RawInterface,
        /// Static contact angles: `young`, `hysteresis` or `tadmor`, and patches by shape or side.
        pub wetting: RawWetting,
        /// Which phase invades (default `drainage`).
        pub process: RawProcess,
        /// Number of cycles of drainage and imbibition, with `process = "cycle"` (default 1).
        pub cycles: u32,
        /// Whether a defending region without a way to the outlet is trapped (default true); else films carry it away.
        pub trapping: bool,
        /// Which events move menisci (default `all`).
        pub events: RawEvents,
        /// Persistence ratio above which two maxima of the wall distance are one pore: the half width of the throat over the
        /// smaller inscribed radius, above 0 and at most 1 (default 0.95).
        pub persistence: f64,
        /// File of measured entry pressures, `measured.json` of `meniscus network verify`, relative to the case file (default: all are those of
        /// the formula).
        pub measured: PathBuf,
        /// The same values written here.
        pub measured_throats: RawMeasured,
        /// Where the displacement ends before it comes to rest; of a cycle, where each drainage ends.
        pub stop: RawStop,
        /// State that the displacement begins with, relative to the case file (default: the pore space is full of the defending phase).
        pub initial: PathBuf,
        /// Displacement in time, with viscous flow (default none: it is quasi-static, without time).
        pub dynamic: RawDynamic,
    }

    /// What drives a displacement in time: a rate or a pressure drop.
    pub struct RawDynamic {
        /// Area of the invading phase that is injected per time, in m2/s.
        pub rate: f64,
        /// Pressure at the inlet less that at the outlet in Pa.
        pub pressure_drop: f64,
        /// Most pore volumes that pass the inlet in one step (default 0.01).
        pub largest_step: f64,
    }

    /// Measured entry pressures.
    pub struct RawMeasured {
        /// Tells the geometry that they were measured in, as in `network.json`.
        pub geometry_hash: String,
        /// The throats.
        pub throats: Vec<RawMeasuredThroat>,
    }

    /// A throat whose entry pressure was measured.
    pub struct RawMeasuredThroat {
        /// Its index among all throats, those that the merge dissolves included.
        pub index: usize,
        /// Curvature of the meniscus at entry by the formula in 1/m; where the formula gives another one, as for another angle, it stays.
        pub formula_curvature: f64,
        /// Measured curvature in 1/m.
        pub entry_curvature: f64,
    }

    /// The sides that are neither inlet nor outlet.
    pub struct RawNetworkSides {
        /// x = min (default `wall`).
        pub left: RawNetworkSide,
        /// x = max (default `wall`).
        pub right: RawNetworkSide,
        /// y = min (default `wall`).
        pub bottom: RawNetworkSide,
        /// y = max (default `wall`).
        pub top: RawNetworkSide,
    }

    /// Where a displacement ends early; whatever comes first.
    pub struct RawStop {
        /// Whether it ends when the invading phase reaches the outlet (default false).
        pub breakthrough: bool,
        /// Saturation of the wetting phase at which it ends, 0 to 1.
        pub saturation: f64,
        /// Capillary pressure p_n - p_w in Pa at which it ends; without `dynamic` only.
        pub capillary_pressure: f64,
        /// Pore volumes that have passed the inlet when it ends; with `dynamic` only.
        pub injected: f64,
    }
}

/// What stands at a side of a network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawNetworkSide {
    /// A solid wall with the contact angle of all walls.
    Wall,
    /// Joined to the opposite side.
    Periodic,
}

/// Which phase invades.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawProcess {
    /// The non-wetting phase, into a pore space full of the wetting one.
    Drainage,
    /// The wetting phase, into a pore space full of the non-wetting one.
    Imbibition,
    /// Drainage from the inlet, then imbibition from the outlet, again and again.
    Cycle,
}

/// The events that move menisci.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawEvents {
    /// Burst, touch and overlap.
    All,
    /// Burst only: invasion percolation, to compare with other programs.
    Burst,
}
