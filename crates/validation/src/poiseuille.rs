//! Velocity error with respect to plane Poiseuille flow (A1 of the benchmarks), including its start-up, and the measured slip length.

use std::f64::consts::PI;

use nalgebra::{Matrix2, Vector2};

use meniscus_core::solver::{Measure, measure};
use meniscus_geometry::analysis::roots::bisect;
use meniscus_sph::measures::Subject;
use meniscus_sph::open::{Drive, OpenSide};

/// Flow between plates at y = 0 and y = H, driven by a body force per volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Poiseuille {
    /// Driving force per volume G in N/m³.
    pub(crate) force: f64,
    /// Dynamic viscosity in Pa s.
    pub(crate) viscosity: f64,
    /// Density in kg/m³, for the start-up.
    pub(crate) density: f64,
    /// Distance between the plates H in m.
    pub(crate) height: f64,
    /// Navier's slip length b of the plates in m, at least 0.
    pub(crate) slip_length: f64,
}

/// Terms of the start-up series: at time zero the last one is below 1e-7 of the first.
const SERIES_TERMS: usize = 200;

impl Poiseuille {
    /// Steady velocity in m/s at `y` (m): G (y (H - y) + H b)/(2 mu).
    pub(crate) fn steady(&self, y: f64) -> f64 {
        let height = self.height;
        self.force * (y * (height - y) + height * self.slip_length) / (2.0 * self.viscosity)
    }

    /// Velocity in m/s at `y` (m) and `time` (s) after the force is applied to fluid at rest.
    ///
    /// The steady flow minus Σ c cos(k (y − H/2)) exp(−ν k² t), where b k tan(kH/2) = 1 by Navier's condition, and c = (G/(μ k²)) (2 sin(kH/2)/k)/(H/2 +
    /// sin(kH)/(2k)).
    pub(crate) fn at(&self, y: f64, time: f64) -> f64 {
        let (height, nu) = (self.height, self.viscosity / self.density);
        let term = |n: usize| {
            let half = self.half_wave(n);
            let k = 2.0 * half / height;
            let share = 2.0 * half.sin() / k / (0.5 * height + (2.0 * half).sin() / (2.0 * k));
            let c = self.force / (self.viscosity * k * k) * share;
            c * (k * (y - 0.5 * height)).cos() * (-nu * k * k * time).exp()
        };
        self.steady(y) - (0..SERIES_TERMS).map(term).sum::<f64>()
    }

    /// The root x = kH/2 of 2 b x sin x = H cos x between n π and (n + 1/2) π.
    fn half_wave(&self, n: usize) -> f64 {
        let (low, high) = (n as f64 * PI, (n as f64 + 0.5) * PI);
        let condition = |x: f64| 2.0 * self.slip_length * x * x.sin() - self.height * x.cos();
        if self.slip_length == 0.0 { high } else { bisect(condition, low, high).unwrap_or(high) }
    }
}

/// The driving force per volume in N/m³, and whether it acts from time zero on.
fn force(s: &Subject) -> (f64, bool) {
    let (flow, size) = (s.flow, s.flow.config.domain.bounds.size());
    let fluid = flow.config.method.wetting_fluid;
    let weight = fluid.density * flow.config.method.gravity.x;
    let inlets = flow.config.open.sides.iter().chain(&flow.config.open.through);
    for side in inlets {
        if let Drive::Velocity(profile) = &side.drive {
            return (12.0 * fluid.viscosity * profile.mean * side.inward_sign() / size.y.powi(2), false);
        }
    }
    let pressure = |number| {
        let side = flow.config.open.sides.iter().find(|side| side.number == number);
        side.and_then(OpenSide::given_pressure).unwrap_or(0.0)
    };
    (weight + (pressure(0) - pressure(1)) / size.x, true)
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, bounds) = (s.flow, s.flow.config.domain.bounds);
    let fluid = flow.config.method.wetting_fluid;
    let (force, starts_up) = force(s);
    let height = bounds.size().y;
    let law = Poiseuille {
        force,
        viscosity: fluid.viscosity,
        density: fluid.density,
        height,
        slip_length: flow.config.method.no_slip.slip_length,
    };
    let (mut error, mut size) = (0.0, 0.0);
    // Least squares of u = a y (H − y) + c.
    let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for (x, v) in
        flow.state.particles.position.iter().zip(&flow.state.particles.velocity).take(flow.state.particles.fluids)
    {
        let y = x.y - bounds.min.y;
        let exact = if starts_up { law.at(y, flow.state.time) } else { law.steady(y) };
        error += (v.x - exact).powi(2) + v.y.powi(2);
        size += exact * exact;
        let row = Vector2::new(y * (height - y), 1.0);
        matrix += row * row.transpose();
        right += v.x * row;
    }
    let slip = matrix.cholesky().map_or(f64::NAN, |matrix| {
        let found = matrix.solve(&right);
        found[1] / (found[0] * height)
    });
    let method = "L2 norm over particles of the velocity less the start-up series at the end, over that of the series; with a given flow less \
                  the steady parabola";
    let method_of_slip = "b of the parabola a (y (H - y) + H b) fitted to the velocities at the end; of a steady flow";
    vec![
        measure("velocity-l2-error", (error / size).sqrt(), "").by(method),
        measure("slip-length-m", slip, "m").by(method_of_slip),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poiseuille_flow_starts_at_rest_and_ends_as_a_parabola() {
        let flow = Poiseuille { force: 2.0, viscosity: 0.5, density: 3.0, height: 0.4, slip_length: 0.0 };
        let peak = flow.steady(0.2);
        assert!((peak - 2.0 * 0.04 / 1.0).abs() < 1e-15);
        assert!(flow.at(0.2, 0.0).abs() < 1e-5 * peak && flow.at(0.07, 0.0).abs() < 1e-5 * peak);
        assert!((flow.at(0.13, 50.0) - flow.steady(0.13)).abs() < 1e-15);
        // Initially the middle is not affected by the plates: u = G t/rho.
        assert!((flow.at(0.2, 1e-3) / (2.0 * 1e-3 / 3.0) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn poiseuille_flow_with_slip_starts_at_rest_and_keeps_naviers_condition() {
        let flow = Poiseuille { force: 2.0, viscosity: 0.5, density: 3.0, height: 0.4, slip_length: 0.05 };
        let peak = flow.steady(0.2);
        assert!((peak - 2.0 * (0.04 + 0.4 * 0.05)).abs() < 1e-15);
        assert!(flow.at(0.2, 0.0).abs() < 1e-5 * peak && flow.at(0.03, 0.0).abs() < 1e-5 * peak);
        for time in [1e-2, 0.1, 50.0] {
            let slope = (flow.at(1e-6, time) - flow.at(0.0, time)) / 1e-6;
            assert!((flow.at(0.0, time) / (0.05 * slope) - 1.0).abs() < 1e-4, "at {time} s");
        }
    }
}
