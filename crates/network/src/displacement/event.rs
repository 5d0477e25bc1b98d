//! Types of events, and their order.

use super::mesh::FrontId;
use meniscus_geometry::interface::menisci::Hand;

/// The type of an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EventKind {
    /// A meniscus passed the largest curvature of its gate.
    Burst,
    /// A meniscus touched a wall ahead.
    Touch,
    /// A meniscus met its neighbor on the wall between them.
    Overlap,
    /// Films in a throat met and closed it; no meniscus moved.
    SnapOff,
    /// A meniscus passed a throat closed by films, and the invading phase is connected again.
    Reconnection,
}

impl EventKind {
    /// Its name in tables.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Burst => "burst",
            Self::Touch => "touch",
            Self::Overlap => "overlap",
            Self::SnapOff => "snap-off",
            Self::Reconnection => "reconnection",
        }
    }
}

/// A pending event, which another event may prevent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Candidate {
    /// Applied curvature in 1/m: that of the meniscus without the head at its height.
    pub(crate) curvature: f64,
    pub(crate) kind: EventKind,
    pub(crate) gate: usize,
    /// The end of the gate at which the meniscus enters.
    pub(crate) to: usize,
    /// The meniscus to meet, and its side.
    pub(crate) partner: Option<(FrontId, Hand)>,
    /// Whether both have met and merged.
    pub(crate) is_joined: bool,
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    /// The greatest comes first.
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let number = |it: &Self| (it.gate, it.to, it.partner.map(|(front, hand)| (front, hand == Hand::Right)));
        let by_number = number(other).cmp(&number(self));
        other.curvature.total_cmp(&self.curvature).then(by_number)
    }
}
