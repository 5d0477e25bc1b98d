//! Interface for a model that determines the time of events: it queries menisci and their events, and reports filled elements.

use super::connected::Held;
use super::event::{Candidate, EventKind};
use super::loops::GateId;
use super::mesh::FrontId;
use super::outflow::Outflow;
use super::progress::Displacement;
use crate::graph::WallPiece;
use meniscus_core::math::Vec2;
use meniscus_geometry::interface::menisci::Passage;

/// A pending event of a meniscus, or of two that meet.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Advance {
    /// Kind of the event.
    pub(crate) kind: EventKind,
    /// Curvature of the event in 1/m.
    pub(crate) curvature: f64,
    /// The meniscus, and the one that it meets, if any.
    pub(crate) fronts: (FrontId, Option<FrontId>),
    /// The elements filled by the event, from that ahead of the first meniscus to that ahead of the second.
    pub(crate) fills: Vec<usize>,
    candidate: Candidate,
}

/// A gate as a passage for flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GateFacts {
    /// The elements on both sides.
    pub(crate) elements: [usize; 2],
    /// The throat of the network, if it is one; its regions are those of both sides.
    pub(crate) throat: Option<usize>,
    /// Length of its chord in m, and the middle of it.
    pub(crate) width: f64,
    pub(crate) middle: Vec2,
}

impl Displacement {
    /// All gates.
    pub(crate) fn gates(&self) -> Vec<GateFacts> {
        let mesh = &self.mesh;
        let facts = |(index, gate): (usize, &super::mesh::Gate)| {
            let (part, slot) = gate.crossings[0];
            let crossing = &mesh.loops[part].crossings[slot];
            GateFacts {
                elements: [mesh.element(index, 0), mesh.element(index, 1)],
                throat: gate.throat,
                width: (crossing.to - crossing.from).norm(),
                middle: mesh.middle(index),
            }
        };
        mesh.gates.iter().enumerate().map(facts).collect()
    }

    /// The openings of open sides with their elements.
    pub(crate) fn openings(&self) -> Vec<(usize, usize)> {
        let mesh = &self.mesh;
        let of_loop = |(part, element): (&super::loops::Loop, &usize)| {
            let crossings = part.crossings.iter().chain(&part.apart);
            let opening = |crossing: &super::loops::Crossing| match crossing.gate {
                GateId::Opening(opening) => Some((opening as usize, *element)),
                _ => None,
            };
            crossings.filter_map(opening).collect::<Vec<_>>()
        };
        mesh.loops.iter().zip(&mesh.element_of).flat_map(of_loop).collect()
    }

    /// The walls around an element.
    pub(crate) fn walls(&self, element: usize) -> impl Iterator<Item = &WallPiece> {
        let loops = self.mesh.elements[element].loops.iter();
        loops.flat_map(|&part| &self.mesh.loops[part].walls).flat_map(|wall| wall.iter())
    }

    /// The menisci in gates, in order.
    pub(crate) fn waiting(&self) -> impl Iterator<Item = FrontId> + '_ {
        let gates = self.fronts.iter().enumerate();
        gates.flat_map(|(gate, ends)| (0..2).filter(|&end| ends[end].is_some()).map(move |end| (gate, end)))
    }

    /// The passage of a meniscus, and the curvature in 1/m of its own event.
    pub(crate) fn passage_of(&self, (gate, end): FrontId) -> Option<(&Passage, f64)> {
        self.fronts[gate][end].as_ref().map(|front| (&front.passage, front.own))
    }

    /// The passage of a hypothetical meniscus entering an element through a gate, and the curvature in 1/m of its own event.
    pub(crate) fn future_front(&self, front: FrontId) -> (Passage, f64) {
        let (passage, obstacles) = self.passage(&self.mesh, front, Vec2::zeros());
        let own = self.own_event(&passage, &obstacles).1;
        (passage, own)
    }

    /// The gates of an element, each with the end that lies in it.
    pub(crate) fn gates_of(&self, element: usize) -> &[FrontId] {
        &self.mesh.elements[element].gates
    }

    /// Paths of the defending phase to elements marked as outlets.
    pub(crate) fn outflow(&self, is_outlet: &[bool]) -> Outflow {
        let defends: Vec<bool> = self.invaded.iter().map(|invaded| !invaded).collect();
        let held = Held { mesh: &self.mesh, invaded: &self.invaded, closed: &self.closed, rings: None };
        Outflow::new(held.graph(false), &defends, is_outlet)
    }

    /// The region of an element.
    pub(crate) fn region(&self, element: usize) -> usize {
        self.mesh.region_of[element]
    }

    /// Contact angles in rad by wall.
    pub(crate) fn angles(&self) -> &[f64] {
        &self.conditions.angle
    }

    /// The pending events of menisci that are new since the last call.
    pub(crate) fn new_advances(&mut self) -> Vec<Advance> {
        let mut candidates: Vec<Candidate> = std::mem::take(&mut self.queue).into_vec();
        candidates.sort_by(|a, b| b.cmp(a));
        candidates.into_iter().filter_map(|candidate| self.advance(candidate)).collect()
    }

    fn advance(&self, candidate: Candidate) -> Option<Advance> {
        let Candidate { gate, to, partner, kind, curvature, .. } = candidate;
        self.fronts[gate][to].as_ref()?;
        let Some((front, hand)) = partner else {
            let fills = vec![self.mesh.element(gate, to)];
            return Some(Advance { kind, curvature, fronts: ((gate, to), None), fills, candidate });
        };
        let neighbor = self.neighbor(&self.mesh, (gate, to), hand).filter(|neighbor| neighbor.front == front)?;
        let (curvature, _) = self.merged_event(&self.mesh, ((gate, to), hand), &neighbor, curvature);
        Some(Advance { kind, curvature, fronts: ((gate, to), Some(front)), fills: neighbor.passed, candidate })
    }

    /// Whether the menisci of an advance still exist, and still meet.
    pub(crate) fn is_pending(&self, advance: &Advance) -> bool {
        let ((gate, to), partner) = advance.fronts;
        let waits = |(gate, end): FrontId| self.fronts[gate][end].is_some();
        if !waits((gate, to)) {
            return false;
        }
        let Some((_, hand)) = advance.candidate.partner else { return true };
        let neighbor = self.neighbor(&self.mesh, (gate, to), hand);
        partner.is_some_and(waits) && neighbor.is_some_and(|found| Some(found.front) == partner)
    }

    /// An element is full of the invading phase: menisci into it vanish, and new ones form in its gates.
    pub(crate) fn complete(&mut self, element: usize) {
        let mesh = self.mesh.clone();
        self.fill(&mesh, &[element]);
        self.settle(&mesh);
    }
}
