//! Linear viscous capillary modes of two fluids of equal density and viscosity: plane waves and free drops.
//!
//! With equal fluids the interface is a sheet of force in one fluid, and its own motion follows in closed form from the Green's
//! function of the unsteady Stokes equation. Leaves out gravity, walls and fluids that differ (for those: Prosperetti 1981).

use std::f64::consts::PI;

use nalgebra::Complex;

/// Nodes of the inverse Laplace transform: enough to enclose the poles over three periods, with nine digits left by rounding.
const NODES: usize = 40;

/// A function of time from its Laplace transform, at `time` (s) above 0 (fixed Talbot contour, Abate & Valkó 2004).
fn inverse_laplace(transform: impl Fn(Complex<f64>) -> Complex<f64>, time: f64) -> f64 {
    let r = 2.0 * NODES as f64 / (5.0 * time);
    let first = 0.5 * (transform(Complex::new(r, 0.0)).re * (r * time).exp());
    let node = |k: usize| {
        let angle = k as f64 * PI / NODES as f64;
        let cotangent = 1.0 / angle.tan();
        let s = r * angle * Complex::new(cotangent, 1.0);
        let slope = Complex::new(1.0, angle + (angle * cotangent - 1.0) * cotangent);
        ((s * time).exp() * transform(s) * slope).re
    };
    r / NODES as f64 * (first + (1..NODES).map(node).sum::<f64>())
}

/// A standing wave on the flat interface of two equal fluids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CapillaryWave {
    /// Length of the wave in m.
    pub length: f64,
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// Density of either fluid in kg/m³.
    pub density: f64,
    /// Dynamic viscosity of either fluid in Pa s.
    pub viscosity: f64,
}

impl CapillaryWave {
    /// Inviscid angular frequency in 1/s: sqrt(sigma k³/(2 rho)).
    #[must_use]
    pub fn frequency(&self) -> f64 {
        let k = 2.0 * PI / self.length;
        (self.tension * k.powi(3) / (2.0 * self.density)).sqrt()
    }

    /// Amplitude at `time` (s) over that at time zero, from rest [Prosperetti1981 for equal fluids].
    ///
    /// Its Laplace transform is 1/(s + w² (1 - k/sqrt(k² + s/nu))/s).
    #[must_use]
    pub fn amplitude(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return 1.0;
        }
        let (k, nu, w) = (2.0 * PI / self.length, self.viscosity / self.density, self.frequency());
        let transform = |s: Complex<f64>| {
            let q = (s / nu + k * k).sqrt();
            (s + (Complex::new(1.0, 0.0) - k / q) * (w * w) / s).inv()
        };
        inverse_laplace(transform, time)
    }
}

/// A free drop in a fluid of equal density and viscosity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OscillatingDrop {
    /// Radius at rest in m.
    pub radius: f64,
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// Density of either fluid in kg/m³.
    pub density: f64,
    /// Dynamic viscosity of either fluid in Pa s.
    pub viscosity: f64,
}

/// The elliptic mode, n = 2.
const N: f64 = 2.0;

/// A damped oscillation exp(-decay t) cos(frequency t).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damped {
    /// Angular frequency in 1/s.
    pub frequency: f64,
    /// Rate of decay in 1/s.
    pub decay: f64,
}

impl OscillatingDrop {
    /// Inviscid angular frequency of the elliptic mode in 1/s: sqrt(3 sigma/(rho R³)).
    #[must_use]
    pub fn frequency(&self) -> f64 {
        (self.tension * N * (N * N - 1.0) / (2.0 * self.density * self.radius.powi(3))).sqrt()
    }

    /// w0² (1 - 2 n I_n(q R) K_n(q R)) in 1/s², with q² = s/nu.
    fn stiffness(&self, s: Complex<f64>) -> Complex<f64> {
        let z = (s * self.density / self.viscosity).sqrt() * self.radius;
        (Complex::new(1.0, 0.0) - bessel_product(N, z) * (2.0 * N)) * self.frequency().powi(2)
    }

    /// Elongation at `time` (s) over that at time zero, from rest: the elliptic mode and the vorticity that spreads.
    ///
    /// Its Laplace transform is 1/(s + w0² (1 - 2 n I_n K_n)/s).
    #[must_use]
    pub fn elongation(&self, time: f64) -> f64 {
        if time <= 0.0 { 1.0 } else { inverse_laplace(|s| (s + self.stiffness(s) / s).inv(), time) }
    }

    /// The elliptic mode, n = 2: the root s of s² + w0² (1 - 2 n I_n(q R) K_n(q R)) = 0 with q² = s/nu and
    /// w0² = sigma n (n² - 1)/(2 rho R³); nothing where the drop creeps back without oscillating.
    #[must_use]
    pub fn elliptic_mode(&self) -> Option<Damped> {
        let rigid = self.frequency().powi(2);
        let excess = |s: Complex<f64>| s * s + self.stiffness(s);
        // The secant method from a tenth of critical damping; most drops that oscillate are near it.
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

/// I_n(z) K_n(z) of a whole `order`, Re z > 0, by the trapezoidal rule on their integrals, which converges exponentially.
fn bessel_product(order: f64, z: Complex<f64>) -> Complex<f64> {
    // Beyond 60 nodes per radian of |z| nothing changes; K needs cosh t up to 700/Re z, below t = 12 for the drops here.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_capillary_wave_of_equal_fluids_has_the_printed_amplitudes() {
        let wave = CapillaryWave { length: 1.0, tension: 1.0, density: 1.0, viscosity: 0.018_257_174_9 };
        let w = wave.frequency();
        // sqrt(4 pi³); the printed 11.13665597 is two off in its last digit.
        assert!((w - 11.136_655_97).abs() < 3e-8, "{w}");
        for (phase, expected) in [
            (1.0, 0.60738),
            (2.0, -0.16195),
            (3.0, -0.68095),
            (5.0, -0.14652),
            (8.0, 0.26836),
            (10.0, -0.33463),
            (15.0, 0.11368),
            (20.0, 0.09324),
        ] {
            // Half of the last digit printed, doubled for that of the viscosity.
            let found = wave.amplitude(phase / w);
            assert!((found - expected).abs() < 1e-5, "{phase}: {found}");
        }
        assert_eq!(wave.amplitude(0.0), 1.0);
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
            // What is not in the mode is of the order of the boundary layer, sqrt(nu w)/(w R) = 0.024.
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
