//! Ways of the displaced phase to the outlet.

use std::collections::HashSet;

use super::Dynamic;
use super::graph::WaysOut;

impl Dynamic {
    /// The ways in the present state, the shortest by number of elements.
    pub(super) fn ways_out(&self) -> WaysOut {
        let count = self.state.filling.len();
        let mut next = vec![None; count];
        let mut queue: Vec<usize> =
            (0..count).filter(|&element| self.space.is_outlet[element] && !self.is_invaded(element)).collect();
        queue.iter().for_each(|&element| next[element] = Some(element));
        let mut at = 0;
        while let Some(&element) = queue.get(at) {
            at += 1;
            for beside in self.beside(element) {
                if next[beside].is_none() && !self.is_invaded(beside) {
                    next[beside] = Some(element);
                    queue.push(beside);
                }
            }
        }
        WaysOut { next }
    }

    fn beside(&self, element: usize) -> impl Iterator<Item = usize> + '_ {
        self.displacement.gates_of(element).iter().map(|&(gate, end)| self.space.gates[gate].elements[1 - end])
    }

    /// For each element, whether it holds the displaced phase without a way to the outlet through this phase.
    pub fn trapped(&self) -> Vec<bool> {
        let ways = self.ways_out();
        (0..ways.next.len()).map(|element| !self.is_invaded(element) && !ways.exists(element)).collect()
    }

    /// Whether an element of the displaced phase has no way out once another one, `full`, is full too.
    pub(super) fn is_cut_off(&self, ways: &WaysOut, element: usize, full: usize) -> bool {
        let (mut seen, mut open) = (HashSet::from([element, full]), vec![element]);
        while let Some(element) = open.pop() {
            if ways.avoid(element, full) {
                return false;
            }
            open.extend(self.beside(element).filter(|&beside| !self.is_invaded(beside) && seen.insert(beside)));
        }
        true
    }
}
