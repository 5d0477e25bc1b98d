//! The order of events: by rising curvature, events of equal curvature simultaneously.

use super::event::{Candidate, EventKind};
use super::mesh::Mesh;
use super::progress::Displacement;

/// One event.
#[derive(Debug, Clone, PartialEq)]
pub struct Event {
    /// Type of the event.
    pub kind: EventKind,
    /// The throat through which elements were filled, or which films closed; `None` for a segment within a region.
    pub throat: Option<usize>,
    /// The elements that were filled.
    pub elements: Vec<usize>,
    /// Curvature of the meniscus at the event in 1/m.
    pub curvature: f64,
    /// The applied curvature in 1/m: the largest so far.
    pub applied: f64,
}

impl Displacement {
    /// The next valid event and the elements that it fills; with `only_tied`, `None` if none of the last curvature is left.
    fn next_candidate(&mut self, mesh: &Mesh, only_tied: bool) -> Option<(Candidate, Vec<usize>)> {
        loop {
            if self.tied.is_empty() {
                if only_tied {
                    return None;
                }
                self.tie()?;
            }
            let candidate = self.tied.pop_front()?;
            let Candidate { gate, to, partner, kind, .. } = candidate;
            if kind == EventKind::SnapOff {
                if self.can_close(mesh, gate) {
                    return Some((candidate, Vec::new()));
                }
                continue;
            }
            if self.fronts[gate][to].is_none() {
                continue;
            }
            let Some((front, hand)) = partner else {
                let ahead = (kind != EventKind::Reconnection).then(|| mesh.element(gate, to));
                return Some((candidate, ahead.into_iter().collect()));
            };
            // Another meniscus may have formed in between.
            let neighbor = self.neighbor(mesh, (gate, to), hand).filter(|neighbor| neighbor.front == front);
            let Some(neighbor) = neighbor else { continue };
            let (event, filled) = self.merged_event(mesh, ((gate, to), hand), &neighbor, candidate.curvature);
            if event > candidate.curvature {
                self.queue.push(Candidate { curvature: event, is_joined: true, ..candidate });
                continue;
            }
            return Some((candidate, filled));
        }
    }

    /// Moves the events of the lowest curvature out of the queue.
    fn tie(&mut self) -> Option<()> {
        // Rounding error relative to the curvature, or to that of a half circle in the gate.
        const ROUNDING: f64 = 1e-9;
        if let Some(next) = self.queue.peek().map(|next| next.curvature) {
            let mesh = self.mesh.clone();
            self.part_below(&mesh, next.min(self.conditions.largest_curvature));
        }
        let is_allowed = |next: &&Candidate| next.curvature <= self.conditions.largest_curvature;
        let &Candidate { curvature: lowest, gate, .. } = self.queue.peek().filter(is_allowed)?;
        let (part, slot) = self.mesh.gates[gate].crossings[0];
        let chord = self.mesh.loops[part].crossings[slot].to - self.mesh.loops[part].crossings[slot].from;
        let rounding = ROUNDING * lowest.abs().max(2.0 / chord.norm());
        let highest = (lowest + rounding).min(self.conditions.largest_curvature);
        while self.queue.peek().is_some_and(|next| next.curvature <= highest) {
            self.tied.extend(self.queue.pop());
        }
        Some(())
    }
}

/// Performs the next event and returns it; `None` if no meniscus can move any more.
impl Iterator for Displacement {
    type Item = Event;

    fn next(&mut self) -> Option<Event> {
        let mesh = self.mesh.clone();
        let (candidate, filled) = self.next_candidate(&mesh, false)?;
        let Candidate { kind, curvature, gate, partner, .. } = candidate;
        self.applied = self.applied.max(curvature);
        let met = partner.map_or(gate, |((other, _), _)| other);
        let curvature = self.head_between(&mesh, [gate, met]).local(curvature);
        match kind {
            EventKind::SnapOff => self.close(gate),
            EventKind::Reconnection => self.reopen(gate),
            EventKind::Burst | EventKind::Touch | EventKind::Overlap => self.fill(&mesh, &filled),
        }
        match self.next_candidate(&mesh, true) {
            Some((next, ..)) => self.tied.push_front(next),
            None => self.settle(&mesh),
        }
        let mut elements: Vec<usize> =
            filled.iter().flat_map(|&element| &mesh.elements[element].loops).copied().collect();
        elements.sort_unstable();
        elements.dedup();
        Some(Event { kind, throat: mesh.gates[gate].throat, elements, curvature, applied: self.applied })
    }
}
