//! Snap-off: when the corner films of a throat meet, the wetting phase fills the throat.
//!
//! A throat has no volume here. It is closed to the non-wetting phase, with menisci on both sides, from which the wetting phase enters the
//! adjacent elements by the usual events. In the next drainage it opens again when a meniscus passes it at its entry pressure.
//!
//! Left out: contact between the menisci on both sides of a closed throat.

use std::sync::Arc;

use super::conditions::CornerFilms;
use super::event::{Candidate, EventKind};
use super::mesh::Mesh;
use super::progress::{Displacement, Front};
use super::rings::Rings;
use meniscus_core::math::Vec2;

impl Displacement {
    /// Queues snap-off at the curvature in 1/m at which films meet, for all throats that are gates.
    pub(super) fn queue_snap_off(&mut self, mesh: &Mesh) {
        if self.rings.is_some() {
            return self.queue_snap_off_of_fed(mesh);
        }
        (0..mesh.gates.len()).for_each(|gate| self.queue_closing(mesh, gate));
    }

    /// The same for throats at rings that have just been connected to the inlet.
    pub(super) fn queue_snap_off_of_fed(&mut self, mesh: &Mesh) {
        let fed = std::mem::take(&mut self.connection.newly_fed);
        let Some(rings) = self.rings.clone() else { return };
        fed.iter().flat_map(|&ring| &rings.gates[ring]).for_each(|&gate| self.queue_closing(mesh, gate));
    }

    fn queue_closing(&mut self, mesh: &Mesh, gate: usize) {
        let (CornerFilms::Join(films), Some(throat)) = (&self.conditions.films, mesh.gates[gate].throat) else {
            return;
        };
        let curvature = films.meeting[throat];
        if curvature.is_finite() && self.can_close(mesh, gate) {
            let kind = EventKind::SnapOff;
            self.queue.push(Candidate { curvature, kind, gate, to: 0, partner: None, is_joined: false });
        }
    }

    /// The rings of films that are not all joined.
    pub(super) fn rings_of(mesh: &Mesh, films: &CornerFilms) -> Option<Arc<Rings>> {
        let (CornerFilms::Drain(paths) | CornerFilms::Join(paths)) = films else { return None };
        paths.rings.as_ref().map(|has_films| Arc::new(Rings::of(mesh, has_films)))
    }

    /// By gate, whether it joins the films on both sides of it: closed, or, where the wetting phase drains, with films that meet at the curvature `applied` in
    /// 1/m. Of the latter the curvature at which they part, the lowest last.
    pub(super) fn bridges(
        mesh: &Mesh,
        rings: Option<&Rings>,
        films: &CornerFilms,
        (invaded, closed, applied): (&[bool], &[bool], f64),
    ) -> (Vec<bool>, Vec<(f64, usize)>) {
        let Some(rings) = rings else { return Default::default() };
        let joins = |gate: usize| rings.joined_by(gate).is_some();
        let mut partings: Vec<(f64, usize)> = match films {
            CornerFilms::Drain(paths) => (mesh.gates.iter().enumerate())
                .filter_map(|(gate, it)| Some((paths.meeting[it.throat?], gate)))
                .filter(|&(curvature, gate)| curvature.is_finite() && joins(gate))
                .collect(),
            _ => Vec::new(),
        };
        partings.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.cmp(&a.1)));
        let mut bridged: Vec<bool> = (0..mesh.gates.len()).map(|gate| closed[gate] && joins(gate)).collect();
        for &(curvature, gate) in &partings {
            bridged[gate] |= applied <= curvature && [0, 1].iter().all(|&end| invaded[mesh.element(gate, end)]);
        }
        (bridged, partings)
    }

    /// Updates the bridges of the gates of an element that has just been filled.
    pub(super) fn bridge_beside(&mut self, mesh: &Mesh, element: usize) {
        let Some(rings) = self.rings.clone() else { return };
        for &(gate, end) in &mesh.elements[element].gates {
            let meets = match (&self.conditions.films, mesh.gates[gate].throat) {
                (CornerFilms::Drain(paths), Some(throat)) => self.applied <= paths.meeting[throat],
                _ => false,
            };
            let is_between = self.invaded[mesh.element(gate, 1 - end)];
            self.bridged[gate] = meets && is_between && rings.joined_by(gate).is_some();
        }
    }

    /// Films part in the throats in which they meet at lower curvatures in 1/m only; what this cuts off is trapped there.
    pub(super) fn part_below(&mut self, mesh: &Mesh, curvature: f64) {
        while let Some((parting, gate)) = self.partings.pop_if(|(parting, _)| *parting < curvature) {
            if self.bridged[gate] && !self.closed[gate] {
                self.applied = self.applied.max(parting);
                self.part(mesh, gate);
            }
        }
    }

    /// Parts the films on both sides of a gate.
    pub(super) fn part(&mut self, mesh: &Mesh, gate: usize) {
        let Some(rings) = self.rings.as_ref().and_then(|rings| rings.joined_by(gate)) else { return };
        if std::mem::replace(&mut self.bridged[gate], false) {
            let (held, connection) = self.held(mesh);
            let lost = connection.part(held, rings);
            self.leave(mesh, lost);
        }
    }

    /// Whether the films at a gate follow the pressure, so that they can meet.
    fn is_fed_at(&self, mesh: &Mesh, gate: usize) -> bool {
        let Some(rings) = &self.rings else { return true };
        let mut at = rings.of_gate[gate].into_iter().flatten().peekable();
        at.peek().is_some() && at.all(|ring| self.connection.is_fed(mesh.elements.len(), ring as usize))
    }

    /// Whether a gate can snap off: defending non-wetting phase on both sides, connected to an outlet.
    pub(super) fn can_close(&self, mesh: &Mesh, gate: usize) -> bool {
        let is_open = |end| {
            let element = mesh.element(gate, end);
            !self.invaded[element] && !self.connection.trapped[element]
        };
        !self.closed[gate] && is_open(0) && is_open(1) && self.is_fed_at(mesh, gate)
    }

    /// Removes from closed gates those without non-wetting phase on both sides.
    pub(super) fn closed_within(mesh: &Mesh, closed: &mut [bool], invaded: &[bool], films: &CornerFilms) {
        let invades = matches!(films, CornerFilms::Drain(_));
        for (gate, closed) in closed.iter_mut().enumerate() {
            *closed &= [0, 1].iter().all(|&end| invaded[mesh.element(gate, end)] == invades);
        }
    }

    /// Closes a gate in which films meet.
    pub(super) fn close(&mut self, gate: usize) {
        self.closed[gate] = true;
        if let Some(rings) = &self.rings {
            self.bridged[gate] = rings.joined_by(gate).is_some();
        }
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
        let curvature = self.head(mesh, gate).applied(own);
        self.queue.push(Candidate { curvature, kind, gate, to, partner: None, is_joined: false });
        self.fronts[gate][to] = Some(Box::new(Front { passage, own }));
    }

    /// The throats of the network that films have closed.
    pub(crate) fn closed_throats(&self) -> Vec<usize> {
        let gates = self.mesh.gates.iter().zip(&self.closed).filter(|(_, closed)| **closed);
        gates.filter_map(|(gate, _)| gate.throat).collect()
    }
}
