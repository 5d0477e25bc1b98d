//! Displaced phase without a path to the outlet.

use std::collections::HashSet;

use super::Dynamic;
use crate::displacement::Outflow;

impl Dynamic {
    /// For each element, whether it holds the displaced phase without a path to the outlet through this phase.
    pub fn trapped(&self) -> Vec<bool> {
        let outflow = self.displacement.outflow(&self.space.is_outlet);
        (0..self.state.filling.len()).map(|element| !self.is_invaded(element) && !outflow.is_open(element)).collect()
    }

    /// Whether an element of the displaced phase has no path to the outlet once another one, `full`, is full too.
    pub(super) fn is_cut_off(&self, outflow: &Outflow, element: usize, full: usize) -> bool {
        let (mut seen, mut open) = (HashSet::from([element, full]), vec![element]);
        while let Some(element) = open.pop() {
            if outflow.avoids(element, full) {
                return false;
            }
            let gates = self.displacement.gates_of(element).iter();
            let beside = gates.map(|&(gate, end)| self.space.gates[gate].elements[1 - end]);
            open.extend(beside.filter(|&beside| !self.is_invaded(beside) && seen.insert(beside)));
        }
        true
    }
}
