//! Quasi-static displacement: which meniscus moves next, and what it fills.
//!
//! Leaves out touch and overlap: bursts of throats only, at the entry pressure of a slit.

use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::Arc;

use super::graph::{Edge, Network, Pores, Region};
use crate::math::Vec2;

/// The events that move menisci.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Events {
    /// Burst, touch and overlap.
    All,
    /// Burst only.
    BurstOnly,
}

/// What a displacement goes on under.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    /// Contact angle through the defending phase in rad, by shape; the walls at the four sides follow after the last shape.
    pub angle: Vec<f64>,
    /// The sides that the invading phase enters through: left, right, bottom, top.
    pub inlet: [bool; 4],
    /// The sides that the defending phase leaves through.
    pub outlet: [bool; 4],
    /// Whether defending regions without a way out are trapped.
    pub trapping: bool,
    /// The events that move menisci.
    pub events: Events,
    /// No event takes place above this applied curvature in 1/m.
    pub largest_curvature: f64,
}

/// The phases of a displacement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The one that is displaced.
    Defending,
    /// The one that comes in.
    Invading,
}

/// What makes a meniscus move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// It passes the largest curvature of its throat.
    Burst,
    /// It touches a third wall.
    Touch,
    /// It meets its neighbor on a wall.
    Overlap,
    /// A trapped region is joined to another one and free again.
    Reconnection,
}

/// One event.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// What happened.
    pub kind: EventKind,
    /// The throat that was passed, where there is one.
    pub throat: Option<usize>,
    /// The elements that the invading phase filled.
    pub elements: Vec<usize>,
    /// Curvature of the meniscus at the event in 1/m.
    pub curvature: f64,
    /// The largest one so far in 1/m: what is applied.
    pub applied: f64,
}

/// A part of the pore space that one event fills.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// The region that it is part of.
    pub region: usize,
    /// Area in m2.
    pub area: f64,
    /// Its boundary in m, for pictures.
    pub outline: Vec<Vec2>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Candidate {
    curvature: f64,
    throat: usize,
    element: usize,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other
            .curvature
            .total_cmp(&self.curvature)
            .then_with(|| (other.throat, other.element).cmp(&(self.throat, self.element)))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// A displacement in progress.
#[derive(Debug, Clone)]
pub struct Displacement {
    network: Arc<Network>,
    pores: Arc<Pores>,
    conditions: Conditions,
    elements: Arc<Vec<Element>>,
    throats_of: Arc<Vec<Vec<usize>>>,
    invaded: Vec<bool>,
    trapped: Vec<bool>,
    heap: BinaryHeap<Candidate>,
    applied: f64,
}

impl Displacement {
    /// A pore space full of the defending phase.
    #[must_use]
    pub fn new(network: Arc<Network>, pores: Arc<Pores>, conditions: Conditions) -> Self {
        let elements: Vec<Element> = network
            .regions
            .iter()
            .enumerate()
            .map(|(region, it)| Element { region, area: it.area, outline: outline(it) })
            .collect();
        let mut throats_of = vec![Vec::new(); elements.len()];
        for (index, throat) in network.throats.iter().enumerate() {
            throat.regions.iter().for_each(|&region| throats_of[region].push(index));
        }
        let invaded = vec![false; elements.len()];
        Self {
            network,
            pores,
            elements: Arc::new(elements),
            throats_of: Arc::new(throats_of),
            trapped: vec![false; invaded.len()],
            invaded,
            heap: BinaryHeap::new(),
            applied: f64::NEG_INFINITY,
            conditions,
        }
        .begun()
    }

    fn begun(mut self) -> Self {
        self.heap.clear();
        self.applied = f64::NEG_INFINITY;
        for (index, opening) in self.network.openings.iter().enumerate() {
            if self.conditions.inlet[opening.side] && !self.invaded[opening.region] {
                let throat = self.network.throats.len() + index;
                self.heap.push(Candidate { curvature: 0.0, throat, element: opening.region });
            }
        }
        for element in 0..self.elements.len() {
            if self.invaded[element] {
                self.push_neighbors(element);
            }
        }
        self.find_trapped();
        self
    }

    fn push_neighbors(&mut self, element: usize) {
        for &throat in &self.throats_of[element] {
            let [a, b] = self.network.throats[throat].regions;
            let ahead = if a == element { b } else { a };
            if !self.invaded[ahead] {
                self.heap.push(Candidate { curvature: self.entry_curvature(throat), throat, element: ahead });
            }
        }
    }

    /// Curvature at which a meniscus enters a throat, in 1/m.
    #[must_use]
    pub fn entry_curvature(&self, throat: usize) -> f64 {
        let it = &self.network.throats[throat];
        it.shapes.iter().map(|&shape| self.conditions.angle[shape as usize].cos()).sum::<f64>() / it.width
    }

    fn find_trapped(&mut self) {
        if !self.conditions.trapping || self.conditions.outlet == [false; 4] {
            return;
        }
        let mut free = vec![false; self.elements.len()];
        let open = self.network.openings.iter().filter(|opening| self.conditions.outlet[opening.side]);
        let mut stack: Vec<usize> = open.map(|opening| opening.region).filter(|&r| !self.invaded[r]).collect();
        while let Some(element) = stack.pop() {
            if std::mem::replace(&mut free[element], true) {
                continue;
            }
            for &throat in &self.throats_of[element] {
                let ahead = self.network.throats[throat].regions;
                stack.extend(ahead.into_iter().filter(|&r| !self.invaded[r] && !free[r]));
            }
        }
        for (element, free) in free.into_iter().enumerate() {
            self.trapped[element] = !self.invaded[element] && !free;
        }
    }

    /// The same state with the phases exchanged.
    #[must_use]
    pub fn reverse(mut self, conditions: Conditions) -> Self {
        self.invaded.iter_mut().for_each(|invaded| *invaded = !*invaded);
        self.conditions = conditions;
        self.begun()
    }

    /// The elements; they tile the pore space.
    #[must_use]
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// The phase that an element holds.
    #[must_use]
    pub fn phase(&self, element: usize) -> Phase {
        if self.invaded[element] { Phase::Invading } else { Phase::Defending }
    }

    /// Whether an element holds the defending phase and cannot let it go.
    #[must_use]
    pub fn is_trapped(&self, element: usize) -> bool {
        self.trapped[element]
    }

    /// The menisci at an applied curvature in 1/m, each a polyline in m.
    #[must_use]
    pub fn menisci(&self, _applied: f64) -> Vec<Vec<Vec2>> {
        let stands = |&&throat: &&usize| {
            let [a, b] = self.network.throats[throat].regions;
            self.invaded[a] != self.invaded[b]
        };
        self.pores.throats.iter().filter(stands).map(|&throat| self.network.throats[throat].contacts.to_vec()).collect()
    }

    /// Whether the invading phase has reached an outlet.
    #[must_use]
    pub fn reached_outlet(&self) -> bool {
        self.network.openings.iter().any(|opening| self.conditions.outlet[opening.side] && self.invaded[opening.region])
    }
}

/// The next event, which is done; none where nothing can move any more.
impl Iterator for Displacement {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        while let Some(candidate) = self.heap.pop() {
            let Candidate { curvature, throat, element } = candidate;
            if self.invaded[element] || self.trapped[element] {
                continue;
            }
            if curvature > self.conditions.largest_curvature {
                self.heap.push(candidate);
                return None;
            }
            self.invaded[element] = true;
            self.applied = self.applied.max(curvature);
            self.push_neighbors(element);
            self.find_trapped();
            let throat = (throat < self.network.throats.len()).then_some(throat);
            return Some(Event {
                kind: EventKind::Burst,
                throat,
                elements: vec![element],
                curvature,
                applied: self.applied,
            });
        }
        None
    }
}

/// The boundary of a region with its arcs as chords of at most a few degrees.
pub(super) fn outline(region: &Region) -> Vec<Vec2> {
    /// Chords along a full circle.
    const CHORDS: f64 = 72.0;
    let mut points = Vec::new();
    for edge in &region.edges {
        match edge {
            Edge::Wall(pieces) => {
                for piece in pieces {
                    let (out, back) = (piece.curve.tangent(0.0), piece.curve.tangent(1.0));
                    let turn = out.dot(&back).clamp(-1.0, 1.0).acos() / std::f64::consts::TAU;
                    let count = (turn * CHORDS).ceil().max(1.0);
                    points.extend((0..count as u32).map(|i| piece.curve.point(f64::from(i) / count)));
                }
            }
            Edge::Throat { from, .. } | Edge::Opening { from, .. } => points.push(*from),
        }
    }
    points
}
