//! What events there are, and which of them comes first.

use crate::interface::menisci::Hand;

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
    /// No meniscus moved: the films in a throat met and closed it.
    SnapOff,
    /// It passed a throat that films had closed, and the invading phase is joined again.
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

/// An event that will come unless another comes before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Candidate {
    /// Curvature of the meniscus in 1/m.
    pub(crate) curvature: f64,
    /// What will happen.
    pub(crate) kind: EventKind,
    /// The gate.
    pub(crate) gate: usize,
    /// The end of the gate at which the meniscus enters.
    pub(crate) to: usize,
    /// The meniscus to meet, and on which hand.
    pub(crate) partner: Option<((usize, usize), Hand)>,
    /// Whether both have met and wait as one.
    pub(crate) is_joined: bool,
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    /// The greatest is the one that comes first.
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let number = |it: &Self| (it.gate, it.to, it.partner.map(|(front, hand)| (front, hand == Hand::Right)));
        let by_number = number(other).cmp(&number(self));
        other.curvature.total_cmp(&self.curvature).then(by_number)
    }
}
