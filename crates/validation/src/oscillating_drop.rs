//! A free drop that oscillates between two ellipses (B3 of the benchmarks).
//!
//! The shape is represented by the ellipse with the second moments of the wetting particles, which needs no contour.

use std::f64::consts::{PI, TAU};

use nalgebra::Complex;

use super::damped;
use super::moments::Moments;
use super::series::pairs;
use super::waves::inverse_laplace;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::flow::Flow;
use meniscus_sph::measures::{Columns, Subject};
use meniscus_sph::observe::Observation;

/// A free drop in a fluid of equal density and viscosity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct OscillatingDrop {
    /// Radius at rest in m.
    pub(crate) radius: f64,
    /// Interfacial tension in N/m.
    pub(crate) tension: f64,
    /// Density of either fluid in kg/m³.
    pub(crate) density: f64,
    /// Dynamic viscosity of either fluid in Pa s.
    pub(crate) viscosity: f64,
}

/// The elliptic mode, n = 2.
const N: f64 = 2.0;

impl OscillatingDrop {
    /// Inviscid angular frequency of the elliptic mode in 1/s: sqrt(3 sigma/(rho R³)).
    pub(crate) fn frequency(&self) -> f64 {
        (self.tension * N * (N * N - 1.0) / (2.0 * self.density * self.radius.powi(3))).sqrt()
    }

    /// w0² (1 - 2 n I_n(q R) K_n(q R)) in 1/s², with q² = s/nu.
    fn stiffness(&self, s: Complex<f64>) -> Complex<f64> {
        let z = (s * self.density / self.viscosity).sqrt() * self.radius;
        (Complex::new(1.0, 0.0) - bessel_product(N, z) * (2.0 * N)) * self.frequency().powi(2)
    }

    /// Elongation at `time` (s) relative to that at time zero, from rest: the elliptic mode and the diffusion of vorticity.
    ///
    /// Its Laplace transform is 1/(s + w0² (1 - 2 n I_n K_n)/s).
    pub(crate) fn elongation(&self, time: f64) -> f64 {
        if time <= 0.0 { 1.0 } else { inverse_laplace(|s| (s + self.stiffness(s) / s).inv(), time, 0.0) }
    }
}

/// I_n(z) K_n(z) of integer `order`, Re z > 0, by the trapezoidal rule on their integrals, which converges exponentially.
fn bessel_product(order: f64, z: Complex<f64>) -> Complex<f64> {
    // 60 nodes per radian of |z| are sufficient; K needs cosh t up to 700/Re z, below t = 12 for the drops here.
    let nodes = 400;
    let step = PI / nodes as f64;
    let of_i = |k: usize| {
        let angle = k as f64 * step;
        let weight = if k == 0 || k == nodes { 0.5 } else { 1.0 };
        // Scaled by exp(-z), and K by exp(z), so that neither overflows.
        (z * (angle.cos() - 1.0)).exp() * (order * angle).cos() * weight
    };
    let i: Complex<f64> = (0..=nodes).map(of_i).sum::<Complex<f64>>() / nodes as f64;
    let (far, points) = (12.0, 1200);
    let step = far / points as f64;
    let of_k = |k: usize| {
        let t = k as f64 * step;
        let weight = if k == 0 { 0.5 } else { 1.0 };
        (z * (1.0 - t.cosh())).exp() * (order * t).cosh() * weight
    };
    i * (0..=points).map(of_k).sum::<Complex<f64>>() * step
}

/// The fit excludes this initial fraction of the inviscid period, while the initial vorticity diffuses.
const LEFT_OUT: f64 = 0.25;

/// `elongation` along x and `deformation` along the principal axes.
pub(super) fn columns(flow: &Flow, _: &Observation) -> Columns {
    let moments = Moments::of_wetting_phase(flow);
    vec![("elongation", moments.elongation()), ("deformation", moments.deformation())]
}

/// The drop at rest for the linear theory; there is no closed form here for fluids with different properties.
pub(super) fn drop(s: &Subject) -> OscillatingDrop {
    let m = &s.flow.config.method;
    OscillatingDrop {
        radius: (s.observed.areas.wetting / PI).sqrt(),
        tension: m.tension,
        density: m.mean_density(),
        viscosity: m.wetting_fluid.viscosity,
    }
}

/// Period and decay rate, absolute and relative to those of the linear viscous solution.
///
/// The solution is fitted in the same way at the same times: besides the elliptic mode it has a part with algebraic decay, which changes the half periods of
/// a viscous drop by some percent.
pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (m, drop) = (&s.flow.config.method, drop(s));
    let inviscid = drop.frequency();
    let (times, values) = pairs(s.series, "elongation");
    let from = times.iter().position(|t| *t >= LEFT_OUT * TAU / inviscid).unwrap_or(times.len());
    let (times, values) = (&times[from..], &values[from..]);
    let fit = damped::fit(times, values, inviscid);
    let exact = if m.wetting_fluid == m.other_fluid {
        let solution: Vec<f64> = times.iter().map(|&t| drop.elongation(t)).collect();
        damped::fit(times, &solution, inviscid)
    } else {
        None
    };
    let period = fit.map_or(f64::NAN, |fit| TAU / fit.frequency);
    let decay = fit.map_or(f64::NAN, |fit| fit.decay);
    let method =
        "damped oscillation fitted to the elongation of the wetting phase along x, without the first quarter period";
    let over = "over that of the linear viscous solution for a drop in an equal fluid, fitted at the same times";
    vec![
        measure("period-s", period, "s").by(method),
        measure("decay-rate", decay, "1/s").by(method),
        measure("period-ratio", exact.map_or(f64::NAN, |e| period * e.frequency / TAU), "").by(over),
        measure("decay-rate-ratio", exact.map_or(f64::NAN, |e| decay / e.decay), "").by(over),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A damped oscillation exp(-decay t) cos(frequency t).
    #[derive(Debug, Clone, Copy, PartialEq)]
    struct Damped {
        /// Angular frequency in 1/s.
        frequency: f64,
        /// Decay rate in 1/s.
        decay: f64,
    }

    impl OscillatingDrop {
        /// The elliptic mode, n = 2: the root s of s² + w0² (1 - 2 n I_n(q R) K_n(q R)) = 0 with q² = s/nu and w0² = sigma n (n² - 1)/(2 rho R³); `None` if
        /// the drop is overdamped.
        fn elliptic_mode(&self) -> Option<Damped> {
            let rigid = self.frequency().powi(2);
            let excess = |s: Complex<f64>| s * s + self.stiffness(s);
            // The secant method from a tenth of critical damping, near most underdamped drops.
            let mut old = Complex::new(-0.05, 1.0) * rigid.sqrt();
            let mut s = Complex::new(-0.1, 0.9) * rigid.sqrt();
            let mut at_old = excess(old);
            for _ in 0..60 {
                let at = excess(s);
                let change = at * (s - old) / (at - at_old);
                if !change.is_finite() || change.norm() < 1e-12 * rigid.sqrt() {
                    break;
                }
                (old, at_old) = (s, at);
                s -= change;
            }
            let found = excess(s).norm() < 1e-9 * rigid && s.im.abs() > 1e-6 * rigid.sqrt();
            found.then_some(Damped { frequency: s.im.abs(), decay: -s.re })
        }
    }

    #[test]
    fn drops_in_an_equal_fluid_have_the_printed_frequencies_and_decays() {
        for (viscosity, frequency, decay) in [(0.02, 1.60008, 0.15172), (0.05, 1.52183, 0.25975)] {
            let drop = OscillatingDrop { radius: 1.0, tension: 1.0, density: 1.0, viscosity };
            let mode = drop.elliptic_mode().expect("an oscillation");
            assert!((mode.frequency - frequency).abs() < 1e-5, "{viscosity}: {mode:?}");
            assert!((mode.decay - decay).abs() < 1e-5, "{viscosity}: {mode:?}");
        }
        let drop = OscillatingDrop { radius: 0.1875, tension: 1.0, density: 1.0, viscosity: 0.05 };
        let mode = drop.elliptic_mode().expect("an oscillation");
        assert!((2.0 * PI / mode.frequency - 0.36805).abs() < 1e-5 && (mode.decay - 5.518).abs() < 1e-3, "{mode:?}");
    }

    #[test]
    fn the_elongation_of_a_drop_with_little_viscosity_is_that_of_its_mode() {
        let drop = OscillatingDrop { radius: 1.0, tension: 1.0, density: 1.0, viscosity: 1e-3 };
        let mode = drop.elliptic_mode().expect("an oscillation");
        for time in [0.5, 2.0, 4.0] {
            let wave = (-mode.decay * time).exp() * (mode.frequency * time).cos();
            // The remainder beyond the mode is of the order of the boundary layer, sqrt(nu w)/(w R) = 0.024.
            assert!((drop.elongation(time) - wave).abs() < 0.03, "{time}: {} {wave}", drop.elongation(time));
        }
        assert!((drop.elongation(1e-4) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_very_viscous_drop_does_not_oscillate() {
        let drop = OscillatingDrop { radius: 1.0, tension: 1.0, density: 1.0, viscosity: 5.0 };
        assert_eq!(drop.elliptic_mode(), None);
    }
}
