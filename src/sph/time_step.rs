//! Limits of the time step (Morris et al. 1997; surface tension: docs/numerics/forces.md).

use std::f64::consts::PI;

use crate::case::{ViscousStep, ViscousTerm};
use crate::sph::method::Method;

/// Courant number on the smoothing length, without surface tension. It bounds the error of the motion, since particles move with the flow.
const COURANT: f64 = 0.125;

/// The same with surface tension, where the measures of the gallery do not tell one from the other (docs/numerics/forces.md, "Limit by
/// velocity").
const COURANT_WITH_TENSION: f64 = 0.25;

/// The largest Courant number that a factor on the step may ask for: with the overshoot below it stays under the way that ends a run.
const LARGEST_COURANT: f64 = 0.3;

/// A step that would carry a particle farther than the Courant number allows times this is taken again, shorter: from rest no velocity
/// tells what forces will do.
const OVERSHOOT: f64 = 1.5;

/// Factor on sqrt(ρ̄ h³/(2πσ)): the limit of Brackbill et al. 1992 for waves of two spacings is .54 at h = 1.5 dx. Explicit steps keep to
/// it, and so does the time of the density-error correction: measured, less often is less even.
const CAPILLARY: f64 = 0.5;

/// The same where viscosity is implicit. The fitted curvature damps short waves: the stiffest have 5 spacings, and steps are stable up to 4.5.
const LONG_CAPILLARY: f64 = 2.0;

/// The same for a flow near rest, of which a longer step loses nothing.
const RESTING_CAPILLARY: f64 = 4.0;

/// Above this density ratio both are halved: at 1000 longer steps throw particles of the liquid into the gas.
const LIGHT_GAS: f64 = 20.0;

/// Longest implicit step without surface tension over the time in which the slowest viscous motion decays: pressure and flow settle together.
const VISCOUS: f64 = 0.25;

/// The same over the time since when the forces act, where the pressure is that of the end of the step: what is left to change by then changes slowly.
const VISCOUS_LATER: f64 = 0.125;

/// A flow slower than this over the capillary speed is near rest.
const SLOW: f64 = 1e-3;

/// Szewc's form acts along the line of centers with four times the coefficient of Morris's, half of it on average.
const SZEWC_OVER_MORRIS: f64 = 2.0;

/// A step below this share of the static limits means that a velocity has run away.
const COLLAPSE: f64 = 1e-3;

/// What the limits are multiplied with.
struct Constants {
    velocity: f64,
    body_force: f64,
    capillary: f64,
}

/// A time step with the limit that rules it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TimeStep {
    /// Δt in s.
    pub(crate) dt: f64,
    /// Name of the limit.
    pub(crate) limit: &'static str,
}

impl TimeStep {
    /// This step, or one of length `dt` (s) by another limit if that is shorter.
    pub(crate) fn tighter(self, dt: f64, limit: &'static str) -> Self {
        if dt < self.dt { Self { dt, limit } } else { self }
    }
}

impl Method {
    /// The largest stable Δt for the fastest particle `speed` (m/s) and the largest viscous rate (1/s, see `Viscous::rate`).
    pub(crate) fn time_step(&self, speed: f64, viscous_rate: f64) -> TimeStep {
        let over_rate = if self.numerics.viscous_term == ViscousTerm::Szewc { 1.0 / SZEWC_OVER_MORRIS } else { 1.0 };
        self.inviscid_time_step(speed).tighter(self.numerics.time_step_factor * over_rate / viscous_rate, "viscosity")
    }

    /// The same without the limit by viscosity.
    pub(crate) fn inviscid_time_step(&self, speed: f64) -> TimeStep {
        let f = self.numerics.time_step_factor;
        let capillary = match self.numerics.viscous_step {
            ViscousStep::Implicit if speed < SLOW * self.capillary_speed() => self.in_gas() * RESTING_CAPILLARY,
            _ => self.moving_capillary(),
        };
        let body_force = f * self.usual_courant();
        self.bounded(speed, &Constants { velocity: self.courant(), body_force, capillary: f * capillary })
    }

    /// The largest Δt in s where a contact line is pinned. The curvature of the end of the step, which is used there, makes steps
    /// unstable above a factor of 4.5/√3 = 2.6, so that neither rest nor a factor of the user makes them longer.
    pub(crate) fn pinned_time_step(&self) -> f64 {
        self.numerics.time_step_factor.min(1.0) * self.moving_capillary() * self.time_of_waves()
    }

    /// The largest Δt in s where the slowest viscous motion decays in `viscous_time` (s) and the forces have acted for `age` (s).
    pub(crate) fn viscous_time_step(&self, viscous_time: f64, age: f64) -> f64 {
        self.numerics.time_step_factor * (VISCOUS * viscous_time).max(VISCOUS_LATER * age)
    }

    /// Factor of the limit by surface tension in a flow that moves.
    fn moving_capillary(&self) -> f64 {
        match self.numerics.viscous_step {
            ViscousStep::Implicit => self.in_gas() * LONG_CAPILLARY,
            ViscousStep::Explicit => CAPILLARY,
        }
    }

    fn in_gas(&self) -> f64 {
        if self.density_ratio() > LIGHT_GAS { 0.5 } else { 1.0 }
    }

    /// sqrt(ρ̄ h³/(2πσ)) in s.
    fn time_of_waves(&self) -> f64 {
        (self.mean_density() * self.kernel.h.powi(3) / (2.0 * PI * self.tension)).sqrt()
    }

    /// The Courant number of the limit by velocity without a factor on the step.
    fn usual_courant(&self) -> f64 {
        if self.tension > 0.0 { COURANT_WITH_TENSION } else { COURANT }
    }

    /// That with it.
    fn courant(&self) -> f64 {
        (self.numerics.time_step_factor * self.usual_courant()).min(LARGEST_COURANT)
    }

    /// The time in s in which the pressure takes its share of the density error back, whatever the step: with the shortest of the constants,
    /// since measured, less often is less even.
    pub fn density_correction_time(&self, speed: f64) -> f64 {
        self.bounded(speed, &Constants { velocity: COURANT, body_force: COURANT, capillary: CAPILLARY }).dt
    }

    /// The tightest of the limits by velocity, body force and surface tension.
    fn bounded(&self, speed: f64, constants: &Constants) -> TimeStep {
        let h = self.kernel.h;
        TimeStep { dt: f64::INFINITY, limit: "none" }
            .tighter(constants.capillary * self.time_of_waves(), "surface tension")
            .tighter(constants.body_force * (h / self.gravity.norm()).sqrt(), "gravity")
            .tighter(constants.velocity * h / speed, "velocity")
    }

    /// The step in s to take in place of one of length `dt` (s) in which a particle goes as far as `way` (m); none if it may go so far.
    ///
    /// What goes too far is taken to be accelerated: its way falls with the square of the step.
    pub(crate) fn shorter_step(&self, dt: f64, way: f64) -> Option<f64> {
        let meant = self.courant() * self.kernel.h;
        (way > OVERSHOOT * meant).then(|| dt * (meant / way).sqrt())
    }

    /// The smallest Δt that is accepted, in s.
    pub(crate) fn smallest_time_step(&self, viscous_rate: f64) -> f64 {
        let step = self.time_step(0.0, viscous_rate).dt;
        if step.is_finite() { COLLAPSE * step } else { 0.0 }
    }
}

/// Shortens `step` so that it lands on `until` (s) from `time` (s) without a last sliver.
pub(crate) fn landing(step: TimeStep, time: f64, until: f64) -> TimeStep {
    let left = until - time;
    if step.dt >= left {
        TimeStep { dt: left, limit: "record" }
    } else if 2.0 * step.dt > left {
        TimeStep { dt: 0.5 * left, limit: "record" }
    } else {
        step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_land_on_the_record_without_a_sliver() {
        let (mut time, until) = (0.0, 1.0);
        let mut steps = vec![];
        while time < until {
            let step = landing(TimeStep { dt: 0.3, limit: "velocity" }, time, until);
            steps.push(step.dt);
            time = if step.dt >= until - time { until } else { time + step.dt };
        }
        assert_eq!(time, until);
        assert_eq!(steps.len(), 4);
        assert!(steps.iter().all(|dt| *dt > 0.19));
    }
}
