//! Fields of the fluids that do not depend on the interface.

use crate::boundary::shepard;
use crate::configuration::Configuration;
use crate::images::Field;
use crate::neighborhood::Neighborhood;
use crate::parallel::values;
use crate::terms::density;
use crate::view::View;
use meniscus_core::math::Vec2;

/// Volumes and densities ([`density::volume`]), viscosities and wall distances.
#[derive(Debug, Clone, Default)]
pub struct BulkFields {
    /// Volume V_a in m²; on walls V_0 of the lattice.
    pub volume: Field<f64>,
    /// V_a on fluid, 0 on walls.
    pub fluid_volume: Field<f64>,
    /// ρ_a in kg/m³; on walls that of the fluid nearby. Between floor and lid multiplied by the profile factor, as it enters inertia.
    pub density: Field<f64>,
    /// Dynamic viscosity in Pa s, 0 on walls. Between floor and lid multiplied by the profile factor, as it enters the in-plane stress.
    pub viscosity: Field<f64>,
    /// Distance to the wall in m of fluid and buffer particles with a wall in reach, else infinite.
    pub wall_distance: Vec<f64>,
    /// Wall normal into the fluid, of the same particles; zero far away.
    pub wall_normal: Vec<Vec2>,
}

impl BulkFields {
    /// The fields at the present positions.
    pub(crate) fn of(flow: &View<()>) -> Self {
        let (Configuration { method, wall, .. }, neighborhood) = (flow.config, flow.neighborhood);
        let (Neighborhood { pairs, images }, particles) = (neighborhood, &flow.state.particles);
        let (n, fluids, moving) = (particles.len(), particles.fluids, particles.moving());
        // Buffer particles lack neighbors beyond the far end: they have the volume of the lattice.
        let mut volume = density::volume(pairs, fluids);
        volume.resize(n, method.volume);
        let fluid_volume = images.field(volume[..moving].to_vec());

        let profile = method.profile();
        let mass = |a: usize| profile * (method.fluid(particles.phase[a]).density * method.volume);
        let density =
            (0..n).map(|a| if a < moving { mass(a) / volume[a] } else { profile * method.mean_density() }).collect();
        let density = shepard::into_walls(neighborhood, &fluid_volume, moving, density);
        let viscosity =
            particles.phase[..moving].iter().map(|&phase| profile * method.fluid(phase).viscosity).collect();

        let nearest = values(moving, |a| {
            let has_wall = pairs.of(a).any(|ab| images.source(ab.b) >= moving);
            if has_wall { wall(particles.position[a]) } else { (f64::INFINITY, Vec2::zeros()) }
        });
        let (wall_distance, wall_normal) = nearest.into_iter().unzip();
        let (volume, viscosity) = (images.field(volume), images.field(viscosity));
        Self { volume, fluid_volume, density, viscosity, wall_distance, wall_normal }
    }
}
