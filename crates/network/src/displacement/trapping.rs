//! Connectivity of both phases, by the rules of trapping, which are implemented only here.

use super::conditions::{Conditions, CornerFilms};
use super::mesh::Mesh;
use super::outflow::Outflow;
use meniscus_case::network::Trapping;

/// Connectivity of both phases by the trapping rule.
#[derive(Debug, Clone)]
pub(super) struct Connection {
    /// Invading elements connected to the inlet.
    joined: Vec<bool>,
    /// Paths of the defending phase to the outlets; `None` if nothing is trapped.
    paths: Option<Outflow>,
    /// Trapped elements of the defending phase.
    pub(super) trapped: Vec<bool>,
}

/// Phases of elements, and gates closed to the non-wetting phase.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) invaded: &'a [bool],
    pub(crate) closed: &'a [bool],
}

impl Connection {
    /// Initial connectivity, with the elements from which menisci first advance. Without an open outlet nothing is trapped. Corner films connect
    /// the wetting phase everywhere.
    pub(super) fn begin(conditions: &Conditions, held: Held, opens: [&[bool]; 2]) -> (Self, Vec<usize>) {
        let Held { mesh, invaded, closed } = held;
        let (count, [inlets, outlets]) = (invaded.len(), opens);
        let is_free = conditions.trapping == Trapping::None;
        let paths = if is_free || conditions.films == CornerFilms::Drain || !outlets.contains(&true) {
            None
        } else {
            let defends: Vec<bool> = invaded.iter().map(|invaded| !invaded).collect();
            Some(Outflow::new(mesh, closed, &defends, outlets))
        };
        let trapped = (0..count).map(|e| !invaded[e] && paths.as_ref().is_some_and(|it| !it.is_open(e))).collect();
        if is_free || matches!(conditions.films, CornerFilms::Join { .. }) {
            let all = (0..count).filter(|&element| invaded[element]).collect();
            return (Self { joined: invaded.to_vec(), paths, trapped }, all);
        }
        let mut begun = Self { joined: vec![false; count], trapped, paths };
        let first = (0..count).filter(|&e| inlets[e]).flat_map(|e| begun.join(held, e)).collect();
        (begun, first)
    }

    /// Connects an invading element to the inlet, and returns it with all elements connected through it.
    pub(super) fn join(&mut self, held: Held, element: usize) -> Vec<usize> {
        let (mut open, mut found) = (vec![element], Vec::new());
        while let Some(element) = open.pop() {
            if !std::mem::replace(&mut self.joined[element], true) {
                let beside = held.mesh.neighbors(held.closed, element);
                open.extend(beside.filter(|&other| held.invaded[other] && !self.joined[other]));
                found.push(element);
            }
        }
        found
    }

    /// Whether an invading element is connected to the inlet.
    pub(super) fn is_joined(&self, element: usize) -> bool {
        self.joined[element]
    }

    /// Removes an element from the defending phase, and returns those that this traps.
    pub(super) fn remove(&mut self, held: Held, element: usize) -> Vec<usize> {
        let lost = self.paths.as_mut().map_or_else(Vec::new, |it| it.remove(held.mesh, held.closed, element));
        self.trap(held, lost)
    }

    /// Closes the gate between two elements to the defending phase, and returns those that this traps.
    pub(super) fn close(&mut self, held: Held, between: [usize; 2]) -> Vec<usize> {
        let lost = self.paths.as_mut().map_or_else(Vec::new, |it| it.close(held.mesh, held.closed, between));
        self.trap(held, lost)
    }

    fn trap(&mut self, held: Held, mut lost: Vec<usize>) -> Vec<usize> {
        lost.retain(|&lost| !held.invaded[lost]);
        lost.iter().for_each(|&lost| self.trapped[lost] = true);
        lost
    }
}
