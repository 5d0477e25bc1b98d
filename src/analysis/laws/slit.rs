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

/// Steps between two times asked for: fourth order, so that the error is below 1e-8 of the length.
const STEPS: usize = 400;

impl SlitFilling {
    /// Acceleration of the meniscus in m/s² at the filled length `x` (m) and speed `v` (m/s).
    ///
    /// (ρ₁ x + ρ₂ (L − x)) dv/dt = p + (ρ₁ x + ρ₂ (L − x)) g − 12 (μ₁ x + μ₂ (L − x)) v/w²: the plug flow of both columns with the
    /// friction of a parabola, between two sections of given pressure.
    fn acceleration(&self, x: f64, v: f64) -> f64 {
        let along = |[a, b]: [f64; 2]| a * x + b * (self.length - x);
        let mass = along(self.densities);
        (self.pressure - 12.0 * along(self.viscosities) * v / self.width.powi(2)) / mass + self.gravity
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

    /// One step of the classical Runge-Kutta method.
    fn step(&self, x: f64, v: f64, dt: f64) -> (f64, f64) {
        let slope = |x: f64, v: f64| (v, self.acceleration(x, v));
        let k1 = slope(x, v);
        let k2 = slope(x + 0.5 * dt * k1.0, v + 0.5 * dt * k1.1);
        let k3 = slope(x + 0.5 * dt * k2.0, v + 0.5 * dt * k2.1);
        let k4 = slope(x + dt * k3.0, v + dt * k3.1);
        let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * b + 2.0 * c + d) / 6.0;
        (x + dt * mean(k1.0, k2.0, k3.0, k4.0), v + dt * mean(k1.1, k2.1, k3.1, k4.1))
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
