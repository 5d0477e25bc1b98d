//! Initial positions of fluid and wall particles.

use crate::particles::{Particles, Phase};
use meniscus_core::math::Vec2;

/// Initial positions of the particles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Positions {
    /// Positions of fluid particles in m.
    pub fluid: Vec<Vec2>,
    /// Positions of wall particles in m.
    pub walls: Vec<Vec2>,
    /// Depth of each wall particle in m.
    pub depth: Vec<f64>,
}

impl Positions {
    pub(super) fn push_wall(&mut self, x: Vec2, depth: f64) {
        self.walls.push(x);
        self.depth.push(depth);
    }

    /// The particles at these positions; `phase` gives the fluid at a point.
    pub(crate) fn particles(&self, phase: impl Fn(Vec2) -> Phase) -> Particles {
        let mut particles = Particles::default();
        self.fluid.iter().for_each(|&x| particles.push(phase(x), x));
        self.walls.iter().for_each(|&x| particles.push(Phase::Solid, x));
        particles
    }
}
