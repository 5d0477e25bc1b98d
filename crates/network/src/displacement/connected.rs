//! What is connected at one moment: elements by open gates, and rings of corner films by the wetting phase.

use super::mesh::Mesh;
use super::rings::Rings;

/// Phases of elements, gates closed to the non-wetting phase, and films.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) invaded: &'a [bool],
    pub(crate) closed: &'a [bool],
    /// The rings, and for each gate whether it joins two of them; `None` if films do not differ in their connection.
    pub(crate) rings: Option<(&'a Rings, &'a [bool])>,
}

/// The elements and, after them, the rings, as nodes of a graph.
#[derive(Clone, Copy)]
pub(super) struct Graph<'a> {
    mesh: &'a Mesh,
    closed: &'a [bool],
    rings: Option<(&'a Rings, &'a [bool])>,
}

impl<'a> Graph<'a> {
    /// Whether a node is an element, not a ring.
    pub(super) fn is_element(self, node: usize) -> bool {
        node < self.mesh.elements.len()
    }

    /// Number of its nodes.
    pub(super) fn nodes(self) -> usize {
        self.mesh.elements.len() + self.rings.map_or(0, |(rings, _)| rings.count())
    }

    /// The nodes beside an element or a ring.
    pub(super) fn neighbors(self, node: usize) -> impl Iterator<Item = usize> + 'a {
        let elements = self.mesh.elements.len();
        let beside = (node < elements).then(|| self.mesh.neighbors(self.closed, node));
        let of_element = self.rings.filter(|_| node < elements);
        let of_element =
            of_element.map(move |(rings, _)| rings.of_element[node].iter().map(move |&r| elements + r as usize));
        let of_ring = self.rings.filter(|_| node >= elements).map(move |(rings, bridged)| {
            let ring = node - elements;
            let bridged = rings.gates[ring].iter().filter(|&&gate| bridged[gate]);
            let across = bridged.filter_map(move |&gate| rings.across(gate, ring)).map(move |other| elements + other);
            rings.elements[ring].iter().copied().chain(across)
        });
        beside.into_iter().flatten().chain(of_element.into_iter().flatten()).chain(of_ring.into_iter().flatten())
    }
}

impl<'a> Held<'a> {
    /// The graph of a phase; only the wetting phase has paths along rings.
    pub(super) fn graph(self, of_wetting: bool) -> Graph<'a> {
        let Self { mesh, closed, rings, .. } = self;
        Graph { mesh, closed, rings: rings.filter(|_| of_wetting) }
    }
}
