//! The state of a displacement in time, as checkpoints store it: menisci, filling elements, events.

use serde::{Deserialize, Serialize};

use crate::cycles::Invasion;
use crate::displacement::EventKind;

/// A meniscus in a gate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Meniscus {
    /// Area in m² swept since the chord of the gate.
    pub(super) area: f64,
    /// Whether it has passed its event; its area then belongs to the element ahead, except at the outlet.
    pub(super) has_burst: bool,
    /// Whether it has touched the outlet: further inflow leaves.
    pub(super) has_left: bool,
}

/// An element that is being filled.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Filling {
    /// Area in m² that entered through menisci past their events.
    pub(super) area: f64,
    /// Curvature in 1/m of the invading phase in it.
    pub(super) curvature: f64,
    /// Whether it lies between two menisci that have merged around a grain.
    pub(super) is_joined: bool,
}

/// An event.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Occurrence {
    /// Time in s.
    pub time: f64,
    /// Its type.
    pub kind: EventKind,
    /// Index in the network of the throat that was passed.
    pub throat: Option<usize>,
    /// Curvature of the meniscus in 1/m, positive if it bulges into the defending phase.
    pub curvature: f64,
    /// Saturation of the invading phase.
    pub saturation: f64,
    /// Pressure at the inlet less that at the outlet in Pa.
    pub pressure: f64,
}

/// Breakthrough of the invading phase at the outlet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Breakthrough {
    /// Time in s.
    pub time: f64,
    /// Saturation of the invading phase.
    pub saturation: f64,
    /// Pressure at the inlet less that at the outlet in Pa.
    pub pressure: f64,
}

/// The state that checkpoints store.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) time: f64,
    pub(super) steps: u64,
    /// By gate and end.
    pub(super) menisci: Vec<[Option<Meniscus>; 2]>,
    /// By element.
    pub(super) filling: Vec<Option<Filling>>,
    /// Elements in the order in which they became full.
    pub(super) completed: Vec<usize>,
    /// Area in m² of the invading phase in excess of full elements and their menisci.
    pub(super) excess: f64,
    /// Cumulative areas in m²: inflow of the invading phase, outflow of the invading and of the defending phase.
    pub(super) passed: [f64; 3],
    pub(super) history: Vec<Occurrence>,
    pub(super) invasions: Vec<Option<Invasion>>,
    pub(super) breakthrough: Option<Breakthrough>,
    /// Pressure at the inlet less that at the outlet in Pa, and flow into the inlet in m²/s, in the last step.
    pub(super) pressure: f64,
    pub(super) inflow: f64,
    /// Lengths in s of the last steps that ended at an event of a meniscus and at a full element.
    pub(super) last_steps: [f64; 2],
    pub(super) solves: u64,
}
