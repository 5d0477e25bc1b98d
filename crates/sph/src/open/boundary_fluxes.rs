//! Fluxes through the sides as particle counts: the mass of a particle is constant, so counting is exact. At sides with a given velocity also
//! from the displacements of the rows in their buffers, since counts change by whole layers.

use serde::{Deserialize, Serialize};

use crate::particles::Phase;

/// Counts of particles by side (left, right, bottom, top) and phase (wetting, non-wetting).
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundaryFluxes {
    /// Particles that came in.
    pub inflow: [[u64; 2]; 4],
    /// Particles that left.
    pub outflow: [[u64; 2]; 4],
    /// Area in m² that came in through each side with a given velocity, from the displacements of the particles in its buffer.
    pub passed: [f64; 4],
    /// Identifier of the next particle.
    pub next_id: u32,
    /// Fluid particles at time zero, by phase.
    pub initial: [u64; 2],
}

fn index(phase: Phase) -> usize {
    usize::from(phase != Phase::Wetting)
}

impl BoundaryFluxes {
    /// The counts at time zero.
    pub(crate) fn new(phases: &[Phase], next_id: u32) -> Self {
        Self { next_id, initial: Self::count(phases), ..Self::default() }
    }

    /// Number of particles of each phase.
    pub fn count(phases: &[Phase]) -> [u64; 2] {
        let mut counts = [0; 2];
        phases.iter().for_each(|&phase| counts[index(phase)] += 1);
        counts
    }

    /// Counts a particle that came in through `side`.
    pub(crate) fn count_inflow(&mut self, side: usize, phase: Phase) {
        self.inflow[side][index(phase)] += 1;
    }

    /// Counts a particle that left through `side`.
    pub(crate) fn count_outflow(&mut self, side: usize, phase: Phase) {
        self.outflow[side][index(phase)] += 1;
    }

    /// Numbers of particles of each phase that came in and that left, over all sides.
    pub fn totals(&self) -> ([u64; 2], [u64; 2]) {
        let sum = |counts: &[[u64; 2]; 4]| [0, 1].map(|phase| counts.iter().map(|side| side[phase]).sum());
        (sum(&self.inflow), sum(&self.outflow))
    }

    /// The identifier of a new particle.
    pub(crate) fn new_id(&mut self) -> u32 {
        let id = self.next_id;
        self.next_id = self.next_id.wrapping_add(1);
        id
    }
}
