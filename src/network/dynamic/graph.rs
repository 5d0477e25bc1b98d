//! The network as conductors: which parts of the pore space share a pressure, and what flows between them.

use super::{Drive, Dynamic};
use crate::network::conductance::LEAST_RESISTANCE as LEAST;
use crate::network::displacement::FrontId;
use crate::network::laplacian::{Edge, FlowError, Laplacian, root};

/// A way for fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Way {
    /// A throat with one phase on both sides.
    Open,
    /// A gate with a meniscus.
    Meniscus(FrontId),
    /// An opening of the inlet.
    Inlet,
    /// An opening of the outlet.
    Outlet,
}

/// A conductor with the elements that it joins; one at an open side has its element twice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Link {
    pub way: Way,
    pub elements: [usize; 2],
    /// Resistances in 1/m² on the side of each element.
    pub halves: [f64; 2],
}

/// All conductors of a state, until an event changes it.
#[derive(Debug, Clone)]
pub(super) struct Graph {
    pub laplacian: Laplacian,
    pub links: Vec<Link>,
    pub nodes: usize,
    /// The node of the inlet, where a rate is given.
    pub inlet: Option<usize>,
    /// Whether an element is being filled.
    pub is_filling: bool,
}

impl Dynamic {
    /// The conductors of the present state.
    pub(super) fn graph(&self) -> Result<Graph, FlowError> {
        let elements = self.state.filling.len();
        // Elements of one region that hold the same phase side by side have one pressure.
        let mut parent: Vec<usize> = (0..elements).collect();
        for gate in self.gates.iter().filter(|gate| gate.throat.is_none()) {
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
        let inlet = matches!(self.terms.drive, Drive::Rate(_)).then_some(nodes);
        nodes += usize::from(inlet.is_some());
        let (mut links, mut edges): (Vec<Link>, Vec<Edge>) = (Vec::new(), Vec::new());
        for (index, gate) in self.gates.iter().enumerate() {
            let [a, b] = gate.elements;
            let halves = self.halves(index);
            let menisci = &self.state.menisci[index];
            if let Some(end) = (0..2).find(|&end| menisci[end].is_some()) {
                let (from, to) = (gate.elements[1 - end], gate.elements[end]);
                links.push(Link {
                    way: Way::Meniscus((index, end)),
                    elements: [from, to],
                    halves: [halves[1 - end], halves[end]],
                });
                let is_good = menisci[end].is_some_and(|meniscus| meniscus.has_burst);
                edges.push(Edge { ends: (node_of[from], Some(node_of[to])), is_good });
            } else if gate.throat.is_some() && self.is_invaded(a) == self.is_invaded(b) && node_of[a] != node_of[b] {
                links.push(Link { way: Way::Open, elements: [a, b], halves });
                edges.push(Edge { ends: (node_of[a], Some(node_of[b])), is_good: true });
            }
        }
        for &(opening, element) in &self.openings {
            let side = self.network.openings[opening].side;
            let way = match () {
                () if self.terms.inlet[side] => Way::Inlet,
                () if self.terms.outlet[side] => Way::Outlet,
                () => continue,
            };
            links.push(Link { way, elements: [element; 2], halves: [self.opening_resistances[opening], 0.0] });
            let to = if way == Way::Inlet { inlet } else { None };
            edges.push(Edge { ends: (node_of[element], to), is_good: to.is_some() });
        }
        Ok(Graph {
            laplacian: Laplacian::new(nodes, edges)?,
            links,
            nodes,
            inlet,
            is_filling: self.state.filling.iter().any(Option::is_some),
        })
    }

    /// Resistances in 1/m² of both sides of a gate. Across a segment that divides a region a phase flows as through a square of its width.
    fn halves(&self, gate: usize) -> [f64; 2] {
        let facts = &self.gates[gate];
        let width = facts.width;
        match facts.throat {
            Some(throat) => {
                let halves = self.resistances[throat];
                let missing = (LEAST / (width * width) - halves[0] - halves[1]).max(0.0);
                halves.map(|half| half + 0.5 * missing)
            }
            None => [6.0 / (width * width); 2],
        }
    }

    /// Viscosity in Pa s of what an element holds: of one that is being filled, the mean by area.
    pub(super) fn viscosity(&self, element: usize) -> f64 {
        let [invading, defending] = self.terms.viscosity;
        match &self.state.filling[element] {
            _ if self.is_invaded(element) => invading,
            Some(_) => defending + self.share(element) * (invading - defending),
            None => defending,
        }
    }
}
