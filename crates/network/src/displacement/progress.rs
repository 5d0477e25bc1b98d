//! A displacement in progress: phases of elements, menisci in gates, and the consequences of filling an element.

use std::collections::{BinaryHeap, VecDeque};
use std::sync::Arc;

use super::conditions::{Conditions, OpenDisc};
use super::connected::Held;
use super::division::{Division, Element};
use super::event::Candidate;
use super::mesh::{Gate, Mesh};
use super::outline::{centroid, outline};
use super::rings::Rings;
use super::trapping::Connection;
use crate::graph::{Network, Pores, WallPiece};
use meniscus_case::network::Events;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::menisci::Passage;
use rayon::prelude::*;

/// The phases of a displacement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The displaced phase.
    Defending,
    /// The invading phase.
    Invading,
}

/// A meniscus in a gate, facing the element on one side of it.
#[derive(Debug, Clone)]
pub(super) struct Front {
    /// The walls along which it moves.
    pub(crate) passage: Passage,
    /// Curvature of its own event in 1/m.
    pub(crate) own: f64,
}

/// A displacement in progress.
#[derive(Debug, Clone)]
pub struct Displacement {
    pub(super) mesh: Arc<Mesh>,
    pub(super) elements: Arc<Vec<Element>>,
    pub(super) centers: Arc<Vec<Vec2>>,
    pub(super) conditions: Conditions,
    pub(super) invaded: Vec<bool>,
    pub(super) connection: Connection,
    /// Applied curvature in 1/m when an element was trapped, or at the end of the previous half cycle; NaN if there was none.
    pub(super) held: Vec<f64>,
    pub(super) fronts: Vec<[Option<Box<Front>>; 2]>,
    pub(super) queue: BinaryHeap<Candidate>,
    /// Remaining events of the same curvature as the last one.
    pub(super) tied: VecDeque<Candidate>,
    /// Elements that events of this curvature have filled.
    filled: Vec<usize>,
    /// By gate: whether films have closed it between non-wetting phase on both sides.
    pub(super) closed: Vec<bool>,
    /// Gates that events of this curvature have closed, and opened again.
    pub(super) closing: Vec<usize>,
    pub(super) opened: Vec<usize>,
    pub(super) applied: f64,
    /// The corner films along each wall, if they differ in their connection; by gate, whether it joins the films on both sides of it.
    pub(super) rings: Option<Arc<Rings>>,
    pub(super) bridged: Vec<bool>,
    /// Gates whose films part as the pressure rises, with the curvature in 1/m, the lowest last.
    pub(super) partings: Vec<(f64, usize)>,
    is_outlet: Vec<bool>,
    has_reached_outlet: bool,
    /// Elements trapped since this was last emptied.
    pub(super) lost: Vec<usize>,
}

impl Displacement {
    /// Invasion of a pore space full of the defending phase \[WilkinsonWillemsen1983\], except elements open at an inlet: openings have no entry pressure.
    pub fn new(network: &Network, pores: &Pores, conditions: Conditions) -> Self {
        Self::within(&Division::of(network, pores, conditions.events), conditions)
    }

    /// The same in a pore space already divided for these events.
    pub(crate) fn within(division: &Division, conditions: Conditions) -> Self {
        let Mesh { elements, gates, .. } = &*division.mesh;
        let (invaded, closed) = (vec![false; elements.len()], vec![false; gates.len()]);
        Self::begun(division.clone(), conditions, invaded, closed, f64::INFINITY)
    }

    /// The other phase invades from the present state. Its elements without a connection to an inlet take no part until they are reached, or,
    /// without trapping, take part from the start.
    pub fn reverse(self, conditions: Conditions) -> Self {
        let invaded = self.invaded.iter().map(|invaded| !invaded).collect();
        let conditions = Conditions { events: self.conditions.events, ..conditions };
        // The sign of curvatures reverses with the phases.
        let last = if self.applied.is_finite() { -self.applied } else { f64::NAN };
        let held =
            self.connection.trapped.iter().zip(&self.held).map(|(&trapped, held)| if trapped { -held } else { last });
        let held = held.collect();
        let division = Division { mesh: self.mesh, elements: self.elements, centers: self.centers };
        Self { held, ..Self::begun(division, conditions, invaded, self.closed, f64::INFINITY) }
    }

    /// The start of a displacement; films that meet at `applied` (1/m), if this is finite, are joined.
    pub(super) fn begun(
        division: Division,
        conditions: Conditions,
        mut invaded: Vec<bool>,
        mut closed: Vec<bool>,
        applied: f64,
    ) -> Self {
        let under = conditions.disc.map_or_else(Vec::new, |disc| division.under(&disc));
        let Division { mesh, elements, centers } = division;
        let count = mesh.elements.len();
        let opens = |sides: [bool; 4]| -> Vec<bool> {
            mesh.elements.iter().map(|element| (0..4).any(|side| element.open[side] && sides[side])).collect()
        };
        let (mut inlets, mut outlets) = (opens(conditions.inlet), opens(conditions.outlet));
        if let Some(disc) = conditions.disc {
            let open = if disc.is_inlet { &mut inlets } else { &mut outlets };
            under.into_iter().for_each(|element| open[element] = true);
        }
        inlets.iter().zip(&mut invaded).for_each(|(&inlet, invaded)| *invaded |= inlet);
        Self::closed_within(&mesh, &mut closed, &invaded, &conditions.films);
        let rings = Self::rings_of(&mesh, &conditions.films);
        let (bridged, partings) =
            Self::bridges(&mesh, rings.as_deref(), &conditions.films, (&invaded, &closed, applied));
        let films = rings.as_deref().map(|rings| (rings, &bridged[..]));
        let held = Held { mesh: &mesh, invaded: &invaded, closed: &closed, rings: films };
        let (connection, first) = Connection::begin(&conditions, held, [&inlets, &outlets]);
        let fronts = vec![const { [None, None] }; mesh.gates.len()];
        let mut begun = Self {
            mesh: mesh.clone(),
            elements,
            centers,
            conditions,
            invaded,
            connection,
            held: vec![f64::NAN; count],
            fronts,
            queue: BinaryHeap::new(),
            tied: VecDeque::new(),
            filled: Vec::new(),
            closed,
            closing: Vec::new(),
            opened: Vec::new(),
            applied: f64::NEG_INFINITY,
            rings,
            bridged,
            partings,
            is_outlet: outlets,
            has_reached_outlet: false,
            lost: Vec::new(),
        };
        begun.advance_from_all(&mesh, &first);
        for gate in (0..mesh.gates.len()).filter(|&gate| begun.closed[gate]).collect::<Vec<_>>() {
            begun.advance_from_closed(&mesh, gate);
        }
        begun.queue_snap_off(&mesh);
        begun
    }

    /// The elements of which a disc covers a part.
    pub(crate) fn elements_under(&self, disc: &OpenDisc) -> Vec<usize> {
        self.division().under(disc)
    }

    pub(super) fn fill(&mut self, mesh: &Mesh, elements: &[usize]) {
        for &element in elements {
            self.invaded[element] = true;
            self.stop_fronts_into(mesh, element);
            mesh.elements[element].gates.iter().for_each(|&(gate, _)| self.closed[gate] = false);
            self.bridge_beside(mesh, element);
        }
        self.filled.extend_from_slice(elements);
        self.connection.note(elements);
    }

    /// Consequences of all events of one curvature: trapping and new menisci.
    pub(super) fn settle(&mut self, mesh: &Mesh) {
        let (elements, opened) = (std::mem::take(&mut self.filled), std::mem::take(&mut self.opened));
        let mut closing = std::mem::take(&mut self.closing);
        closing.retain(|&gate| self.closed[gate]);
        let between: Vec<[usize; 2]> = closing.iter().map(|&gate| [0, 1].map(|end| mesh.element(gate, end))).collect();
        let (held, connection) = self.held(mesh);
        let lost = connection.remove(held, &elements, &between);
        self.leave(mesh, lost);
        opened.iter().for_each(|&gate| self.part(mesh, gate));
        let beside = opened.iter().flat_map(|&gate| [mesh.element(gate, 0), mesh.element(gate, 1)]);
        for element in elements.into_iter().chain(beside) {
            let (held, connection) = self.held(mesh);
            let joined = connection.join(held, element);
            self.advance_from_all(mesh, &joined);
        }
        self.queue_snap_off_of_fed(mesh);
        closing.into_iter().for_each(|gate| self.advance_from_closed(mesh, gate));
    }

    /// Phases, gates and films, and the connectivity by them.
    pub(super) fn held<'a>(&'a mut self, mesh: &'a Mesh) -> (Held<'a>, &'a mut Connection) {
        let rings = self.rings.as_deref().map(|rings| (rings, &self.bridged[..]));
        (Held { mesh, invaded: &self.invaded, closed: &self.closed, rings }, &mut self.connection)
    }

    /// Elements are trapped at the applied curvature.
    pub(super) fn leave(&mut self, mesh: &Mesh, lost: Vec<usize>) {
        for lost in lost {
            self.held[lost] = self.applied;
            self.stop_fronts_into(mesh, lost);
            self.lost.push(lost);
        }
    }

    fn stop_fronts_into(&mut self, mesh: &Mesh, element: usize) {
        for &(gate, end) in &mesh.elements[element].gates {
            self.fronts[gate][end] = None;
        }
    }

    fn advance_from_all(&mut self, mesh: &Mesh, elements: &[usize]) {
        for &element in elements {
            self.has_reached_outlet |= self.is_outlet[element];
            self.advance_from(mesh, element);
        }
    }

    /// Places menisci towards the neighbors of an element that hold the defending phase and are connected to an outlet.
    fn advance_from(&mut self, mesh: &Mesh, element: usize) {
        for &(gate, end) in &mesh.elements[element].gates {
            let (to, target) = (1 - end, mesh.element(gate, 1 - end));
            if !self.invaded[target] && !self.connection.trapped[target] && self.fronts[gate][to].is_none() {
                self.advance_through(mesh, gate, to);
            } else if self.closed[gate] && self.invaded[target] && self.fronts[gate][to].is_none() {
                self.queue_reconnection(mesh, gate, to);
            }
        }
    }

    /// The division of the pore space into elements.
    pub(crate) fn division(&self) -> Division {
        Division { mesh: self.mesh.clone(), elements: self.elements.clone(), centers: self.centers.clone() }
    }

    /// The types of events.
    pub(crate) fn events(&self) -> Events {
        self.conditions.events
    }

    /// The elements; they tile the pore space.
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// The boundary of an element in m, arcs as chords, for pictures; the last point is not repeated.
    pub fn outline(&self, element: usize) -> Vec<Vec2> {
        outline(&self.mesh.loops[element])
    }

    /// The centroid of its outline in m.
    pub(crate) fn center(&self, element: usize) -> Vec2 {
        centroid(&self.outline(element))
    }

    /// The phase in an element.
    pub fn phase(&self, element: usize) -> Phase {
        if self.invaded[self.mesh.element_of[element]] { Phase::Invading } else { Phase::Defending }
    }

    /// Whether an element is open at an inlet or an outlet.
    pub(crate) fn is_manifold(&self, element: usize) -> bool {
        let open = self.mesh.elements[self.mesh.element_of[element]].open;
        (0..4).any(|side| open[side] && (self.conditions.inlet[side] || self.conditions.outlet[side]))
    }

    /// Whether an element holds trapped defending phase.
    pub fn is_trapped(&self, element: usize) -> bool {
        self.connection.trapped[self.mesh.element_of[element]]
    }

    /// Whether the phase in an element no longer follows the applied pressure: trapped, or invading and not connected to the inlet.
    pub(crate) fn is_cut_off(&self, element: usize) -> bool {
        let element = self.mesh.element_of[element];
        self.connection.trapped[element] || (self.invaded[element] && !self.connection.is_joined(element))
    }

    /// The walls around an element.
    pub(crate) fn wall_pieces(&self, element: usize) -> impl Iterator<Item = &WallPiece> {
        self.mesh.loops[element].walls.iter().flat_map(|wall| wall.iter())
    }

    /// Applies a curvature in 1/m below that of the next event.
    pub(crate) fn apply(&mut self, curvature: f64) {
        let mesh = self.mesh.clone();
        self.part_below(&mesh, curvature);
        self.applied = self.applied.max(curvature);
    }

    /// The rings of corner films, if they differ in their connection.
    pub(crate) fn rings(&self) -> Option<&Rings> {
        self.rings.as_deref()
    }

    /// Whether the films of a ring follow the applied pressure: connected to the reservoir of the wetting phase.
    pub(crate) fn is_fed(&self, ring: u32) -> bool {
        self.connection.is_fed(self.mesh.elements.len(), ring as usize)
    }

    /// Whether the invading phase, connected to the inlet, has reached an outlet.
    pub fn reached_outlet(&self) -> bool {
        self.has_reached_outlet
    }

    /// The middles of all gates with a meniscus that the invading phase can advance, in m.
    pub(crate) fn front(&self) -> impl Iterator<Item = Vec2> + '_ {
        let has_front = |&gate: &usize| self.fronts[gate].iter().any(Option::is_some);
        (0..self.fronts.len()).filter(has_front).map(|gate| self.mesh.middle(gate))
    }

    /// The menisci at the applied curvature in 1/m, each a polyline in m.
    pub(crate) fn menisci(&self, applied: f64) -> Vec<Vec<Vec2>> {
        const POINTS: usize = 17;
        let fronts =
            self.fronts.iter().enumerate().flat_map(|(gate, ends)| ends.iter().flatten().map(move |it| (gate, &**it)));
        let at_rest = |(gate, front): (usize, &Front)| {
            front.passage.at(self.head(&self.mesh, gate).local(applied).min(front.own))
        };
        fronts.filter_map(at_rest).map(|meniscus| meniscus.points(POINTS)).collect()
    }

    /// The passage of a meniscus through a throat into its region `to`, 0 or 1, and the walls ahead that it may touch, in the frame of that
    /// region; `None` if the throat is not a gate.
    pub fn passage_through(&self, throat: usize, to: usize) -> Option<(Passage, Vec<Curve>)> {
        let gate = self.mesh.gates.iter().position(|gate| gate.throat == Some(throat))?;
        Some(self.passage(&self.mesh, (gate, to), Vec2::zeros()))
    }

    /// Curvature in 1/m at which menisci burst through each throat, the larger of both directions, under other conditions; NaN for throats that are not gates.
    pub fn entry_curvatures(&self, conditions: &Conditions, throats: usize) -> Vec<f64> {
        let larger = |(gate, it): (usize, &Gate)| {
            let burst = |to| {
                let (passage, _) = self.passage_at(&conditions.angle, &self.mesh, (gate, to), Vec2::zeros());
                let formula = passage.burst().map_or(f64::NAN, |meniscus| meniscus.curvature);
                conditions.burst(it.throat, formula)
            };
            Some((it.throat?, burst(0).max(burst(1))))
        };
        let bursts: Vec<(usize, f64)> = self.mesh.gates.par_iter().enumerate().filter_map(larger).collect();
        let mut found = vec![f64::NAN; throats];
        bursts.into_iter().for_each(|(throat, burst)| found[throat] = burst);
        found
    }
}
