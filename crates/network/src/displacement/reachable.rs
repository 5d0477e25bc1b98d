//! What of the defending phase reaches an outlet, as elements are lost one after another.
//!
//! Searches in breadth start from all neighbors of what is lost and advance in step; those that meet become one. A search that ends before the others has gone
//! through a part of its own, which is trapped unless it has an outlet; the last one need not end, since something of what was connected still is. The cost of
//! an event is that of its smaller parts, in total n log n.
//!
//! An element open at an outlet lets both phases out: the invading phase leaves through it without closing it. Otherwise the first finger
//! to reach a manifold along a whole side would trap all remaining defending phase.

use std::collections::VecDeque;

use super::connected::Graph;
use meniscus_core::math::root;

/// Which nodes, elements and rings, reach an outlet through the defending phase and rings.
#[derive(Debug, Clone)]
pub(super) struct Reachable {
    /// Whether each node reaches an outlet, or is one.
    is_open: Vec<bool>,
    is_outlet: Vec<bool>,
    /// Whether each node is an element of the invading phase.
    is_lost: Vec<bool>,
    /// By node the number of the last cut whose searches came there, and the search.
    seen: Vec<(u32, u32)>,
    cuts: u32,
}

/// A search from one of the neighbors of what is lost, with those that it has met.
#[derive(Default)]
struct Search {
    found: Vec<usize>,
    /// Found nodes whose neighbors are not.
    next: VecDeque<usize>,
    has_outlet: bool,
}

/// Searches that advance in turn.
struct Searches {
    all: Vec<Search>,
    /// The search that each one was joined to, or itself.
    parent: Vec<usize>,
    turns: VecDeque<usize>,
    /// Number of searches that have not ended, and of those without an outlet.
    running: usize,
    undecided: usize,
}

impl Searches {
    fn of(all: Vec<Search>) -> Self {
        let count = all.len();
        Self { all, parent: (0..count).collect(), turns: (0..count).collect(), running: count, undecided: count }
    }

    /// Joins two searches that have met, the smaller one to the larger one, and returns that.
    fn join(&mut self, one: usize, other: usize) -> usize {
        let [one, other] = [one, other].map(|search| root(&mut self.parent, search));
        if one == other {
            return one;
        }
        let is_smaller = self.all[other].found.len() < self.all[one].found.len();
        let (into, from) = if is_smaller { (one, other) } else { (other, one) };
        let Search { found, next, has_outlet } = std::mem::take(&mut self.all[from]);
        let joined = &mut self.all[into];
        self.running -= 1;
        self.undecided -= usize::from(!(has_outlet && joined.has_outlet));
        joined.found.extend(found);
        joined.next.extend(next);
        joined.has_outlet |= has_outlet;
        self.parent[from] = into;
        into
    }

    /// A search has an outlet.
    fn decide(&mut self, search: usize) {
        if !std::mem::replace(&mut self.all[search].has_outlet, true) {
            self.undecided -= 1;
        }
    }

    /// A search has found all that it can: what it has found, if there is no outlet.
    fn end(&mut self, search: usize) -> Option<Vec<usize>> {
        self.running -= 1;
        (!self.all[search].has_outlet).then(|| {
            self.undecided -= 1;
            std::mem::take(&mut self.all[search].found)
        })
    }
}

impl Reachable {
    /// Connectivity to the nodes marked as outlets, whatever phase they hold, through elements marked as defending and all rings.
    pub(super) fn new(graph: Graph, defends: &[bool], is_outlet: Vec<bool>) -> Self {
        let count = graph.nodes();
        let mut all = Self {
            is_open: is_outlet.clone(),
            is_lost: (0..count).map(|node| defends.get(node).is_some_and(|defends| !defends)).collect(),
            is_outlet,
            seen: vec![(0, 0); count],
            cuts: 0,
        };
        let mut open: Vec<usize> = (0..count).filter(|&node| all.is_outlet[node]).collect();
        while let Some(node) = open.pop() {
            for other in graph.neighbors(node) {
                let leads_out = !all.is_lost[node] || graph.is_element(other);
                if leads_out && !all.is_lost[other] && !std::mem::replace(&mut all.is_open[other], true) {
                    open.push(other);
                }
            }
        }
        all
    }

    /// Whether a node reaches an outlet, or is one.
    pub(super) fn is_open(&self, node: usize) -> bool {
        self.is_open[node]
    }

    /// Takes elements from the defending phase, and the direct paths between pairs of nodes, which are no longer in the graph. Returns the nodes that this cuts
    /// off. What is lost at a time is given at once \[EvenShiloach1981\].
    pub(super) fn cut(&mut self, graph: Graph, elements: &[usize], paths: &[[usize; 2]]) -> Vec<usize> {
        for &element in elements {
            self.is_lost[element] = true;
            self.is_open[element] = self.is_outlet[element];
        }
        let mut lost: Vec<usize> = Vec::new();
        let beside = elements.iter().flat_map(|&element| graph.neighbors(element));
        let starts: Vec<usize> = beside.chain(paths.iter().flatten().copied()).collect();
        // Where the way out may have been through what is lost, every search has to find one.
        let was_way_out = |&node: &usize| self.is_lost[node] && self.is_outlet[node];
        let is_one_open = !starts.iter().chain(elements).any(was_way_out);
        let mut searches = self.begin(starts);
        let mut is_outlet_found = !is_one_open;
        while searches.undecided > 0 && (searches.running > 1 || is_outlet_found) {
            let Some(turn) = searches.turns.pop_front() else { break };
            if searches.parent[turn] != turn {
                continue;
            }
            let Some(node) = searches.all[turn].next.pop_front() else {
                match searches.end(turn) {
                    Some(found) => lost.extend(found),
                    None => is_outlet_found = true,
                }
                continue;
            };
            let here = self.go_on(graph, &mut searches, turn, node);
            // One that was met has a turn already.
            if here == turn {
                searches.turns.push_back(turn);
            }
        }
        lost.iter().for_each(|&node| self.is_open[node] = false);
        lost
    }

    /// Searches from the open ones among `starts`.
    fn begin(&mut self, starts: Vec<usize>) -> Searches {
        self.cuts += 1;
        let mut all: Vec<Search> = Vec::new();
        for start in starts {
            if self.is_open[start] && !self.is_lost[start] && self.seen[start].0 != self.cuts {
                self.seen[start] = (self.cuts, all.len() as u32);
                all.push(Search { found: vec![start], next: [start].into(), has_outlet: false });
            }
        }
        Searches::of(all)
    }

    /// Goes on from a node of a search to its neighbors; returns the search, or the one to which it was joined.
    fn go_on(&mut self, graph: Graph, searches: &mut Searches, search: usize, node: usize) -> usize {
        let mut here = search;
        let mut is_out = self.is_outlet[node];
        for other in graph.neighbors(node) {
            if self.is_lost[other] {
                is_out |= self.is_outlet[other] && graph.is_element(node);
            } else if self.is_open[other] && self.seen[other].0 != self.cuts {
                self.seen[other] = (self.cuts, here as u32);
                searches.all[here].found.push(other);
                searches.all[here].next.push_back(other);
            } else if self.is_open[other] {
                here = searches.join(here, self.seen[other].1 as usize);
            }
        }
        if is_out {
            searches.decide(here);
        }
        here
    }
}
