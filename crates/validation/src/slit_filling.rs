//! Filling of a slit between two open sides by the wetting phase (C5 of the benchmarks).

use super::series::pairs;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::domain::ImageVelocity;
use meniscus_sph::flow::Flow;
use meniscus_sph::measures::{Columns, Subject};
use meniscus_sph::observe::Observation;
use meniscus_sph::open::OpenSide;
use meniscus_sph::particles::Phase;

/// A slit with a wetting liquid behind its meniscus and another fluid ahead of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlitFilling {
    /// Distance between the plates w in m.
    pub(crate) width: f64,
    /// Length of the slit L in m.
    pub(crate) length: f64,
    /// Driving pressure in Pa: capillary pressure 2 σ cos θ/w plus the pressure of the entry minus that of the exit.
    pub(crate) pressure: f64,
    /// Densities of liquid and other fluid in kg/m³.
    pub(crate) densities: [f64; 2],
    /// Dynamic viscosities of liquid and other fluid in Pa s.
    pub(crate) viscosities: [f64; 2],
    /// Navier's slip length λ at both plates in m.
    pub(crate) slip_length: f64,
    /// Body force per mass along the slit, positive inwards, in m/s².
    pub(crate) gravity: f64,
}

/// Steps between two requested times: second order, with an error of some 1e-8 of the length.
const STEPS: usize = 4000;

impl SlitFilling {
    /// Terminal speed in m/s of the meniscus at the filled length `x` (m), and the relaxation rate in 1/s.
    ///
    /// (ρ₁ x + ρ₂ (L − x)) dv/dt = p + (ρ₁ x + ρ₂ (L − x)) g − 12 (μ₁ x + μ₂ (L − x)) v/(w² (1 + 6 λ/w)): plug flow of both columns with the friction of
    /// a parabolic profile that slips, between two sections of given pressure.
    fn tends_to(&self, x: f64) -> (f64, f64) {
        let along = |[a, b]: [f64; 2]| a * x + b * (self.length - x);
        let slip = 1.0 + 6.0 * self.slip_length / self.width;
        let (mass, friction) = (along(self.densities), 12.0 * along(self.viscosities) / (self.width.powi(2) * slip));
        ((self.pressure + mass * self.gravity) / friction, friction / mass)
    }

    /// Filled lengths in m at ascending `times` (s), from rest at `start` (m) at time zero.
    pub(crate) fn lengths(&self, start: f64, times: &[f64]) -> Vec<f64> {
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

    /// One step of the exponential midpoint method: exact for constant coefficients, and stable for any friction.
    fn step(&self, x: f64, v: f64, dt: f64) -> (f64, f64) {
        let by = |(speed, rate): (f64, f64), dt: f64| {
            // (1 − exp(−rate dt))/rate, the time integral of the decay of the initial speed.
            let lost = -(-rate * dt).exp_m1() / rate;
            (x + speed * dt + (v - speed) * lost, v - (v - speed) * rate * lost)
        };
        let (middle, _) = by(self.tends_to(x), 0.5 * dt);
        by(self.tends_to(middle), dt)
    }
}

/// The side through which the wetting phase enters: the first open one that it touches or is injected through.
pub(super) fn entry(flow: &Flow) -> Option<&OpenSide> {
    flow.config.open.sides.iter().find(|side| side.main == Phase::Wetting)
}

/// Width of the domain across the slit in m.
fn across(flow: &Flow, side: &OpenSide) -> f64 {
    flow.config.domain.bounds.size()[1 - side.axis()]
}

/// `filled_length_m`: area of the wetting phase over the width.
pub(super) fn columns(flow: &Flow, observation: &Observation) -> Columns {
    let length = entry(flow).map_or(f64::NAN, |side| observation.areas.wetting / across(flow, side));
    vec![("filled_length_m", length)]
}

/// The exact solution for the slit; `None` if the sides are not those of a slit, or with a depth.
fn law(s: &Subject) -> Option<SlitFilling> {
    let (flow, m) = (s.flow, &s.flow.config.method);
    let side = entry(flow).filter(|_| m.plates.is_none())?;
    let exit = flow.config.open.sides.iter().find(|other| other.number != side.number)?;
    let is_half = flow.config.domain.mirrors.iter().any(|mirror| mirror.image == ImageVelocity::Mirrored);
    let width = across(flow, side) * if is_half { 2.0 } else { 1.0 };
    let capillary = 2.0 * m.tension * m.wetting?.static_angle().cos() / width;
    Some(SlitFilling {
        width,
        length: flow.config.domain.bounds.size()[side.axis()],
        pressure: capillary + side.given_pressure()? - exit.given_pressure()?,
        densities: [m.wetting_fluid.density, m.other_fluid.density],
        viscosities: [m.wetting_fluid.viscosity, m.other_fluid.viscosity],
        slip_length: m.no_slip.slip_length,
        gravity: side.inward_sign() * m.gravity[side.axis()],
    })
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let Some(law) = law(s) else { return vec![] };
    let (times, lengths) = pairs(s.series, "filled_length_m");
    let Some((&first, &last)) = lengths.first().zip(lengths.last()) else { return vec![] };
    let exact = law.lengths(first, &times);
    let advance = exact.last().map_or(f64::NAN, |end| end - first);
    let worst = lengths.iter().zip(&exact).map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max);
    let method = "area of the wetting phase over the width; exact: both columns with the friction of a parabola and the static angle";
    vec![
        measure("filled-length-m", last, "m").by("area of the wetting phase over the width, at the end"),
        measure("filling-ratio", (last - first) / advance, "")
            .by(format!("advance of the meniscus over the exact one; {method}")),
        measure("filling-error", worst / advance, "")
            .by(format!("largest difference over all records, over the whole advance; {method}")),
    ]
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
            slip_length: 0.0,
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
    fn slip_speeds_up_both_columns_as_it_does_a_parabola() {
        let slit = |slip_length: f64| SlitFilling {
            width: 1e-3,
            length: 0.02,
            pressure: 25.0,
            densities: [1e-4; 2],
            viscosities: [0.01; 2],
            slip_length,
            gravity: 0.0,
        };
        // u = p/(2 μ L) (y (w − y) + λ w) has the mean p w²/(12 μ L) (1 + 6 λ/w).
        let [without, with] = [0.0, 5e-5].map(|slip_length| slit(slip_length).lengths(0.0, &[1.0])[0]);
        assert!((with / without - 1.3).abs() < 1e-6, "{without} {with}");
    }

    #[test]
    fn two_columns_of_one_mass_start_up_like_a_body_with_friction() {
        let slit = SlitFilling {
            width: 1e-3,
            length: 0.02,
            pressure: 2.0,
            densities: [1000.0; 2],
            viscosities: [1e-3; 2],
            slip_length: 0.0,
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
