//! The end of a step: particles are moved, shifted and kept out of walls.

use super::given_flow::keep_flow_rates;
use super::intermediate::{Corrected, Predicted, Projected};
use crate::configuration::Configuration;
use crate::fields::Fields;
use crate::neighborhood::Neighborhood;
use crate::parallel::change_each;
use crate::particles::{Phase, relative_speed};
use crate::surface_force::SurfaceForce;
use crate::terms::sharpening::Sharpening;
use crate::terms::shifting;
use crate::view::View;
use meniscus_core::math::Vec2;
use meniscus_core::solver::SolverError;

/// A particle that moves farther than this fraction of h in a step indicates blow-up.
const LARGEST_MOVE: f64 = 0.5;

/// A fluid particle closer to a wall than this fraction of dx is set back to that distance: a rough wall is not perfectly tight.
const CLOSEST_TO_WALL: f64 = 0.05;

/// In a corner a particle is set back from one wall after the other, at most this many times; in a sharp wedge the next step continues.
const SET_BACKS: usize = 4;

/// Fluid and buffer particles at the end of a step.
pub(super) struct Motion {
    /// Position in m.
    pub(super) position: Vec<Vec2>,
    /// Velocity in m/s.
    pub(super) velocity: Vec<Vec2>,
    /// Number of particles set back from a wall.
    pub(super) set_back: u64,
}

impl View<'_, Fields> {
    /// Moves the particles with the new velocity [Huber2013, Eq. 27], and by the density-error shift, if there is any, which corrects density errors without
    /// changing velocities. The paper's mean of old and new velocity would amplify every oscillation not damped by viscosity (docs/numerics/forces.md).
    ///
    /// # Errors
    /// [`SolverError::BlowUp`] if a particle would move too far.
    pub(super) fn moved(&self, predicted: &Predicted, corrected: &Corrected) -> Result<Motion, SolverError> {
        let Projected { density_error_shift, responses, .. } = &corrected.projected;
        let (config, old) = (self.config, &self.state.particles.position);
        let mut velocity = corrected.velocity.clone();
        let (fluids, moving, dt) = (self.state.particles.fluids, self.state.particles.moving(), predicted.dt);
        let mut position = Vec::with_capacity(moving);
        for (a, v) in velocity.iter().enumerate() {
            let by = dt * v;
            if !(by.norm() <= LARGEST_MOVE * self.config.method.kernel.h) {
                let phase = if self.state.particles.phase[a] == Phase::Wetting { "wetting" } else { "non-wetting" };
                return Err(SolverError::BlowUp {
                    what: format!("a {phase} particle reached {:.3e} m/s", v.norm()),
                    time: self.state.time,
                    step: self.state.steps,
                    position: self.state.particles.position[a],
                });
            }
            position.push(self.config.domain.wrapped(self.state.particles.position[a] + by));
        }
        self.shift(dt, &mut position[..fluids], &mut velocity);
        for (x, by) in position.iter_mut().zip(density_error_shift) {
            *x = self.config.domain.wrapped(*x + by);
        }
        keep_flow_rates(config, responses, dt, &old[..fluids], &mut position[..fluids]);
        let wall_distance = &self.fields.bulk.wall_distance;
        let from = &old[..fluids];
        let set_back = set_back(config, wall_distance, from, &mut position[..fluids], &mut velocity[..fluids]);
        Ok(Motion { position, velocity, set_back })
    }

    /// Shifts clustered particles apart, and isolated ones back across the interface, with the velocity corrected for the displacement.
    fn shift(&self, dt: f64, position: &mut [Vec2], velocity: &mut [Vec2]) {
        let (fluids, m, f) = (self.state.particles.fluids, &self.config.method, &self.fields.bulk);
        let diffusion = m.numerics.shifting * m.kernel.h * relative_speed(&velocity[..fluids]) * dt;
        let mut by = vec![Vec2::zeros(); fluids];
        if diffusion > 0.0 {
            by = shifting::shift(&self.shifting_vector(), diffusion, m.kernel.h);
        }
        if let SurfaceForce::Jump { jump, wall_hysteresis, .. } = &self.fields.interface.force {
            let sharpening = Sharpening {
                side: &jump.side,
                normal: &self.fields.interface.normal,
                fluid_volume: &f.fluid_volume,
                wall_distance: &f.wall_distance,
                wall_normal: &f.wall_normal,
                weight: (m.wetting_fluid.density - m.other_fluid.density) / m.mean_density() * m.gravity / m.profile(),
                wall_hysteresis,
            };
            sharpening.displace(&self.neighborhood.pairs, m.kernel.h, m.capillary_speed(), dt, &mut by);
        } else if diffusion == 0.0 {
            return;
        }
        if !self.config.open.sides.is_empty() {
            change_each(&mut by, |a, by| *by *= self.config.weight_of_corrections(position[a]));
        }
        let mut all = velocity.to_vec();
        all.extend_from_slice(&self.state.particles.velocity[self.state.particles.moving()..]);
        let all = self.neighborhood.images.velocity_field(all);
        let change = shifting::carried_velocity(&self.neighborhood.pairs, &f.volume, &f.density, &all, &by);
        for a in 0..fluids {
            position[a] = self.config.domain.wrapped(position[a] + by[a]);
            velocity[a] += change[a];
        }
    }

    /// The vector in 1/m down which particles are shifted: ∇C of the fluid particles, near the interface its tangential part, plus the
    /// anti-clustering force without its mean.
    fn shifting_vector(&self) -> Vec<Vec2> {
        let (m, f, interface) = (&self.config.method, &self.fields.bulk, &self.fields.interface);
        let (Neighborhood { pairs, images }, fluids) = (self.neighborhood, self.state.particles.fluids);
        let mut shifting_vector = shifting::concentration_gradient(pairs, &f.volume, fluids);
        if interface.force.jump().is_some() {
            shifting::keep_along(&interface.normal, m.kernel.h, &mut shifting_vector);
        }
        if m.numerics.anti_clustering > 0.0 {
            let (strength, w) = (m.numerics.anti_clustering, m.kernel.w(m.spacing));
            let mut push = shifting::anti_clustering(pairs, &f.volume, strength, w, fluids);
            shifting::take_out_mean(pairs, images, &f.fluid_volume, &mut push);
            shifting_vector.iter_mut().zip(push).for_each(|(shifting_vector, push)| *shifting_vector += push);
        }
        shifting_vector
    }
}

/// Sets back fluid particles that came too close to walls or sides, and counts them; `wall_distance` (m) is that before the step.
fn set_back(
    config: &Configuration,
    wall_distance: &[f64],
    from: &[Vec2],
    position: &mut [Vec2],
    velocity: &mut [Vec2],
) -> u64 {
    let mut count = 0;
    let closest = CLOSEST_TO_WALL * config.method.spacing;
    let reach = closest + LARGEST_MOVE * config.method.kernel.h;
    for a in 0..position.len() {
        if wall_distance[a] < reach {
            for pass in 0..SET_BACKS {
                let (distance, normal) = (config.wall)(position[a]);
                if distance >= closest {
                    break;
                }
                position[a] = config.domain.wrapped(position[a] + (closest - distance) * normal);
                velocity[a] -= velocity[a].dot(&normal).min(0.0) * normal;
                count += u64::from(pass == 0);
            }
        }
    }
    // No fluid leaves through a side with a given velocity: a particle that would is set back, with that velocity along the normal.
    for side in config.open.sides.iter().filter(|side| side.given_pressure().is_none()) {
        for ((x, v), from) in position.iter_mut().zip(velocity.iter_mut()).zip(from) {
            // A particle that has just entered is nearer, and stays until it has moved on.
            let nearest = side.overshoot(*from).max(-closest);
            if side.overshoot(*x) > nearest {
                *x = side.projected(*x, nearest);
                let given = side.given_velocity(*x).unwrap_or_default();
                v[side.axis()] = given[side.axis()];
                count += 1;
            }
        }
    }
    for mirror in &config.domain.mirrors {
        let inwards = (config.domain.bounds.center()[mirror.axis] - mirror.at).signum();
        for x in position.iter_mut() {
            let depth = inwards * (x[mirror.axis] - mirror.at);
            if depth < closest {
                x[mirror.axis] = mirror.at + inwards * closest;
                count += 1;
            }
        }
    }
    count
}
