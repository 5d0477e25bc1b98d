//! Fields of the wall particles, which are at rest: computed once.

use crate::configuration::Configuration;
use crate::images::Images;
use crate::particles::Particles;
use meniscus_core::math::Vec2;

/// Cosine between the wall normals of two wall particles below which they belong to opposite sides of a solid.
const OPPOSITE: f64 = -0.5;

/// Fields over wall particles.
#[derive(Debug, Clone, Default)]
pub struct WallFields {
    /// Normal of the wall nearest to each, into the fluid.
    facing: Vec<Vec2>,
    /// Curvature in 1/m of the wall nearest to each, positive where the solid is convex; 0 at edges.
    pub(crate) curvature: Vec<f64>,
}

impl WallFields {
    /// Normal and curvature of the wall nearest to each wall particle.
    pub(crate) fn of(config: &Configuration, particles: &Particles) -> Self {
        let walls = &particles.position[particles.moving()..];
        let facing = walls.iter().map(|&x| (config.wall)(x).1).collect();
        Self { facing, curvature: walls.iter().map(|&x| config.curvature_of_wall(x)).collect() }
    }

    /// Whether the pressures of two particles or images are coupled: all except wall particles on opposite sides of a thin solid, through which
    /// the pressure would leak from one side to the other. `moving` particles precede the walls.
    pub(crate) fn joined(&self, moving: usize, images: &Images) -> impl Fn(usize, usize) -> bool + use<> {
        let facing = images.reflected_field([&vec![Vec2::zeros(); moving], &self.facing[..]].concat());
        move |a, b| facing[a].dot(&facing[b]) > OPPOSITE
    }
}
