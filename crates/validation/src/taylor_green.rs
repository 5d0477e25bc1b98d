//! Decay rate of Taylor-Green vortices (A3 of the benchmarks).

use std::f64::consts::PI;

use meniscus_core::solver::{Measure, measure};
use meniscus_sph::measures::Subject;

/// Speed of a Taylor-Green vortex of period `length` (m) relative to its initial speed: exp(-8 pi² nu t/L²).
pub(crate) fn taylor_green_decay(kinematic_viscosity: f64, length: f64, time: f64) -> f64 {
    (-8.0 * PI * PI * kinematic_viscosity * time / (length * length)).exp()
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let flow = s.flow;
    let fluid = flow.config.method.wetting_fluid;
    let mut energy = s.series.column("kinetic_energy_J_per_m");
    let (first, last) = (energy.next().unwrap_or(f64::NAN), energy.last().unwrap_or(f64::NAN));
    let length = flow.config.domain.bounds.size().x;
    let exact = taylor_green_decay(fluid.viscosity / fluid.density, length, flow.state.time).ln();
    let error = 0.5 * (last / first).ln() / exact - 1.0;
    let method = "rate of decay of the square root of the kinetic energy over the run, over 8 pi^2 nu/L^2, less 1";
    vec![measure("decay-rate-error", error, "").by(method)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taylor_green_at_reynolds_100_has_decayed_to_the_printed_speed() {
        assert!((taylor_green_decay(0.01, 1.0, 2.0) - 0.20615).abs() < 0.6e-5);
    }
}
