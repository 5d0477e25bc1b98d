//! Connectivity of the defending phase to the outlets: a forest of paths, repaired after each event.
//!
//! Every connected element stores the next one on its path. When an element is lost, those whose path led through it search another path;
//! those without one are trapped. Only they are visited, so the cost of an event is proportional to what it cuts off or redirects.
//!
//! An element open at an outlet lets both phases out: the invading phase leaves through it without closing it. Otherwise the first finger
//! to reach a manifold along a whole side would trap all remaining defending phase.

use super::connected::Graph;

/// Paths of the defending phase to the outlets.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Outflow {
    /// The next element on the path; an outlet element leads to itself. `None` without a path.
    next: Vec<Option<usize>>,
}

impl Outflow {
    /// Paths to the elements marked as outlets, whatever phase they hold, through the elements marked as defending and all rings.
    pub(super) fn new(graph: Graph, defends: &[bool], is_outlet: &[bool]) -> Self {
        let mut next = vec![None; graph.nodes()];
        let mut queue: Vec<usize> = (0..graph.nodes()).filter(|&node| is_outlet[node]).collect();
        queue.iter().for_each(|&e| next[e] = Some(e));
        let mut at = 0;
        while let Some(&element) = queue.get(at) {
            at += 1;
            for other in graph.neighbors(element) {
                if defends.get(other).is_none_or(|defends| *defends)
                    && next[other].is_none()
                    && graph.leads(other, element)
                {
                    next[other] = Some(element);
                    queue.push(other);
                }
            }
        }
        Self { next }
    }

    /// Whether the element has a path to an outlet that does not lead through another one.
    pub(crate) fn avoids(&self, mut element: usize, other: usize) -> bool {
        while element != other {
            match self.next[element] {
                Some(next) if next == element => return true,
                Some(next) => element = next,
                None => return false,
            }
        }
        false
    }

    /// Whether the element has a path to an outlet.
    pub(crate) fn is_open(&self, element: usize) -> bool {
        self.next[element].is_some()
    }

    /// Removes an element, and returns those that have no path any more.
    pub(super) fn remove(&mut self, graph: Graph, element: usize) -> Vec<usize> {
        let is_outlet = self.next[element] == Some(element);
        if !is_outlet {
            self.next[element] = None;
        }
        let lost = self.cut_from(graph, element);
        self.mend(graph, lost)
    }

    /// Removes the direct path between two elements or two rings, which is closed already, and returns those that have none any more.
    pub(super) fn close(&mut self, graph: Graph, [one, other]: [usize; 2]) -> Vec<usize> {
        if graph.neighbors(one).any(|beside| beside == other) {
            return Vec::new();
        }
        let through = [(one, other), (other, one)].into_iter().find(|&(from, to)| self.next[from] == Some(to));
        let Some((from, _)) = through.filter(|_| one != other) else { return Vec::new() };
        self.next[from] = None;
        self.mend(graph, vec![from])
    }

    /// Clears the path of all neighbors of an element whose path leads through it.
    fn cut_from(&mut self, graph: Graph, element: usize) -> Vec<usize> {
        let mut lost = Vec::new();
        for other in graph.neighbors(element) {
            if other != element
                && self.next[other] == Some(element)
                && !(self.next[element] == Some(element) && graph.leads(other, element))
            {
                self.next[other] = None;
                lost.push(other);
            }
        }
        lost
    }

    /// Finds new paths for elements that have lost theirs and for all whose path led through them; returns those without one.
    fn mend(&mut self, graph: Graph, mut lost: Vec<usize>) -> Vec<usize> {
        // The nearest first.
        let mut at = 0;
        while let Some(&cut) = lost.get(at) {
            at += 1;
            lost.extend(self.cut_from(graph, cut));
        }
        // New paths start from elements beside connected ones, and spread among the others.
        let mut queue = Vec::new();
        for &cut in &lost {
            if let Some(next) =
                graph.neighbors(cut).find(|&other| self.next[other].is_some() && graph.leads(cut, other))
            {
                self.next[cut] = Some(next);
                queue.push(cut);
            }
        }
        let mut is_lost = lost.clone();
        is_lost.sort_unstable();
        let mut at = 0;
        while let Some(&found) = queue.get(at) {
            at += 1;
            for other in graph.neighbors(found) {
                if self.next[other].is_none() && is_lost.binary_search(&other).is_ok() && graph.leads(other, found) {
                    self.next[other] = Some(found);
                    queue.push(other);
                }
            }
        }
        lost.retain(|&cut| self.next[cut].is_none());
        lost
    }
}
