//! How a liquid fills a slit between plates that another fluid leaves (C5 of the benchmarks).

/// A slit with a wetting liquid behind its meniscus and another fluid before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlitFilling {
    /// Distance of the plates w in m.
    pub width: f64,
    /// Length of the slit L in m.
    pub length: f64,
    /// What drives in Pa: capillary pressure 2 σ cos θ/w and the pressure of the entry less that of the exit.
    pub pressure: f64,
    /// Densities of liquid and other fluid in kg/m³.
    pub densities: [f64; 2],
    /// Dynamic viscosities of liquid and other fluid in Pa s.
    pub viscosities: [f64; 2],
    /// Body force per mass along the slit inwards in m/s².
    pub gravity: f64,
}

/// Steps between two times asked for: second order, so that the error is some 1e-8 of the length.
const STEPS: usize = 4000;

impl SlitFilling {
    /// Speed in m/s that the meniscus tends to at the filled length `x` (m), and the rate in 1/s at which it does.
    ///
    /// (ρ₁ x + ρ₂ (L − x)) dv/dt = p + (ρ₁ x + ρ₂ (L − x)) g − 12 (μ₁ x + μ₂ (L − x)) v/w²: the plug flow of both columns with the
    /// friction of a parabola, between two sections of given pressure.
    fn tends_to(&self, x: f64) -> (f64, f64) {
        let along = |[a, b]: [f64; 2]| a * x + b * (self.length - x);
        let (mass, friction) = (along(self.densities), 12.0 * along(self.viscosities) / self.width.powi(2));
        ((self.pressure + mass * self.gravity) / friction, friction / mass)
    }

    /// Filled lengths in m at rising `times` (s), from rest at `start` (m) at time zero.
    #[must_use]
    pub fn lengths(&self, start: f64, times: &[f64]) -> Vec<f64> {
        let (mut t, mut x, mut v) = (0.0, start, 0.0);
        times
            .iter()
            .map(|&time| {
                let dt = (time - t) / STEPS as f64;
                for _ in 0..STEPS {
                    (x, v) = self.step(x, v, dt);
                }
                t = time;
                x
            })
            .collect()
    }

    /// One step of the exponential midpoint method: exact for constant coefficients, and stable however fast the friction acts.
    fn step(&self, x: f64, v: f64, dt: f64) -> (f64, f64) {
        let by = |(speed, rate): (f64, f64), dt: f64| {
            // (1 − exp(−rate dt))/rate, the time over which the first speed is lost.
            let lost = -(-rate * dt).exp_m1() / rate;
            (x + speed * dt + (v - speed) * lost, v - (v - speed) * rate * lost)
        };
        let (middle, _) = by(self.tends_to(x), 0.5 * dt);
        by(self.tends_to(middle), dt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_inertia_a_slit_fills_by_the_law_of_two_fluids() {
        // (μ₁ − μ₂) x²/2 + μ₂ L x = w² p t/12 with x = 0 at time zero, closed form for any viscosities.
        let slit = SlitFilling {
            width: 1e-3,
            length: 0.02,
            pressure: 25.0,
            densities: [1e-4; 2],
            viscosities: [0.01, 0.004],
            gravity: 0.0,
        };
        let times = [1.0, 3.0];
        for (x, t) in slit.lengths(0.0, &times).into_iter().zip(times) {
            let left = 0.5 * 0.006 * x * x + 0.004 * 0.02 * x;
            let right = 1e-6 * 25.0 * t / 12.0;
            // The start from rest takes the time ρ w²/(12 μ), 1e-9 s.
            assert!((left / right - 1.0).abs() < 1e-6, "{left} {right}");
        }
    }

    #[test]
    fn two_columns_of_one_mass_start_up_like_a_body_with_friction() {
        let slit = SlitFilling {
            width: 1e-3,
            length: 0.02,
            pressure: 2.0,
            densities: [1000.0; 2],
            viscosities: [1e-3; 2],
            gravity: 0.05,
        };
        let rate: f64 = 12.0 * 1e-3 / (1000.0 * 1e-6);
        let final_speed = (2.0 / (1000.0 * 0.02) + 0.05) / rate;
        let t = 0.1;
        let exact = 1e-3 + final_speed * (t - (1.0 - (-rate * t).exp()) / rate);
        let found = slit.lengths(1e-3, &[t])[0];
        assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
    }
}
