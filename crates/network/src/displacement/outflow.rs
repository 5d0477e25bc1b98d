//! Connectivity of the defending phase to the outlets: a forest of paths, repaired after each event.
//!
//! Every connected element stores the next one on its path. When an element is lost, those whose path led through it search another path;
//! those without one are trapped. Only they are visited, so the cost of an event is proportional to what it cuts off or redirects.
//!
//! An element open at an outlet lets both phases out: the invading phase leaves through it without closing it. Otherwise the first finger
//! to reach a manifold along a whole side would trap all remaining defending phase.

use super::mesh::Mesh;

/// Paths of the defending phase to the outlets.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Outflow {
    /// The next element on the path; an outlet element leads to itself. `None` without a path.
    next: Vec<Option<usize>>,
}

impl Outflow {
    /// Paths to the elements marked as outlets, whatever phase they hold, through the elements marked as defending.
    pub(crate) fn new(mesh: &Mesh, closed: &[bool], defends: &[bool], is_outlet: &[bool]) -> Self {
        let mut next = vec![None; defends.len()];
        let mut queue: Vec<usize> = (0..defends.len()).filter(|&e| is_outlet[e]).collect();
        queue.iter().for_each(|&e| next[e] = Some(e));
        let mut at = 0;
        while let Some(&element) = queue.get(at) {
            at += 1;
            for other in mesh.neighbors(closed, element) {
                if defends[other] && next[other].is_none() {
                    next[other] = Some(element);
                    queue.push(other);
                }
            }
        }
        Self { next }
    }

    /// Whether the element has a path to an outlet.
    pub(crate) fn is_open(&self, element: usize) -> bool {
        self.next[element].is_some()
    }

    /// Removes an element, and returns those that have no path any more.
    pub(crate) fn remove(&mut self, mesh: &Mesh, closed: &[bool], element: usize) -> Vec<usize> {
        if self.next[element] == Some(element) {
            return Vec::new();
        }
        self.next[element] = None;
        let lost = self.cut_from(mesh, closed, element);
        self.mend(mesh, closed, lost)
    }

    /// Removes a gate between two elements, which is closed already, and returns those that have no path any more.
    pub(crate) fn close(&mut self, mesh: &Mesh, closed: &[bool], [one, other]: [usize; 2]) -> Vec<usize> {
        if mesh.neighbors(closed, one).any(|beside| beside == other) {
            return Vec::new();
        }
        let through = [(one, other), (other, one)].into_iter().find(|&(from, to)| self.next[from] == Some(to));
        let Some((from, _)) = through.filter(|_| one != other) else { return Vec::new() };
        self.next[from] = None;
        self.mend(mesh, closed, vec![from])
    }

    /// Clears the path of all neighbors of an element whose path leads through it.
    fn cut_from(&mut self, mesh: &Mesh, closed: &[bool], element: usize) -> Vec<usize> {
        let mut lost = Vec::new();
        for other in mesh.neighbors(closed, element) {
            if other != element && self.next[other] == Some(element) {
                self.next[other] = None;
                lost.push(other);
            }
        }
        lost
    }

    /// Finds new paths for elements that have lost theirs and for all whose path led through them; returns those without one.
    fn mend(&mut self, mesh: &Mesh, closed: &[bool], mut lost: Vec<usize>) -> Vec<usize> {
        // The nearest first.
        let mut at = 0;
        while let Some(&cut) = lost.get(at) {
            at += 1;
            lost.extend(self.cut_from(mesh, closed, cut));
        }
        // New paths start from elements beside connected ones, and spread among the others.
        let mut queue = Vec::new();
        for &cut in &lost {
            if let Some(next) = mesh.neighbors(closed, cut).find(|&other| self.next[other].is_some()) {
                self.next[cut] = Some(next);
                queue.push(cut);
            }
        }
        let mut is_lost = lost.clone();
        is_lost.sort_unstable();
        let mut at = 0;
        while let Some(&found) = queue.get(at) {
            at += 1;
            for other in mesh.neighbors(closed, found) {
                if self.next[other].is_none() && is_lost.binary_search(&other).is_ok() {
                    self.next[other] = Some(found);
                    queue.push(other);
                }
            }
        }
        lost.retain(|&cut| self.next[cut].is_none());
        lost
    }
}
