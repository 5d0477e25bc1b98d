//! The graph of a state: nodes are parts of the pore space with one pressure, links the conductors between them.

use std::collections::BTreeMap;

use super::graph::{Graph, Link, LinkKind};
use super::{Drive, Dynamic};
use crate::conductance::LEAST_RESISTANCE as LEAST;
use crate::displacement::FrontId;
use crate::laplacian::{Edge, FlowError, Laplacian};
use meniscus_core::math::root;

/// The node of a filling pore.
struct BodyNode {
    node: usize,
    /// Conductance in m² of all throats on its side.
    conductance: f64,
    /// Least resistance in 1/m² on the other side.
    least: f64,
}

/// Least resistance of a filling pore over that of a throat on the other side.
const LEAST_BODY: f64 = 1e-2;

impl BodyNode {
    /// Joins a throat to the filling pore: half of its resistance on this side is shared with the other throats.
    fn join(&mut self, halves: &mut [f64; 2]) {
        halves[1] *= 0.5;
        self.conductance += 1.0 / halves[1];
        if halves[0] > 0.0 {
            self.least = self.least.min(LEAST_BODY * halves[0]);
        }
    }

    /// Shared resistance in 1/m².
    fn resistance(&self) -> f64 {
        let shared = 1.0 / self.conductance;
        if self.least.is_finite() { shared.max(self.least) } else { shared }
    }
}

impl Dynamic {
    /// The graph of the present state.
    pub(super) fn graph(&self) -> Result<Graph, FlowError> {
        let elements = self.state.filling.len();
        // Adjoining elements of one region that hold the same phase have one pressure.
        let mut parent: Vec<usize> = (0..elements).collect();
        for gate in self.space.gates.iter().filter(|gate| gate.throat.is_none()) {
            let [a, b] = gate.elements;
            if self.is_invaded(a) == self.is_invaded(b) {
                let (a, b) = (root(&mut parent, a), root(&mut parent, b));
                parent[a.max(b)] = a.min(b);
            }
        }
        let mut number = vec![usize::MAX; elements];
        let mut nodes = 0;
        let node_of: Vec<usize> = (0..elements)
            .map(|element| {
                let part = root(&mut parent, element);
                if number[part] == usize::MAX {
                    number[part] = nodes;
                    nodes += 1;
                }
                number[part]
            })
            .collect();
        let inlet = matches!(self.space.terms.drive, Drive::Rate(_)).then_some(nodes);
        nodes += usize::from(inlet.is_some());
        let mut filling_pores = self.filling_pores(&mut nodes);
        let mut link_of = vec![None; self.space.gates.len()];
        let (mut links, mut edges): (Vec<Link>, Vec<Edge>) = (Vec::new(), Vec::new());
        for (index, gate) in self.space.gates.iter().enumerate() {
            let [a, b] = gate.elements;
            let halves = self.halves(index);
            let menisci = &self.state.menisci[index];
            if let Some(end) = (0..2).find(|&end| menisci[end].is_some()) {
                let (from, to) = (gate.elements[1 - end], gate.elements[end]);
                link_of[index] = Some(links.len());
                let mut halves = [halves[1 - end], halves[end]];
                let has_burst = menisci[end].is_some_and(|meniscus| meniscus.has_burst);
                let mut end_node = node_of[to];
                if let Some(filling_pore) = filling_pores.get_mut(&to).filter(|_| has_burst) {
                    end_node = filling_pore.node;
                    filling_pore.join(&mut halves);
                }
                links.push(Link { kind: LinkKind::Meniscus((index, end)), elements: [from, to], halves });
                let is_good = has_burst && self.approaching_outlet((index, end)).is_none();
                edges.push(Edge { ends: (node_of[from], Some(end_node)), is_good });
            } else if gate.throat.is_some() && self.is_invaded(a) == self.is_invaded(b) && node_of[a] != node_of[b] {
                links.push(Link { kind: LinkKind::Open, elements: [a, b], halves });
                edges.push(Edge { ends: (node_of[a], Some(node_of[b])), is_good: true });
            }
        }
        let sides = self.space.openings.iter().filter_map(|&(opening, element)| {
            let side = self.space.network.openings[opening].side;
            let kind = match () {
                () if self.space.terms.inlet[side] => LinkKind::Inlet,
                () if self.space.terms.outlet[side] => LinkKind::Outlet,
                () => return None,
            };
            Some((kind, element, self.space.opening_resistances[opening]))
        });
        let disc = self.space.under_disc.iter().map(|&element| (LinkKind::Inlet, element, self.under_disc(element)));
        for (kind, element, resistance) in sides.chain(disc) {
            // Flow into a filling pore is against the direction of the link.
            let mut halves = [0.0, resistance];
            let mut node = node_of[element];
            if let Some(filling_pore) = filling_pores.get_mut(&element).filter(|_| kind == LinkKind::Inlet) {
                node = filling_pore.node;
                filling_pore.join(&mut halves);
            }
            let to = if kind == LinkKind::Inlet { inlet } else { None };
            links.push(Link { kind, elements: [element; 2], halves: [halves[1], halves[0]] });
            edges.push(Edge { ends: (node, to), is_good: to.is_some() });
        }
        for (&element, filling_pore) in &filling_pores {
            links.push(Link {
                kind: LinkKind::FillingPore(element),
                elements: [element; 2],
                halves: [0.0, filling_pore.resistance()],
            });
            edges.push(Edge { ends: (filling_pore.node, Some(node_of[element])), is_good: false });
        }
        Ok(Graph {
            laplacian: Laplacian::new(nodes, edges)?,
            links,
            nodes,
            inlet,
            link_of,
            outflow: self.displacement.outflow(&self.space.is_outlet),
        })
    }

    /// The filling pores, each with a node of its own.
    fn filling_pores(&self, nodes: &mut usize) -> BTreeMap<usize, BodyNode> {
        // An element between two menisci that have merged around a grain fills once a meniscus has entered it.
        let enters = |&(gate, end): &FrontId| self.state.menisci[gate][end].is_some_and(|meniscus| meniscus.has_burst);
        let is_entered = |&e: &usize| {
            let has_way_in = self.space.is_inlet[e] || self.displacement.gates_of(e).iter().any(enters);
            self.state.filling[e].is_some() && !self.space.is_outlet[e] && has_way_in
        };
        let filling = (0..self.state.filling.len()).filter(is_entered);
        let mut next = || {
            *nodes += 1;
            BodyNode { node: *nodes - 1, conductance: 0.0, least: f64::INFINITY }
        };
        filling.map(|element| (element, next())).collect()
    }

    /// Resistances in 1/m² of both sides of a gate. A segment that divides a region resists as a square channel of its width.
    fn halves(&self, gate: usize) -> [f64; 2] {
        let facts = &self.space.gates[gate];
        let width = facts.width;
        match facts.throat {
            Some(throat) => {
                let halves = self.space.resistances[throat];
                let missing = (LEAST / (width * width) - halves[0] - halves[1]).max(0.0);
                halves.map(|half| half + 0.5 * missing)
            }
            None => [6.0 / (width * width); 2],
        }
    }

    /// Resistance in 1/m² between the disc of the inlet and an element under it: the least, since both lie one upon the other.
    fn under_disc(&self, element: usize) -> f64 {
        let radius = self.space.network.regions[self.displacement.region(element)].radius;
        LEAST / (4.0 * radius * radius)
    }

    /// Viscosity in Pa s of the phase in an element; in a filling element the mean by area.
    pub(super) fn viscosity(&self, element: usize) -> f64 {
        let [invading, defending] = self.space.terms.viscosity;
        match &self.state.filling[element] {
            _ if self.is_invaded(element) => invading,
            Some(_) => defending + self.share(element) * (invading - defending),
            None => defending,
        }
    }
}
