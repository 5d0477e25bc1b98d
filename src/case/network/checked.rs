//! A checked `[network]`: every value present, in SI units and in range.

use super::measured::Measured;
use super::state::Start;
use crate::case::checked::{Fluid, Sides, WettingPatch};
use crate::wetting::Wetting;

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

impl PoreNetwork {
    /// Whether it is displaced in time, so that its clock is the time in s.
    #[must_use]
    pub fn is_dynamic(&self) -> bool {
        self.displacement.as_ref().is_some_and(|displacement| displacement.dynamic.is_some())
    }
}

/// The interface between two fluids and its angles on walls.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct NetworkInterface {
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// Static angles through the wetting phase: Young, Tadmor or hysteresis.
    pub wetting_model: Wetting,
    /// Walls with angles of their own, without stripes.
    pub patches: Vec<WettingPatch>,
}

/// A displacement.
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
    /// The state that it begins with; absent: the pore space is full of the defending phase.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub initial: Option<Start>,
    /// What drives it in time; absent where it is quasi-static.
    pub dynamic: Option<DynamicDrive>,
}

/// What drives a displacement in time.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct DynamicDrive {
    /// A given rate or pressure.
    pub drive: Driven,
    /// Most pore volumes that pass the inlet in one step.
    pub largest_step: f64,
}

/// By what a displacement in time is driven.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Driven {
    /// Area injected per time in m²/s.
    Rate(f64),
    /// Pressure at the inlet less that at the outlet in Pa.
    PressureDrop(f64),
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
    /// At this capillary pressure p_n - p_w in Pa; quasi-static only.
    pub capillary_pressure: Option<f64>,
    /// When so many pore volumes have passed the inlet; in time only.
    pub injected: Option<f64>,
}
