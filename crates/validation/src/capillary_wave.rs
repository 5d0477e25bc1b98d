//! A standing wave on a flat interface (B4 of the benchmarks), compared with the linear viscous solution.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::series::pairs;
use super::waves::inverse_laplace;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::flow::Flow;
use meniscus_sph::measures::{Columns, Subject};
use meniscus_sph::observe::Observation;
use meniscus_sph::particles::Phase;

/// A standing wave on the flat interface of two equal fluids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CapillaryWave {
    /// Wavelength in m.
    pub(crate) length: f64,
    /// Interfacial tension in N/m.
    pub(crate) tension: f64,
    /// Density of either fluid in kg/m³.
    pub(crate) density: f64,
    /// Dynamic viscosity of either fluid in Pa s.
    pub(crate) viscosity: f64,
}

impl CapillaryWave {
    /// Inviscid angular frequency in 1/s: sqrt(sigma k³/(2 rho)).
    pub(crate) fn frequency(&self) -> f64 {
        let k = TAU / self.length;
        (self.tension * k.powi(3) / (2.0 * self.density)).sqrt()
    }

    /// Amplitude of a capillary wave at `time` (s) relative to that at time zero, from rest, for equal fluids \[Prosperetti1981\].
    ///
    /// Its Laplace transform is 1/(s + w² (1 - k/sqrt(k² + s/nu))/s).
    pub(crate) fn amplitude(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return 1.0;
        }
        let (k, nu, w) = (TAU / self.length, self.viscosity / self.density, self.frequency());
        let transform = |s: Complex<f64>| {
            let q = (s / nu + k * k).sqrt();
            (s + (Complex::new(1.0, 0.0) - k / q) * (w * w) / s).inv()
        };
        inverse_laplace(transform, time)
    }
}

/// Amplitude in m of the first Fourier mode along x of the area of the wetting phase, with the crest in the middle of the box.
pub(super) fn columns(flow: &Flow, _: &Observation) -> Columns {
    let (bounds, fluids) = (flow.config.domain.bounds, flow.state.particles.fluids);
    let length = bounds.size().x;
    let mode = |a: usize| {
        let x = flow.state.particles.position[a].x - bounds.center().x;
        flow.fields.bulk.volume[a] * (TAU * x / length).cos()
    };
    let wetting = (0..fluids).filter(|&a| flow.state.particles.phase[a] == Phase::Wetting);
    vec![("wave_amplitude_m", 2.0 / length * wetting.map(mode).sum::<f64>())]
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let m = &s.flow.config.method;
    let wave = CapillaryWave {
        length: s.flow.config.domain.bounds.size().x,
        tension: m.tension,
        density: m.wetting_fluid.density,
        viscosity: m.wetting_fluid.viscosity,
    };
    let (times, values) = pairs(s.series, "wave_amplitude_m");
    let start = values.first().copied().unwrap_or(f64::NAN);
    let squares: f64 = times.iter().zip(&values).map(|(&t, a)| (a / start - wave.amplitude(t)).powi(2)).sum();
    let equal = m.wetting_fluid == m.other_fluid;
    let error = if equal { (squares / times.len() as f64).sqrt() } else { f64::NAN };
    let method = "root mean square over the records of amplitude over first amplitude less the linear viscous solution for equal fluids";
    vec![measure("wave-rms-error", error, "").by(method)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Prosperetti1981]
    #[test]
    fn the_capillary_wave_of_equal_fluids_has_the_printed_amplitudes() {
        let wave = CapillaryWave { length: 1.0, tension: 1.0, density: 1.0, viscosity: 0.018_257_174_9 };
        let w = wave.frequency();
        // sqrt(4 pi³); the printed 11.13665597 is off by two in its last digit.
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
            // Half a unit in the last printed digit, doubled for the rounding of the viscosity.
            let found = wave.amplitude(phase / w);
            assert!((found - expected).abs() < 1e-5, "{phase}: {found}");
        }
        assert_eq!(wave.amplitude(0.0), 1.0);
    }
}
