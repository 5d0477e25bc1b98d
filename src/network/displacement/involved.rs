//! The menisci of an event, with their walls.

use super::driven::FrontId;
use super::fronts::Neighbor;
use super::progress::Displacement;
use crate::geometry::curve::Curve;
use crate::interface::menisci::{Hand, Passage};
use crate::math::Vec2;

/// The meniscus of an event, and the one that it met, if any.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Involved {
    front: FrontId,
    met: Option<Met>,
}

/// A meniscus that another one met at an overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Met {
    front: FrontId,
    hand: Hand,
    /// Shift in m from its frame to that of the other one.
    offset: Vec2,
    has_waited: bool,
}

/// The passage of a meniscus, and the other walls ahead of it.
#[derive(Debug, Clone)]
pub(crate) struct Site {
    /// Both walls.
    pub(crate) passage: Passage,
    /// The walls ahead.
    pub(crate) ahead: Vec<Curve>,
}

/// The menisci of an event with their walls, in one frame.
#[derive(Debug, Clone)]
pub(crate) struct Scene {
    /// From left to right in the direction of advance: one, or the two of an overlap, which share the wall between them.
    pub(crate) sites: Vec<Site>,
    /// Whether two menisci merged at a lower pressure than that of the event.
    pub(crate) has_waited: bool,
}

impl Involved {
    /// A meniscus by itself.
    pub(super) fn alone(front: FrontId) -> Self {
        Self { front, met: None }
    }

    /// A meniscus and its neighbor on one hand.
    pub(super) fn both(front: FrontId, hand: Hand, neighbor: &Neighbor, has_waited: bool) -> Self {
        Self { front, met: Some(Met { front: neighbor.front, hand, offset: neighbor.offset, has_waited }) }
    }
}

impl Displacement {
    /// The menisci of an event of this displacement, with their walls.
    pub(crate) fn scene(&self, involved: Involved) -> Scene {
        let site = |front: FrontId, offset: Vec2| {
            let (passage, ahead) = self.passage_at(&self.conditions.angle, &self.mesh, front, offset);
            Site { passage, ahead }
        };
        let Involved { front, met } = involved;
        let one = site(front, Vec2::zeros());
        let Some(met) = met else { return Scene { sites: vec![one], has_waited: false } };
        let other = site(met.front, met.offset);
        // The wall on the left of a meniscus leads to its left neighbor.
        let sites = if met.hand == Hand::Left { vec![other, one] } else { vec![one, other] };
        Scene { sites, has_waited: met.has_waited }
    }
}
