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
pub(crate) struct Place {
    /// Both walls.
    pub(crate) passage: Passage,
    /// The walls ahead.
    pub(crate) ahead: Vec<Curve>,
}

/// The menisci of an event with their walls, in one frame.
#[derive(Debug, Clone)]
pub(crate) struct Scene {
    /// From left to right in the direction of advance: one, or the two of an overlap, which share the wall between them.
    pub(crate) places: Vec<Place>,
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
        let place = |front: FrontId, offset: Vec2| {
            let (passage, ahead) = self.passage_at(&self.conditions.angle, &self.mesh, front, offset);
            Place { passage, ahead }
        };
        let Involved { front, met } = involved;
        let one = place(front, Vec2::zeros());
        let Some(met) = met else { return Scene { places: vec![one], has_waited: false } };
        let other = place(met.front, met.offset);
        // The wall on the left of a meniscus leads to its left neighbor.
        let places = if met.hand == Hand::Left { vec![other, one] } else { vec![one, other] };
        Scene { places, has_waited: met.has_waited }
    }
}
