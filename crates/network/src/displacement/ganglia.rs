//! Trapped ganglia: the pressure that each keeps, and whether its own head would move it.

use super::mesh::{FrontId, Mesh};
use super::progress::Displacement;
use meniscus_core::math::Vec2;

/// A connected part of the trapped phase.
struct Ganglion {
    elements: Vec<usize>,
    /// The gates to the invading phase, each with its end in the ganglion.
    gates: Vec<FrontId>,
}

impl Displacement {
    fn ganglia(&self, mesh: &Mesh) -> Vec<Ganglion> {
        let mut found = Vec::new();
        let mut is_visited = vec![false; mesh.elements.len()];
        for first in (0..mesh.elements.len()).filter(|&element| self.connection.trapped[element]) {
            if std::mem::replace(&mut is_visited[first], true) {
                continue;
            }
            let (mut ganglion, mut next) = (Ganglion { elements: vec![first], gates: Vec::new() }, 0);
            while let Some(&element) = ganglion.elements.get(next) {
                next += 1;
                for &(gate, to) in &mesh.elements[element].gates {
                    let beyond = mesh.element(gate, 1 - to);
                    if self.invaded[beyond] {
                        ganglion.gates.push((gate, to));
                    } else if self.connection.trapped[beyond] && !std::mem::replace(&mut is_visited[beyond], true) {
                        ganglion.elements.push(beyond);
                    }
                }
            }
            found.push(ganglion);
        }
        found
    }

    /// The lowest applied curvature in 1/m at which the invading phase would advance into a ganglion.
    fn entry_of(&self, mesh: &Mesh, ganglion: &Ganglion) -> f64 {
        let entry = |&(gate, to): &FrontId| {
            let (passage, obstacles) = self.passage(mesh, (gate, to), Vec2::zeros());
            self.head(mesh, gate).applied(self.own_event(&passage, &obstacles).1)
        };
        ganglion.gates.iter().map(entry).fold(f64::INFINITY, f64::min)
    }

    /// For each element of the mesh the applied curvature in 1/m of the menisci around its trapped ganglion: the one at which it was cut off, or the
    /// lowest at which one of them would advance, since its area is constant; NaN if not trapped.
    pub(super) fn trapped_curvatures(&self) -> Vec<f64> {
        let mesh = &self.mesh;
        let mut found = vec![f64::NAN; mesh.elements.len()];
        for ganglion in self.ganglia(mesh) {
            let held = ganglion.elements.iter().map(|&element| self.held[element]);
            let curvature = held.fold(self.entry_of(mesh, &ganglion), f64::min);
            ganglion.elements.into_iter().for_each(|element| found[element] = curvature);
        }
        found
    }

    /// Whether each element is part of a trapped ganglion that its own head would move: at no pressure do all menisci around it hold, neither against the
    /// invading phase nor against its own, whose contact angles are `returning`, in rad through the invading phase.
    pub(crate) fn movable(&self, returning: &[f64]) -> Vec<bool> {
        let mesh = &self.mesh;
        let mut found = vec![false; mesh.elements.len()];
        for ganglion in self.ganglia(mesh) {
            let exit = |&(gate, to): &FrontId| {
                let (passage, obstacles) = self.passage_at(returning, mesh, (gate, 1 - to), Vec2::zeros());
                self.head(mesh, gate).applied(-self.own_event(&passage, &obstacles).1)
            };
            let highest = ganglion.gates.iter().map(exit).fold(f64::NEG_INFINITY, f64::max);
            let moves = highest > self.entry_of(mesh, &ganglion);
            ganglion.elements.into_iter().for_each(|element| found[element] = moves);
        }
        mesh.element_of.iter().map(|&element| found[element]).collect()
    }
}
