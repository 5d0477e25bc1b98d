//! What elements came to hold in a displacement in time, found from the events by which they were entered.

use super::Dynamic;
use meniscus_core::playback::{Change, Holding};

/// Groups of elements that are joined, each with whether it reaches the outlet.
struct Groups {
    parent: Vec<usize>,
    is_open: Vec<bool>,
    members: Vec<Vec<usize>>,
}

impl Groups {
    fn root(&mut self, mut element: usize) -> usize {
        while self.parent[element] != element {
            self.parent[element] = self.parent[self.parent[element]];
            element = self.parent[element];
        }
        element
    }

    fn reaches_outlet(&mut self, element: usize) -> bool {
        let root = self.root(element);
        self.is_open[root]
    }

    /// Joins the groups of two elements; returns the elements that reach the outlet by this.
    fn join(&mut self, one: usize, other: usize) -> Vec<usize> {
        let (one, other) = (self.root(one), self.root(other));
        if one == other {
            return Vec::new();
        }
        let (large, small) =
            if self.members[one].len() < self.members[other].len() { (other, one) } else { (one, other) };
        let opened = match (self.is_open[large], self.is_open[small]) {
            (true, false) => self.members[small].clone(),
            (false, true) => self.members[large].clone(),
            _ => Vec::new(),
        };
        self.parent[small] = large;
        self.is_open[large] |= self.is_open[small];
        let moved = std::mem::take(&mut self.members[small]);
        self.members[large].extend(moved);
        opened
    }
}

impl Dynamic {
    /// What elements came to hold, by rows of the table of events. Trapped is what has no path to the outlet through elements that were not entered.
    pub(crate) fn changes(&self) -> Vec<Change> {
        let count = self.displacement.elements().len();
        let is_held = |element: usize| self.share(element) > 0.5;
        // Into what was not entered by an event, a meniscus may bulge.
        let row = |e: usize| self.state.invasions[e].filter(|_| is_held(e)).map(|invasion| invasion.sequence);
        let entered: Vec<Option<usize>> = (0..count).map(row).collect();
        let mut changes: Vec<Change> = Vec::new();
        let change = |row: usize, area: usize, holding| Change { row: row as u32, area: area as u32, holding };
        changes.extend((0..count).filter_map(|e| Some(change(entered[e]?, e, Holding::Invaded))));
        changes.extend(self.cut_off_at(&entered).into_iter().map(|(e, row)| change(row, e, Holding::Trapped)));
        changes.sort_by_key(|it| (it.row, it.holding == Holding::Trapped, it.area));
        changes
    }

    /// The elements that lose their path to the outlet before they are entered, each with the row of the event. Backwards in time such paths only appear.
    fn cut_off_at(&self, entered: &[Option<usize>]) -> Vec<(usize, usize)> {
        let count = entered.len();
        let mut groups = Groups {
            parent: (0..count).collect(),
            is_open: self.space.is_outlet.clone(),
            members: (0..count).map(|element| vec![element]).collect(),
        };
        let mut beside = vec![Vec::new(); count];
        for gate in &self.space.gates {
            let [one, other] = gate.elements;
            beside[one].push(other);
            beside[other].push(one);
        }
        let mut present = vec![false; count];
        let mut found = Vec::new();
        let mut add = |element: usize, row: usize, present: &mut Vec<bool>| {
            present[element] = true;
            for &other in beside[element].iter().filter(|&&other| present[other]) {
                let opened = groups.join(element, other);
                // The paths of these end with that event; the element itself is entered by it.
                found.extend(opened.into_iter().filter(|&opened| opened != element).map(|opened| (opened, row)));
            }
        };
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&element| std::cmp::Reverse(entered[element].unwrap_or(usize::MAX)));
        for element in order {
            add(element, entered[element].unwrap_or(usize::MAX), &mut present);
        }
        found.retain(|&(_, row)| row != usize::MAX);
        let never = (0..count).filter(|&element| entered[element] != Some(0));
        let never: Vec<usize> = never.filter(|&element| !groups.reaches_outlet(element)).collect();
        found.extend(never.into_iter().map(|element| (element, 0)));
        found
    }
}
