//! Paths of the defending phase to the outlets, of which each element stores the next one.

use super::connected::Graph;

/// Paths of the defending phase to the outlets.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Outflow {
    /// The next element on the path; an outlet element leads to itself. `None` without a path.
    next: Vec<Option<usize>>,
}

impl Outflow {
    /// Paths to the elements marked as outlets, whatever phase they hold, through the elements marked as defending.
    pub(super) fn new(graph: Graph, defends: &[bool], is_outlet: &[bool]) -> Self {
        let mut next = vec![None; graph.nodes()];
        let mut queue: Vec<usize> = (0..graph.nodes()).filter(|&node| is_outlet[node]).collect();
        queue.iter().for_each(|&e| next[e] = Some(e));
        let mut at = 0;
        while let Some(&element) = queue.get(at) {
            at += 1;
            for other in graph.neighbors(element) {
                if defends[other] && next[other].is_none() {
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
}
