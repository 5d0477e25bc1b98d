//! What of both phases takes part in a displacement: the one place that knows the rules of trapping.

use super::mesh::Mesh;
use super::outflow::Outflow;
use crate::case::network::Trapping;

/// What of both phases takes part, by the rule of trapping.
#[derive(Debug, Clone)]
pub(super) struct Connection {
    /// Invading elements that are joined to the inlet.
    joined: Vec<bool>,
    /// Ways out of the defending phase; none where nothing is trapped.
    ways: Option<Outflow>,
    /// Defending elements that cannot flow out.
    pub(super) trapped: Vec<bool>,
}

impl Connection {
    /// The connections at the beginning, with the elements from which menisci advance at first. Where no outlet opens, nothing is trapped.
    pub(super) fn begin(rule: Trapping, mesh: &Mesh, invaded: &[bool], opens: [&[bool]; 2]) -> (Self, Vec<usize>) {
        let (count, [inlets, outlets]) = (invaded.len(), opens);
        match rule {
            Trapping::None => {
                let all = (0..count).filter(|&element| invaded[element]).collect();
                (Self { joined: invaded.to_vec(), ways: None, trapped: vec![false; count] }, all)
            }
            Trapping::Disconnected => {
                let defends: Vec<bool> = invaded.iter().map(|invaded| !invaded).collect();
                let ways = outlets.contains(&true).then(|| Outflow::new(mesh, &defends, outlets));
                let trapped = (0..count).map(|e| defends[e] && ways.as_ref().is_some_and(|ways| !ways.is_open(e)));
                let mut begun = Self { joined: vec![false; count], trapped: trapped.collect(), ways };
                let first = (0..count).filter(|&e| inlets[e]).flat_map(|e| begun.join(mesh, invaded, e)).collect();
                (begun, first)
            }
        }
    }

    /// Joins an invading element to the inlet, and returns it with all that is joined by it.
    pub(super) fn join(&mut self, mesh: &Mesh, invaded: &[bool], element: usize) -> Vec<usize> {
        let (mut open, mut found) = (vec![element], Vec::new());
        while let Some(element) = open.pop() {
            if !std::mem::replace(&mut self.joined[element], true) {
                open.extend(mesh.neighbors(element).filter(|&other| invaded[other] && !self.joined[other]));
                found.push(element);
            }
        }
        found
    }

    /// Takes an element from the defending phase, and returns those that are trapped by it.
    pub(super) fn lose(&mut self, mesh: &Mesh, invaded: &[bool], element: usize) -> Vec<usize> {
        let mut lost = self.ways.as_mut().map_or_else(Vec::new, |ways| ways.remove(mesh, element));
        lost.retain(|&lost| !invaded[lost]);
        lost.iter().for_each(|&lost| self.trapped[lost] = true);
        lost
    }
}
