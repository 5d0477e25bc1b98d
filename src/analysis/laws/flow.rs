//! Exact solutions for single-phase and layered flow.

use std::f64::consts::PI;

use crate::analysis::roots::bisect;

/// Flow between plates at y = 0 and y = H, driven by a body force per volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Poiseuille {
    /// Driving force per volume G in N/m³.
    pub force: f64,
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
    /// Density in kg/m³, for the start-up.
    pub density: f64,
    /// Distance of the plates H in m.
    pub height: f64,
    /// Navier's slip length b of the plates in m, at least 0.
    pub slip_length: f64,
}

/// Terms of the start-up series: the last is below 1e-7 of the first, at time zero.
const SERIES_TERMS: usize = 200;

impl Poiseuille {
    /// Final velocity in m/s at `y` (m): G (y (H - y) + H b)/(2 mu).
    #[must_use]
    pub fn steady(&self, y: f64) -> f64 {
        let height = self.height;
        self.force * (y * (height - y) + height * self.slip_length) / (2.0 * self.viscosity)
    }

    /// Velocity in m/s at `y` (m) and `time` (s) after the force sets in on fluid at rest.
    ///
    /// The steady flow less Σ c cos(k (y − H/2)) exp(−ν k² t), where b k tan(kH/2) = 1, as Navier's condition asks for, and
    /// c = (G/(μ k²)) (2 sin(kH/2)/k)/(H/2 + sin(kH)/(2k)).
    #[must_use]
    pub fn at(&self, y: f64, time: f64) -> f64 {
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

/// Two layers between plates at y = 0 and y = H, driven by a force per volume; layer 1 lies below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayeredPoiseuille {
    /// Driving force per volume in N/m³.
    pub force: f64,
    /// Thicknesses in m.
    pub heights: [f64; 2],
    /// Dynamic viscosities in Pa s.
    pub viscosities: [f64; 2],
}

impl LayeredPoiseuille {
    /// Shear stress in Pa at the lower plate: velocity and stress are continuous at the interface.
    fn wall_stress(&self) -> f64 {
        let ([h1, h2], [m1, m2]) = (self.heights, self.viscosities);
        let load = h1 * h1 / (2.0 * m1) + (h1 * h2 + 0.5 * h2 * h2) / m2;
        self.force * load / (h1 / m1 + h2 / m2)
    }

    /// Velocity in m/s at `y` (m).
    #[must_use]
    pub fn velocity(&self, y: f64) -> f64 {
        let ([h1, _], [m1, m2]) = (self.heights, self.viscosities);
        let momentum = |y: f64| self.wall_stress() * y - 0.5 * self.force * y * y;
        if y <= h1 { momentum(y) / m1 } else { momentum(h1) / m1 + (momentum(y) - momentum(h1)) / m2 }
    }

    /// Velocity of the interface in m/s.
    #[must_use]
    pub fn interface_velocity(&self) -> f64 {
        self.velocity(self.heights[0])
    }

    /// Flow rates of the two layers in m²/s.
    #[must_use]
    pub fn flow_rates(&self) -> [f64; 2] {
        let [h1, h2] = self.heights;
        // Simpson's rule is exact for parabolas.
        let rate = |from: f64, thickness: f64| {
            let at = |part: f64| self.velocity(from + part * thickness);
            thickness / 6.0 * (at(0.0) + 4.0 * at(0.5) + at(1.0))
        };
        [rate(0.0, h1), rate(h1, h2)]
    }
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
        // Early on the middle has not felt the plates: u = G t/rho.
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

    #[test]
    fn layered_flow_has_the_printed_interface_velocity_and_rates() {
        for (m, interface, below, above) in [
            (1.0, 0.125, 0.041_666_7, 0.041_666_7),
            (2.0, 0.166_666_7, 0.052_083_3, 0.0625),
            (10.0, 0.227_272_7, 0.067_234_8, 0.160_984_8),
            (100.0, 0.247_524_8, 0.072_297_9, 1.103_547_9),
        ] {
            let flow = LayeredPoiseuille { force: 1.0, heights: [0.5, 0.5], viscosities: [1.0, 1.0 / m] };
            let [q1, q2] = flow.flow_rates();
            assert!((flow.interface_velocity() - interface).abs() < 1e-7, "m {m}: {}", flow.interface_velocity());
            assert!((q1 - below).abs() < 1e-7 && (q2 - above).abs() < 1e-7, "m {m}: {q1} {q2}");
            assert!(flow.velocity(1.0).abs() < 1e-14);
        }
    }
}
