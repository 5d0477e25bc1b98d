//! The particles as a structure of arrays: fluid particles first, then the buffers of open sides, then wall particles, and images last.
//!
//! Images behind mirror sides are recreated in each step and copy their source.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::parallel::largest;
use meniscus_core::math::Vec2;

/// Phase of a particle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Phase {
    /// The phase through which contact angles are measured, color 1.
    Wetting,
    /// The other fluid, color 0.
    NonWetting,
    /// A wall.
    Solid,
}

impl Phase {
    /// The number in the output: 0 wetting, 1 non-wetting, 2 solid.
    pub(crate) fn number(self) -> i64 {
        self as i64
    }

    /// Color c: 1 in the wetting phase, else 0.
    pub(crate) fn color(self) -> f64 {
        if self == Self::Wetting { 1.0 } else { 0.0 }
    }
}

/// All particles that carry state. Arrays are of equal length: fluid, then the buffers of open sides, then walls.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Particles {
    /// Number of fluid particles.
    pub fluids: usize,
    /// Number of particles in the buffers of open sides.
    pub open: usize,
    /// Number of wall particles.
    pub walls: usize,
    /// Identifier of the particle, constant in time.
    pub id: Vec<u32>,
    /// Phase.
    pub phase: Vec<Phase>,
    /// Position in m.
    pub position: Vec<Vec2>,
    /// Velocity in m/s; on walls that of the wall.
    pub velocity: Vec<Vec2>,
    /// Pressure in Pa.
    pub pressure: Vec<f64>,
    /// Change of the pressure in Pa over the last step, from which the next solve extrapolates its initial guess.
    pub pressure_change: Vec<f64>,
    /// The pressure in m that responds to a unit gradient through each periodic side with a given flow: the initial guess of its next solve.
    pub responses: Vec<Vec<f64>>,
    /// Connected component of the pore space: each has its own pressure constant.
    pub part: Vec<u32>,
}

impl Particles {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Number of moving particles: fluid and buffers. This is the index of the first wall particle.
    pub fn moving(&self) -> usize {
        self.fluids + self.open
    }

    /// The buffers of open sides.
    pub(crate) fn buffer(&self) -> Range<usize> {
        self.fluids..self.moving()
    }

    /// The largest speed of the fluid in m/s.
    pub fn fluid_speed(&self) -> f64 {
        largest(self.fluids, |a| self.velocity[a].norm()).map_or(0.0, |l| l.1)
    }

    /// Adds a particle at rest; fluid must come before walls.
    pub(crate) fn push(&mut self, phase: Phase, position: Vec2) {
        debug_assert!(phase == Phase::Solid || self.fluids == self.len(), "fluid comes before walls");
        if phase == Phase::Solid {
            self.walls += 1;
        } else {
            self.fluids += 1;
        }
        self.append(phase, position);
    }

    /// Appends a particle at rest; [`Particles::arrange`] must then sort it into fluid, buffers or walls.
    pub(crate) fn append(&mut self, phase: Phase, position: Vec2) {
        self.id.push(u32::try_from(self.len()).unwrap_or(u32::MAX));
        self.phase.push(phase);
        self.position.push(position);
        self.velocity.push(Vec2::zeros());
        self.pressure.push(0.0);
        self.pressure_change.push(0.0);
        self.responses.iter_mut().for_each(|response| response.push(0.0));
        self.part.push(0);
    }

    /// Appends a copy of particle `a` with another phase, position (m) and identifier; see [`Particles::append`].
    pub(crate) fn append_like(&mut self, a: usize, phase: Phase, position: Vec2, id: u32) {
        self.id.push(id);
        self.phase.push(phase);
        self.position.push(position);
        self.velocity.push(self.velocity[a]);
        self.pressure.push(self.pressure[a]);
        self.pressure_change.push(self.pressure_change[a]);
        self.responses.iter_mut().for_each(|response| response.push(response[a]));
        self.part.push(self.part[a]);
    }

    /// Keeps the particles of `order`, in that order: `fluids` fluid particles, `open` in buffers, and walls.
    pub(crate) fn arrange(&mut self, order: &[usize], fluids: usize, open: usize) {
        self.reorder(order);
        (self.fluids, self.open, self.walls) = (fluids, open, order.len() - fluids - open);
    }

    /// Reorders the particles: the new particle i is the old `order[i]`. Fluid must stay before walls.
    pub(crate) fn reorder(&mut self, order: &[usize]) {
        fn pick<T: Copy>(values: &mut Vec<T>, order: &[usize]) {
            *values = order.iter().map(|&i| values[i]).collect();
        }
        pick(&mut self.id, order);
        pick(&mut self.phase, order);
        pick(&mut self.position, order);
        pick(&mut self.velocity, order);
        pick(&mut self.pressure, order);
        pick(&mut self.pressure_change, order);
        self.responses.iter_mut().for_each(|response| pick(response, order));
        pick(&mut self.part, order);
    }
}

/// The largest speed in m/s relative to the mean velocity, which is Galilean invariant.
pub(crate) fn relative_speed(velocity: &[Vec2]) -> f64 {
    let mean = velocity.iter().sum::<Vec2>() / velocity.len() as f64;
    largest(velocity.len(), |a| (velocity[a] - mean).norm()).map_or(0.0, |l| l.1)
}
