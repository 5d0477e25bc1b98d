//! Limits of the time step (Morris et al. 1997; surface tension: docs/numerics/forces.md).

use std::f64::consts::PI;

use crate::method::Method;
use meniscus_case::{ViscousStep, ViscousTerm};

/// Courant number on the smoothing length, without surface tension. It bounds the error of particle trajectories.
const COURANT: f64 = 0.125;

/// Courant number with surface tension, where the measures of the gallery do not differ between the two values.
const COURANT_WITH_TENSION: f64 = 0.25;

/// Largest Courant number for any factor on the step: with the overshoot below, displacements remain under the limit that ends a run.
const LARGEST_COURANT: f64 = 0.3;

/// A step in which a particle moves farther than the Courant number times this is repeated with a shorter step: at rest the velocity does not
/// indicate the effect of forces.
const OVERSHOOT: f64 = 1.5;

/// Factor on sqrt(ρ̄ h³/(2πσ)): the limit of Brackbill et al. 1992 for waves of two spacings is .54 at h = 1.5 dx. Used for explicit
/// steps, and for the time of the density-error correction: less frequent corrections give a measurably less uniform density.
const CAPILLARY: f64 = 0.5;

/// `CAPILLARY` with implicit viscosity. The fitted curvature damps short waves: along a row of particles the stiffest have 5 spacings, and steps are stable up
/// to 4.4.
const LONG_CAPILLARY: f64 = 2.0;

/// `CAPILLARY` for a flow near rest, where a longer step does not reduce the accuracy: four fifths of the limit for a row. Around a drop the rows are disordered,
/// and with 4.0 waves of 5 spacings grow in a liquid of low viscosity.
const RESTING_CAPILLARY: f64 = 3.6;

/// Density ratio above which the last two are halved: at 1000 longer steps eject particles of the liquid into the gas.
const LIGHT_GAS: f64 = 20.0;

/// Longest implicit step without surface tension over the decay time of the slowest viscous mode: pressure and flow settle together.
const VISCOUS: f64 = 0.25;

/// Longest implicit step over the time since the forces were applied, if the pressure is that of the end of the step: later changes are slow.
const VISCOUS_LATER: f64 = 0.125;

/// Speed over the capillary speed below which a flow is near rest.
const SLOW: f64 = 1e-3;

/// Szewc's form acts along the line of centers with four times the coefficient of Morris's form, on average with twice.
const SZEWC_OVER_MORRIS: f64 = 2.0;

/// A step below this fraction of the static limits indicates a diverging velocity.
const COLLAPSE: f64 = 1e-3;

/// Factors of the limits.
struct Constants {
    velocity: f64,
    body_force: f64,
    capillary: f64,
}

/// A time step with the limit that determines it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TimeStep {
    /// Δt in s.
    pub(crate) dt: f64,
    /// Name of the limit.
    pub(crate) limit: &'static str,
}

impl TimeStep {
    /// The shorter of this step and one of length `dt` (s) by another limit.
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

    /// The limit of the step by velocity and capillary waves \[Brackbill1992\]. [`Self::time_step`] adds the viscous limit.
    pub(crate) fn inviscid_time_step(&self, speed: f64) -> TimeStep {
        let f = self.numerics.time_step_factor;
        let capillary = match self.numerics.viscous_step {
            ViscousStep::Implicit if speed < SLOW * self.capillary_speed() => self.in_gas() * RESTING_CAPILLARY,
            _ => self.moving_capillary(),
        };
        let body_force = f * self.usual_courant();
        self.bounded(speed, &Constants { velocity: self.courant(), body_force, capillary: f * capillary })
    }

    /// The largest Δt in s if a contact line is pinned. The curvature at the end of the step, which is used there, makes steps
    /// unstable above a factor of 4.4/√3 = 2.5, so that neither rest nor the factor in the case makes them longer.
    pub(crate) fn pinned_time_step(&self) -> f64 {
        self.numerics.time_step_factor.min(1.0) * self.moving_capillary() * self.time_of_waves()
    }

    /// The largest Δt in s for the decay time `viscous_time` (s) of the slowest viscous mode and forces that have acted for `age` (s).
    pub(crate) fn viscous_time_step(&self, viscous_time: f64, age: f64) -> f64 {
        self.numerics.time_step_factor * (VISCOUS * viscous_time).max(VISCOUS_LATER * age)
    }

    /// Factor of the capillary limit in a moving flow.
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

    /// The Courant number without the factor on the step.
    fn usual_courant(&self) -> f64 {
        if self.tension > 0.0 { COURANT_WITH_TENSION } else { COURANT }
    }

    /// The Courant number with the factor on the step.
    fn courant(&self) -> f64 {
        (self.numerics.time_step_factor * self.usual_courant()).min(LARGEST_COURANT)
    }

    /// The time in s over which the pressure corrects the density error, independent of the step: with the smallest constants, since less
    /// frequent corrections give a measurably less uniform density.
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

    /// The step in s to replace one of length `dt` (s) in which a particle moves by `displacement` (m); `None` if that is allowed.
    ///
    /// Assumes acceleration from rest: the displacement is proportional to the square of the step.
    pub(crate) fn shorter_step(&self, dt: f64, displacement: f64) -> Option<f64> {
        let allowed = self.courant() * self.kernel.h;
        (displacement > OVERSHOOT * allowed).then(|| dt * (allowed / displacement).sqrt())
    }

    /// The smallest accepted Δt in s, a share of the limits in [`Self::time_step`]: a limit that can be far below these belongs there.
    pub(crate) fn smallest_time_step(&self, viscous_rate: f64) -> f64 {
        let step = self.time_step(0.0, viscous_rate).dt;
        if step.is_finite() { COLLAPSE * step } else { 0.0 }
    }
}

/// Shortens `step` so that steps from `time` (s) end at `until` (s) without a very short last one.
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

    /// [Huber2013, Eq. 27]
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
