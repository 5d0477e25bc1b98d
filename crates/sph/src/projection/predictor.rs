//! The predictor: all forces except the pressure [Huber2013, Eq. 25].

use super::intermediate::{Damped, Predicted};
use crate::fields::Fields;
use crate::method::PressureGradient;
use crate::open::InteriorPoints;
use crate::parallel::{each, largest, values};
use crate::particles::{Phase, relative_speed};
use crate::surface_force::SurfaceForce;
use crate::terms::pressure_gradient;
use crate::terms::transposed_stress::TransposedStress;
use crate::time_step::landing;
use crate::view::View;
use meniscus_case::ViscousStep;
use meniscus_core::math::Vec2;
use meniscus_core::solver::SolverError;

impl View<'_, Fields> {
    /// The predictor: viscosity, body force, surface force and line force [Huber2013, Eq. 25], without the gravity that the
    /// pressure balances (`hydrostatic`). The step ends at `until` (s) or before, and is at most `longest` (s) long. Viscosity is
    /// integrated by `viscous_step`; the length of the step does not depend on it.
    pub(super) fn predict(
        &self,
        until: f64,
        longest: f64,
        viscous_step: ViscousStep,
    ) -> Result<Predicted, SolverError> {
        let (particles, fluids, moving) =
            (&self.state.particles, self.state.particles.fluids, self.state.particles.moving());
        let stress = self.transposed_stress();
        let viscous = self.viscous_acceleration(&self.velocity(), stress.as_ref());
        let is_limited = self.config.method.numerics.viscous_step == ViscousStep::Explicit;
        let rate = if is_limited { self.viscous_rate() } else { 0.0 };
        // Walls count: fluid that they drag along has their velocity at the end of the step.
        let (fastest_particle, speed) = largest(particles.len(), |a| particles.velocity[a].norm()).unwrap_or((0, 0.0));
        let method = &self.config.method;
        let (f, force) = (&self.fields.bulk, &self.fields.interface.force);
        let is_pinned = matches!(force, SurfaceForce::Jump { has_pinned_line: true, .. });
        let pinned = if is_pinned { method.pinned_time_step() } else { f64::INFINITY };
        let settled = if self.config.has_viscous_pressure() { self.state.time - self.config.since } else { 0.0 };
        let step = method
            .time_step(speed, rate)
            .tighter(pinned, "surface tension")
            .tighter(method.viscous_time_step(self.config.viscous_time, settled), "viscosity")
            .tighter(longest, "acceleration");
        let smallest = self.config.method.smallest_time_step(rate);
        if !(step.dt >= smallest) {
            let (dt, limit, time, cause) =
                (step.dt, step.limit, self.state.time, self.cause_of_speed(fastest_particle));
            return Err(SolverError::TimeStep { dt, smallest, limit, time, step: self.state.steps, cause });
        }
        let step = landing(step, self.state.time, until);
        let fastest = relative_speed(&particles.velocity[..fluids]);
        let background = self.background_acceleration();
        let body = (self.config.method.gravity - self.config.balanced_gravity()) / self.config.method.profile();
        let driving = if self.gradient_in_pressure() { Vec2::zeros() } else { self.driving_gradient() };
        let mut acceleration = values(fluids, |a| {
            let forces = (force.on(a) + driving) / f.density[a];
            viscous[a] + body + forces + background[a]
        });
        let damped = match viscous_step {
            ViscousStep::Implicit => self.damp(&mut acceleration, step.dt, stress.as_ref())?,
            ViscousStep::Explicit => Damped::default(),
        };
        let mut velocity = particles.velocity.clone();
        each(&mut velocity[..fluids], |a| particles.velocity[a] + step.dt * acceleration[a]);
        let interior =
            InteriorPoints::new(particles, &self.config.open.sides, &self.config.domain, &self.config.method.kernel);
        interior.set_buffer_velocity(particles, &self.config.open.sides, &mut velocity);
        // Walls move tangentially: no volume flux, also where a moving wall ends at one at rest.
        velocity[moving..particles.len()].fill(Vec2::zeros());
        let velocity = self.neighborhood.images.velocity_field(velocity);
        Ok(Predicted { dt: step.dt, limit: step.limit, fastest, velocity, interior, damped })
    }

    /// What makes the particle `a` the fastest one, and the remedy.
    fn cause_of_speed(&self, a: usize) -> String {
        let particles = &self.state.particles;
        let Some((&x, speed)) = particles.position.get(a).zip(particles.velocity.get(a).map(|v| v.norm())) else {
            return "there are no particles".into();
        };
        let sides = &self.config.open.sides;
        let inlet = sides.iter().find(|side| side.overshoot(x) >= 0.0 && side.given_pressure().is_none());
        match (inlet, particles.phase[a]) {
            (Some(side), _) => {
                let name = side.name();
                format!(
                    "fluid comes in at {speed:.3e} m/s through the side `{name}`; lower its velocity or flow rate in sph.sides.open.{name}"
                )
            }
            (None, Phase::Solid) => format!("a wall moves at {speed:.3e} m/s; lower sph.sides.speed"),
            (None, phase) => {
                let phase = if phase == Phase::Wetting { "wetting" } else { "non-wetting" };
                format!(
                    "a {phase} particle at ({:.4e}, {:.4e}) m has reached {speed:.3e} m/s; the last frame shows where it comes from, \
                     and a smaller sph.spacing or sph.numerics.time-step-factor may prevent it",
                    x.x, x.y
                )
            }
        }
    }

    /// Replaces the `acceleration` (m/s²) of the forces at the beginning of a step of length `dt` (s) by that with implicit viscosity, if the
    /// step is longer than the explicit limit.
    ///
    /// The pressure of the previous step is included: forces that it balances cause no motion for viscosity to damp.
    fn damp(
        &self,
        acceleration: &mut [Vec2],
        dt: f64,
        stress: Option<&TransposedStress>,
    ) -> Result<Damped, SolverError> {
        let matrix = self.viscous_matrix(stress);
        let excess = matrix.excess(dt);
        // A step that is stable explicitly is as accurate, and needs no solve.
        if excess == 0.0 {
            return Ok(Damped::default());
        }
        let by_pressure = self.pressure_acceleration(&self.state.particles.pressure);
        let net = values(acceleration.len(), |a| acceleration[a] + by_pressure[a]);
        let (change, found) = matrix.change(&net, dt);
        if !found.is_reached() {
            return Err(self.not_converged("the viscous step", found));
        }
        each(acceleration, |a| change[a] / dt - by_pressure[a]);
        Ok(Damped { by_pressure, excess, weight: matrix.weight(dt), iterations: found.iterations })
    }

    fn background_acceleration(&self) -> Vec<Vec2> {
        let (method, fluids) = (&self.config.method, self.state.particles.fluids);
        if method.pressure_gradient() != PressureGradient::Difference || method.numerics.background_pressure <= 0.0 {
            return vec![Vec2::zeros(); fluids];
        }
        let over_density = method.background_pressure_at(self.state.particles.fluid_speed()) / method.mean_density();
        pressure_gradient::background(&self.neighborhood.pairs, &self.fields.bulk.volume, over_density, fluids)
    }
}
