//! Connectivity of both phases, by the rules of trapping, which are implemented only here.

use super::conditions::{Conditions, CornerFilms};
use super::connected::Held;
use super::reachable::Reachable;
use meniscus_case::network::Trapping;

/// Connectivity of both phases by the trapping rule.
#[derive(Debug, Clone)]
pub(super) struct Connection {
    /// Invading elements connected to the inlet, then rings of the invading phase that are.
    joined: Vec<bool>,
    /// What of the defending phase reaches an outlet; `None` if nothing is trapped.
    reachable: Option<Reachable>,
    /// Trapped elements of the defending phase.
    pub(super) trapped: Vec<bool>,
    /// Whether the wetting phase defends.
    drains: bool,
    /// Rings that were connected to the inlet since this was last emptied.
    pub(super) newly_fed: Vec<usize>,
    /// Elements and rings of another phase or connection since this was last emptied; `None` until changes are watched.
    pub(super) changed: Option<Vec<usize>>,
}

impl Connection {
    /// Initial connectivity, with the elements from which menisci first advance. Without an open outlet nothing is trapped. Joined corner films connect
    /// the wetting phase everywhere.
    pub(super) fn begin(conditions: &Conditions, held: Held, opens: [&[bool]; 2]) -> (Self, Vec<usize>) {
        let Held { invaded, .. } = held;
        let (count, [inlets, outlets]) = (invaded.len(), opens);
        let is_free = conditions.trapping == Trapping::None;
        let (drains, joined_films) = match &conditions.films {
            CornerFilms::Absent => (false, false),
            CornerFilms::Drain(paths) => (true, paths.rings.is_none()),
            CornerFilms::Join(paths) => (false, paths.rings.is_none()),
        };
        let reachable = if is_free || (drains && joined_films) || !outlets.contains(&true) {
            None
        } else {
            let defends: Vec<bool> = invaded.iter().map(|invaded| !invaded).collect();
            let mut is_outlet = outlets.to_vec();
            is_outlet.extend(
                held.rings.filter(|_| drains).map_or_else(Vec::new, |(rings, _)| rings.reach(conditions.outlet)),
            );
            Some(Reachable::new(held.graph(drains), &defends, is_outlet))
        };
        let is_cut_off = |e: usize| !invaded[e] && reachable.as_ref().is_some_and(|it| !it.is_open(e));
        let trapped = (0..count).map(is_cut_off).collect();
        let mut begun = Self { joined: Vec::new(), trapped, reachable, drains, newly_fed: Vec::new(), changed: None };
        if is_free || (joined_films && !drains) {
            let all = (0..count).filter(|&element| invaded[element]).collect();
            begun.joined = invaded.to_vec();
            begun.joined.resize(held.graph(!drains).nodes(), true);
            begun.newly_fed = (0..begun.joined.len() - count).collect();
            return (begun, all);
        }
        begun.joined = vec![false; held.graph(!drains).nodes()];
        let reached = held.rings.filter(|_| !drains).map_or_else(Vec::new, |(rings, _)| rings.reach(conditions.inlet));
        let inlets = inlets.iter().chain(&reached).enumerate().filter(|(_, is_inlet)| **is_inlet);
        let first = inlets.flat_map(|(node, _)| begun.join(held, node)).collect();
        (begun, first)
    }

    /// Connects an invading element, or a ring, to the inlet, and returns it with all elements connected through it.
    pub(super) fn join(&mut self, held: Held, from: usize) -> Vec<usize> {
        let (mut open, mut found) = (vec![from], Vec::new());
        let (graph, elements) = (held.graph(!self.drains), held.invaded.len());
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut self.joined[node], true) {
                self.note(&[node]);
                let is_reached =
                    |&other: &usize| held.invaded.get(other).is_none_or(|invaded| *invaded) && !self.joined[other];
                open.extend(graph.neighbors(node).filter(is_reached));
                if node < elements {
                    found.push(node);
                } else {
                    self.newly_fed.push(node - elements);
                }
            }
        }
        found
    }

    /// Notes elements and rings of another phase or connection.
    pub(super) fn note(&mut self, nodes: &[usize]) {
        self.changed.iter_mut().for_each(|changed| changed.extend(nodes));
    }

    /// Whether an invading element is connected to the inlet.
    pub(super) fn is_joined(&self, element: usize) -> bool {
        self.joined[element]
    }

    /// Whether the films of a ring are connected to the reservoir of the wetting phase, that of the outlet or of the inlet.
    pub(super) fn is_fed(&self, elements: usize, ring: usize) -> bool {
        if self.drains {
            self.reachable.as_ref().is_none_or(|reachable| reachable.is_open(elements + ring))
        } else {
            self.joined.get(elements + ring).is_none_or(|joined| *joined)
        }
    }

    /// Takes elements from the defending phase, and closes the gates between pairs of others to it; returns the elements that this traps.
    pub(super) fn remove(&mut self, held: Held, elements: &[usize], closed: &[[usize; 2]]) -> Vec<usize> {
        let graph = held.graph(self.drains);
        let mut lost = self.reachable.as_mut().map_or_else(Vec::new, |it| it.cut(graph, elements, closed));
        self.note(&lost);
        lost.retain(|&lost| held.invaded.get(lost).is_some_and(|invaded| !invaded));
        lost.iter().for_each(|&lost| self.trapped[lost] = true);
        lost
    }

    /// Parts two rings that a gate joined, and returns the elements that this traps.
    pub(super) fn part(&mut self, held: Held, rings: [usize; 2]) -> Vec<usize> {
        let elements = held.invaded.len();
        self.remove(held, &[], &[rings.map(|ring| elements + ring)])
    }
}
