//! Menisci in gates: their passages, pending events, and neighbors along the walls.

use super::event::{Candidate, EventKind};
use super::loops::Loop;
use super::mesh::{FrontId, Mesh};
use super::progress::{Displacement, Front};
use super::walls::{Sides, gate_walls};
use crate::graph::WallPiece;
use meniscus_case::network::Events;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::head::Head;
use meniscus_geometry::interface::menisci::{Hand, Passage, Wall, WallPart, overlap};

/// Shift of a wall beside a crossing of a loop so that both meet.
type SeamOf = fn(&Loop, usize) -> Vec2;

/// The next meniscus along a wall.
pub(super) struct Neighbor {
    /// Its gate and the end at which it enters.
    pub(crate) front: FrontId,
    /// Length of wall between both gates in m.
    pub(super) shared: f64,
    /// Shift in m from its frame to that of the meniscus of which it is the neighbor.
    pub(crate) offset: Vec2,
    /// The elements in between.
    pub(crate) passed: Vec<usize>,
}

impl Displacement {
    /// The passage of a meniscus, and the walls ahead, shifted by `offset` in m.
    pub(super) fn passage(&self, mesh: &Mesh, front: FrontId, offset: Vec2) -> (Passage, Vec<Curve>) {
        self.passage_at(&self.conditions.angle, mesh, front, offset)
    }

    /// The same with other contact angles in rad.
    pub(super) fn passage_at(
        &self,
        angles: &[f64],
        mesh: &Mesh,
        (gate, to): FrontId,
        offset: Vec2,
    ) -> (Passage, Vec<Curve>) {
        let walls = gate_walls(mesh, gate, to, &self.centers);
        let angle = |shape: u32| angles.get(shape as usize).copied().unwrap_or(std::f64::consts::FRAC_PI_2);
        let wall = |sides: &Sides| {
            let part = |piece: &WallPiece| WallPart { curve: piece.curve.shifted(offset), angle: angle(piece.shape) };
            let parts = sides.behind.iter().rev().chain(&sides.ahead).map(part).collect();
            Wall { parts, behind: sides.behind.len() }
        };
        let obstacles = walls.ahead.iter().map(|piece| piece.curve.shifted(offset)).collect();
        (Passage::new(wall(&walls.left), wall(&walls.right)), obstacles)
    }

    /// Places a meniscus in a gate, to enter the element at its end `to`, with its pending events.
    pub(super) fn advance_through(&mut self, mesh: &Mesh, gate: usize, to: usize) {
        let (passage, obstacles) = self.passage(mesh, (gate, to), Vec2::zeros());
        let (mut kind, mut own) = self.own_event(&passage, &obstacles);
        // A touch before a measured burst remains a touch.
        let formula = passage.burst().map_or(f64::INFINITY, |meniscus| meniscus.curvature);
        let burst = self.conditions.burst(mesh.gates[gate].throat, formula);
        if kind == EventKind::Burst || burst < own {
            (kind, own) = (EventKind::Burst, burst);
        }
        let curvature = self.head(mesh, gate).applied(own);
        self.queue.push(Candidate { curvature, kind, gate, to, partner: None, is_joined: false });
        if self.conditions.events == Events::All {
            self.meet_neighbors(mesh, (gate, to), &passage, own);
        }
        self.fronts[gate][to] = Some(Box::new(Front { passage, own }));
    }

    /// The hydrostatic head in the middle of a gate.
    pub(super) fn head(&self, mesh: &Mesh, gate: usize) -> Head {
        self.head_between(mesh, [gate; 2])
    }

    /// The same halfway between the middles of two gates, for a meniscus that spans both.
    pub(super) fn head_between(&self, mesh: &Mesh, gates: [usize; 2]) -> Head {
        let [one, other] = gates.map(|gate| mesh.middle(gate));
        self.conditions.head(0.5 * (one + other))
    }

    /// The event of a meniscus by itself, and its curvature in 1/m.
    pub(super) fn own_event(&self, passage: &Passage, obstacles: &[Curve]) -> (EventKind, f64) {
        let burst = passage.burst().map_or(f64::INFINITY, |meniscus| meniscus.curvature);
        if self.conditions.events == Events::All
            && let Some(touch) = passage.touch(obstacles, burst)
        {
            return (EventKind::Touch, touch);
        }
        (EventKind::Burst, burst)
    }

    /// Overlaps of a new meniscus with its neighbors on both walls.
    fn meet_neighbors(&mut self, mesh: &Mesh, (gate, to): FrontId, passage: &Passage, own: f64) {
        for hand in [Hand::Left, Hand::Right] {
            let Some(neighbor) = self.neighbor(mesh, (gate, to), hand) else { continue };
            let (other, end) = neighbor.front;
            let Some(front) = &self.fronts[other][end] else { continue };
            let moved = (neighbor.offset != Vec2::zeros()).then(|| self.passage(mesh, (other, end), neighbor.offset).0);
            let facing = moved.as_ref().unwrap_or(&front.passage);
            let (a, b) = if hand == Hand::Left { (passage, facing) } else { (facing, passage) };
            let [here, there] = [self.head(mesh, gate), self.head(mesh, other)];
            let (head_a, head_b) = if hand == Hand::Left { (here, there) } else { (there, here) };
            let up_to = here.applied(own).min(there.applied(front.own));
            if let Some(curvature) = overlap((a, head_a), (b, head_b), neighbor.shared, up_to) {
                let partner = Some((neighbor.front, hand));
                let kind = EventKind::Overlap;
                self.queue.push(Candidate { curvature, kind, gate, to, partner, is_joined: false });
            }
        }
    }

    /// The next meniscus along a wall of a gate, ahead of the meniscus that enters it, with nothing but the defending phase in between.
    pub(super) fn neighbor(&self, mesh: &Mesh, (gate, to): FrontId, hand: Hand) -> Option<Neighbor> {
        let (mut index, slot) = mesh.gates[gate].crossings[to];
        let next = |index: usize, k: usize| (k + 1) % mesh.loops[index].walls.len();
        let before = |index: usize, k: usize| (k + mesh.loops[index].walls.len() - 1) % mesh.loops[index].walls.len();
        // The wall on the left ahead leads to the next crossing, the one on the right to that before.
        let mut wall = if hand == Hand::Left { next(index, slot) } else { slot };
        let mut found =
            Neighbor { front: (gate, to), shared: 0.0, offset: Vec2::zeros(), passed: vec![mesh.element_of[index]] };
        let (to_crossing, from_crossing): (SeamOf, SeamOf) = if hand == Hand::Left {
            (Loop::wall_before, Loop::wall_after)
        } else {
            (Loop::wall_after, Loop::wall_before)
        };
        found.offset += from_crossing(&mesh.loops[index], slot);
        // A wall has at most as many stretches as there are loops.
        for _ in 0..mesh.loops.len() {
            found.shared += mesh.loops[index].walls[wall].iter().map(|piece| piece.curve.length()).sum::<f64>();
            let crossing = if hand == Hand::Left { wall } else { before(index, wall) };
            let front = mesh.gate_at(index, crossing)?;
            if front == (gate, to) {
                return None;
            }
            found.offset -= to_crossing(&mesh.loops[index], crossing);
            if self.fronts[front.0][front.1].is_some() {
                return Some(Neighbor { front, ..found });
            }
            let (beyond, twin, shift) = mesh.twin(index, crossing)?;
            let element = mesh.element_of[beyond];
            if self.invaded[element] || self.connection.trapped[element] {
                return None;
            }
            found.offset += from_crossing(&mesh.loops[beyond], twin) - shift;
            found.passed.push(element);
            index = beyond;
            wall = if hand == Hand::Left { next(index, twin) } else { twin };
        }
        None
    }
}
