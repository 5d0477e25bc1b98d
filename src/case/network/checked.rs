//! A checked `[network]`: every value present, in SI units and in range.

use super::measured::Measured;
use crate::case::checked::{Fluid, Sides, WettingModel, WettingPatch};

/// A pore network and what is displaced in it.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct PoreNetwork {
    /// The four sides: walls, periodic sides, the inlet and the outlet.
    pub sides: Sides,
    /// The wetting phase, where it is given.
    pub wetting: Option<Fluid>,
    /// The non-wetting phase, where it is given.
    pub non_wetting: Option<Fluid>,
    /// Interface and walls; absent: no entry pressures.
    pub interface: Option<NetworkInterface>,
    /// Persistence ratio above which two maxima of the wall distance are one pore.
    pub persistence: f64,
    /// Entry pressures that were measured, in place of those of the formula.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured: Option<Measured>,
    /// What is displaced; absent where there is no inlet.
    pub displacement: Option<NetworkDisplacement>,
}

/// The interface between two fluids and its angles on walls.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct NetworkInterface {
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// Static angles through the wetting phase: Young, Tadmor or hysteresis.
    pub wetting_model: WettingModel,
    /// Walls with angles of their own, without stripes.
    pub patches: Vec<WettingPatch>,
}

/// A quasi-static displacement.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct NetworkDisplacement {
    /// The half cycles in their order.
    pub process: Process,
    /// Whether a defending region without a way to the outlet is trapped.
    pub trapping: bool,
    /// Which events move menisci.
    pub events: NetworkEvents,
    /// Where it ends early.
    pub stop: Stop,
}

/// Which phase invades.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Process {
    /// The non-wetting phase.
    Drainage,
    /// The wetting phase.
    Imbibition,
    /// Both in turn, so many times, drainage first.
    Cycle(u32),
}

impl Process {
    /// Number of half cycles.
    #[must_use]
    pub fn half_cycles(self) -> u32 {
        match self {
            Self::Drainage | Self::Imbibition => 1,
            Self::Cycle(cycles) => 2 * cycles,
        }
    }
}

/// Events that move menisci.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum NetworkEvents {
    /// Burst, touch and overlap.
    All,
    /// Burst only.
    Burst,
}

/// Where a displacement, or each drainage of a cycle, ends early.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Stop {
    /// When the invading phase reaches the outlet.
    pub breakthrough: bool,
    /// At this saturation of the wetting phase.
    pub saturation: Option<f64>,
    /// At this capillary pressure p_n - p_w in Pa.
    pub capillary_pressure: Option<f64>,
}
