//! Conversion between SI units and the scaled equation [Pang2022, Sects. 4 and 5].
//!
//! Complete wetting: h₀ = (8/3) h_max, L = 2r₀, of the highest and the widest droplet. Partial wetting: h₀ = √(A tan θ), L = √(A/tan θ) with A the
//! cross-section of all droplets, so that the scaled area and the scaled equilibrium slope are 1. Both: τ = (3μL/γ)(L/h₀)³; the paper prints tan³θ there
//! where tan⁻³θ is consistent. Bo = ρgL²/γ.

use super::droplet::Droplet;
use meniscus_case::film::{FilmDroplet, ThinFilm};

/// The unit of each scaled quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scales {
    /// Along the wall, L in m.
    pub(crate) length: f64,
    /// Normal to the wall, h₀ in m.
    pub(crate) height: f64,
    /// τ in s.
    pub(crate) time: f64,
    /// Surface tension γ in N/m.
    pub(crate) tension: f64,
    /// Bond number ρgL²/γ.
    pub(crate) bond: f64,
}

impl Scales {
    /// The scales of a case.
    pub(crate) fn of(film: &ThinFilm) -> Self {
        let [length, height, time] = film.scales();
        let bond = film.density * film.gravity * length * length / film.tension;
        Self { length, height, time, tension: film.tension, bond }
    }

    /// The scaled initial droplets.
    pub(crate) fn droplets(&self, film: &ThinFilm) -> Vec<Droplet> {
        let scaled = |droplet: &FilmDroplet| Droplet {
            area: droplet.cross_section() / self.area(),
            half_width: droplet.half_width / self.length,
            center: droplet.center / self.length,
        };
        film.droplets.iter().map(scaled).collect()
    }

    /// Slope h₀/L.
    pub(crate) fn slope(&self) -> f64 {
        self.height / self.length
    }

    /// Cross-section in m².
    pub(crate) fn area(&self) -> f64 {
        self.height * self.length
    }

    /// Velocity in m/s.
    pub(crate) fn velocity(&self) -> f64 {
        self.length / self.time
    }

    /// Curvature of a flat profile in 1/m.
    pub(crate) fn curvature(&self) -> f64 {
        self.slope() / self.length
    }

    /// Energy per depth, γh₀²/L, in J/m.
    pub(crate) fn energy(&self) -> f64 {
        self.tension * self.slope() * self.height
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_case::film::{FilmEquation, FilmGrid, FilmMethod, FilmSymmetry, FilmWeights, Geometric};

    #[test]
    fn the_scaled_droplets_are_those_of_the_paper() {
        let film = |contact_angle: Option<f64>| ThinFilm {
            viscosity: 0.01,
            tension: 0.03,
            density: 800.0,
            gravity: 9.81,
            spacing: 5.0e-6,
            symmetry: FilmSymmetry::Plane,
            droplets: vec![FilmDroplet { center: 0.0, half_width: 5.0e-4, height: 3.75e-5 }],
            equation: FilmEquation::Geometric(Geometric { smoothing_length: 5.0e-5 }),
            contact_angle,
            method: FilmMethod::FiniteDifferences(FilmGrid { step_share: 0.01 }),
            weights: FilmWeights::Cell,
        };
        let complete = film(None);
        let scales = Scales::of(&complete);
        let droplet = scales.droplets(&complete)[0];
        assert!((droplet.area - 0.25).abs() < 1.0e-14 && (droplet.half_width - 0.5).abs() < 1.0e-14);
        // 3 mu L / gamma = 1 ms, (L/h0)^3 = 1000.
        assert!((scales.time - 1.0).abs() < 1.0e-12);
        assert!((scales.bond - 800.0 * 9.81 * 1.0e-6 / 0.03).abs() < 1.0e-12);
        let partial = film(Some(0.3));
        let scales = Scales::of(&partial);
        assert!((scales.droplets(&partial)[0].area - 1.0).abs() < 1.0e-14);
        assert!((scales.slope() - 0.3_f64.tan()).abs() < 1.0e-14);
    }
}
