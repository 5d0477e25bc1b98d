//! The events of a displacement.

use super::Involved;

/// What let a meniscus go on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EventKind {
    /// It passed the largest curvature of its gate.
    Burst,
    /// It touched a wall ahead.
    Touch,
    /// It met its neighbor on the wall between them.
    Overlap,
}

impl EventKind {
    /// Its name in tables.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Burst => "burst",
            Self::Touch => "touch",
            Self::Overlap => "overlap",
        }
    }
}

/// One event.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// What happened.
    pub kind: EventKind,
    /// The throat through which elements were filled; none for a segment within a region.
    pub throat: Option<usize>,
    /// The elements that were filled.
    pub elements: Vec<usize>,
    /// Curvature of the meniscus at the event in 1/m.
    pub curvature: f64,
    /// The applied curvature in 1/m: the largest so far.
    pub applied: f64,
    /// Its menisci.
    pub involved: Involved,
}
