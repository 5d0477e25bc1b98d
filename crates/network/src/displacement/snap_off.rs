//! Snap-off: when the corner films of a throat meet, the wetting phase fills the throat.
//!
//! A throat has no volume here. It is closed to the non-wetting phase, with menisci on both sides, from which the wetting phase enters the
//! adjacent elements by the usual events. In the next drainage it opens again when a meniscus passes it at its entry pressure.
//!
//! Left out: contact between the menisci on both sides of a closed throat.

use super::conditions::CornerFilms;
use super::event::{Candidate, EventKind};
use super::mesh::Mesh;
use super::progress::{Displacement, Front};
use super::trapping::Held;
use meniscus_core::math::Vec2;

impl Displacement {
    /// Queues snap-off at the curvature in 1/m at which films meet, for all throats that are gates.
    pub(super) fn queue_snap_off(&mut self, mesh: &Mesh) {
        let CornerFilms::Join { meeting } = &self.conditions.films else { return };
        for (gate, throat) in mesh.gates.iter().enumerate().filter_map(|(gate, it)| Some((gate, it.throat?))) {
            let curvature = meeting[throat];
            if curvature.is_finite() && self.can_close(mesh, gate) {
                let kind = EventKind::SnapOff;
                self.queue.push(Candidate { curvature, kind, gate, to: 0, partner: None, is_joined: false });
            }
        }
    }

    /// Whether a gate can snap off: defending non-wetting phase on both sides, connected to an outlet.
    pub(super) fn can_close(&self, mesh: &Mesh, gate: usize) -> bool {
        let is_open = |end| {
            let element = mesh.element(gate, end);
            !self.invaded[element] && !self.connection.trapped[element]
        };
        !self.closed[gate] && is_open(0) && is_open(1)
    }

    /// Removes from closed gates those without non-wetting phase on both sides.
    pub(super) fn closed_within(mesh: &Mesh, closed: &mut [bool], invaded: &[bool], films: &CornerFilms) {
        let invades = *films == CornerFilms::Drain;
        for (gate, closed) in closed.iter_mut().enumerate() {
            *closed &= [0, 1].iter().all(|&end| invaded[mesh.element(gate, end)] == invades);
        }
    }

    /// Closes a gate in which films meet.
    pub(super) fn close(&mut self, gate: usize) {
        self.closed[gate] = true;
        self.closing.push(gate);
    }

    /// Opens a closed gate that the invading phase passes.
    pub(super) fn reopen(&mut self, gate: usize) {
        self.closed[gate] = false;
        self.fronts[gate] = [None, None];
        self.opened.push(gate);
    }

    /// Places menisci on both sides of a closed gate.
    pub(super) fn advance_from_closed(&mut self, mesh: &Mesh, gate: usize) {
        for to in 0..2 {
            let target = mesh.element(gate, to);
            if !self.invaded[target] && !self.connection.trapped[target] && self.fronts[gate][to].is_none() {
                self.advance_through(mesh, gate, to);
            }
        }
    }

    /// Places a meniscus in a closed gate with its own phase on the other side, to reconnect both.
    pub(super) fn queue_reconnection(&mut self, mesh: &Mesh, gate: usize, to: usize) {
        let (passage, _) = self.passage(mesh, (gate, to), Vec2::zeros());
        let formula = passage.burst().map_or(f64::INFINITY, |meniscus| meniscus.curvature);
        let own = self.conditions.burst(mesh.gates[gate].throat, formula);
        let kind = EventKind::Reconnection;
        self.queue.push(Candidate { curvature: own, kind, gate, to, partner: None, is_joined: false });
        self.fronts[gate][to] = Some(Front { passage, own });
    }

    /// Trapping after gates were closed.
    pub(super) fn lose_through(&mut self, mesh: &Mesh, gates: &[usize]) {
        for &gate in gates {
            let held = Held { mesh, invaded: &self.invaded, closed: &self.closed };
            let between = [0, 1].map(|end| mesh.element(gate, end));
            let lost = self.connection.close(held, between);
            self.leave(mesh, lost);
        }
    }

    /// The throats of the network that films have closed.
    pub(crate) fn closed_throats(&self) -> Vec<usize> {
        let gates = self.mesh.gates.iter().zip(&self.closed).filter(|(_, closed)| **closed);
        gates.filter_map(|(gate, _)| gate.throat).collect()
    }
}
