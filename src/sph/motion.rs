//! The end of a step: particles move, keep their order and stay out of walls.

use crate::math::Vec2;
use crate::solver::{SolverError, StepInfo};
use crate::sph::open::Moved;
use crate::sph::pairs::largest;
use crate::sph::particles::Phase;
use crate::sph::projection::{Flow, Predicted, Response};
use crate::sph::terms::sharpening::Sharpening;
use crate::sph::terms::shifting;

/// A particle that moves farther than this share of h in a step has run away.
const LARGEST_MOVE: f64 = 0.5;

/// A fluid particle nearer to a wall than this share of dx is set back to it: the pressure of a rough wall can leak.
const CLOSEST_TO_WALL: f64 = 0.05;

/// In a corner a particle is set back from one wall after the other, so many times; in a sharp wedge the next step does the rest.
const SET_BACKS: usize = 4;

/// The largest speed in m/s relative to the mean velocity: a moving observer sees the same.
pub(super) fn relative_speed(velocity: &[Vec2]) -> f64 {
    let mean = velocity.iter().sum::<Vec2>() / velocity.len() as f64;
    largest(velocity.len(), |a| (velocity[a] - mean).norm()).map_or(0.0, |l| l.1)
}

impl Flow {
    /// Moves the particles with the new velocity, and by `drift` (m), if there is any, which takes density errors back and leaves velocities
    /// alone; `responses` are those of given flows. The mean of old and new velocity [Huber2013, Eq. 27] would feed every swing that viscosity does not damp (docs/numerics/forces.md).
    pub(super) fn advance(
        &mut self,
        predicted: &Predicted,
        mut velocity: Vec<Vec2>,
        drift: &[Vec2],
        responses: &[Response],
        until: f64,
    ) -> Result<(), SolverError> {
        let (fluids, moving, dt) = (self.particles.fluids, self.particles.moving(), predicted.dt);
        let mut position = Vec::with_capacity(moving);
        for (a, v) in velocity.iter().enumerate() {
            let by = dt * v;
            if !(by.norm() <= LARGEST_MOVE * self.method.kernel.h) {
                let phase = if self.particles.phase[a] == Phase::Wetting { "wetting" } else { "non-wetting" };
                return Err(SolverError::BlowUp {
                    what: format!("a {phase} particle reached {:.3e} m/s", v.norm()),
                    time: self.time,
                    step: self.steps,
                    place: self.particles.position[a],
                });
            }
            position.push(self.domain.wrapped(self.particles.position[a] + by));
        }
        self.shift(dt, &mut position[..fluids], &mut velocity);
        for (x, by) in position.iter_mut().zip(drift) {
            *x = self.domain.wrapped(*x + by);
        }
        self.keep_flow_rates(responses, dt, &mut position[..fluids]);
        self.set_back_from_walls(&mut position[..fluids], &mut velocity[..fluids]);
        for through in &mut self.open.through {
            let (old, phase) = (&self.particles.position[..fluids], &mut self.particles.phase[..fluids]);
            let moved = Moved { from: old, to: &position[..fluids], volume: self.method.volume, dt };
            through.pass(&self.domain, &moved, phase, &mut self.open.ledger);
        }
        self.particles.position[..moving].copy_from_slice(&position);
        self.particles.velocity[..moving].copy_from_slice(&velocity);
        self.time = if dt >= until - self.time { until } else { self.time + dt };
        self.steps += 1;
        self.last = StepInfo { dt, limit: predicted.limit };
        Ok(())
    }

    /// Shifts crowded particles apart, and strays back across the interface; they carry their velocity along.
    fn shift(&self, dt: f64, position: &mut [Vec2], velocity: &mut [Vec2]) {
        let (fluids, m, f) = (self.particles.fluids, &self.method, &self.fields);
        let diffusion = m.shifting * m.kernel.h * relative_speed(&velocity[..fluids]) * dt;
        let mut by = vec![Vec2::zeros(); fluids];
        if diffusion > 0.0 {
            shifting::shift(&self.uneven(), diffusion, m.kernel.h, &mut by);
        }
        if let Some(jump) = &f.jump {
            let strays = Sharpening {
                side: &jump.side,
                normal: &f.normal,
                fluid_volume: &f.fluid_volume,
                wall_distance: &f.wall_distance,
                wall_normal: &f.wall_normal,
                weight: (m.wetting_fluid.density - m.other_fluid.density) / m.mean_density() * m.gravity,
                wall_hysteresis: &f.wall_hysteresis,
            };
            strays.displace(&self.pairs, m.kernel.h, m.capillary_speed(), dt, &mut by);
        } else if diffusion == 0.0 {
            return;
        }
        let mut change = vec![Vec2::zeros(); fluids];
        let mut all = velocity.to_vec();
        all.extend_from_slice(&self.particles.velocity[self.particles.moving()..]);
        self.images.extend_velocity(&mut all);
        shifting::carried_velocity(&self.pairs, &f.volume, &f.density, &all, &by, &mut change);
        for a in 0..fluids {
            position[a] = self.domain.wrapped(position[a] + by[a]);
            velocity[a] += change[a];
        }
    }

    /// ∇C of the fluid particles, near the interface its part along that, and the anti-clustering force, less their mean, in 1/m: what
    /// shifting goes down.
    fn uneven(&self) -> Vec<Vec2> {
        let (m, f) = (&self.method, &self.fields);
        let mut uneven = vec![Vec2::zeros(); self.particles.fluids];
        shifting::concentration_gradient(&self.pairs, &f.volume, &mut uneven);
        if f.jump.is_some() {
            shifting::keep_along(&f.normal, m.kernel.h, &mut uneven);
        }
        if m.anti_clustering > 0.0 {
            let mut push = vec![Vec2::zeros(); self.particles.fluids];
            shifting::anti_clustering(&self.pairs, &f.volume, m.anti_clustering, m.kernel.w(m.spacing), &mut push);
            shifting::take_out_mean(&self.pairs, &self.images, &f.fluid_volume, &mut push);
            uneven.iter_mut().zip(push).for_each(|(uneven, push)| *uneven += push);
        }
        uneven
    }

    fn set_back_from_walls(&mut self, position: &mut [Vec2], velocity: &mut [Vec2]) {
        let closest = CLOSEST_TO_WALL * self.method.spacing;
        let reach = closest + LARGEST_MOVE * self.method.kernel.h;
        for a in 0..position.len() {
            if self.fields.wall_distance[a] < reach {
                for pass in 0..SET_BACKS {
                    let (distance, normal) = (self.wall)(position[a]);
                    if distance >= closest {
                        break;
                    }
                    position[a] = self.domain.wrapped(position[a] + (closest - distance) * normal);
                    velocity[a] -= velocity[a].dot(&normal).min(0.0) * normal;
                    self.work.set_back += u64::from(pass == 0);
                }
            }
        }
        // Out of an inlet with a given velocity nothing flows: what shifting brings there is set back.
        for side in self.open.sides.iter().filter(|side| side.given_pressure().is_none()) {
            for x in position.iter_mut().filter(|x| side.beyond(**x) > -closest) {
                *x = side.placed(*x, -closest);
                self.work.set_back += 1;
            }
        }
        for mirror in &self.domain.mirrors {
            let inwards = (self.domain.bounds.center()[mirror.axis] - mirror.at).signum();
            for x in position.iter_mut() {
                let depth = inwards * (x[mirror.axis] - mirror.at);
                if depth < closest {
                    x[mirror.axis] = mirror.at + inwards * closest;
                    self.work.set_back += 1;
                }
            }
        }
    }
}
