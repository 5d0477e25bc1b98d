//! Effect of the energy of the particle lattice on the contact angle at rest, before a run.
//!
//! Particles of weight w have an energy of w²/(24 α⁴) per length more than their film, like a wetting energy of the slope s = w/(√12 α²) of a contact angle. A
//! droplet at rest has it on its whole base: tan²θ' = tan²θ + κ s² with the weight at the highest point. Measured at rest over 0.3 ≤ s/tan θ ≤ 5 and 2 to 10
//! spacings per filter length: κ = 0.270 to 0.288.

use super::equation::{FilmEquation, Geometric};
use super::method::{FilmMethod, FilmParticles, LatticeEnergy};
use super::model::ThinFilm;

/// κ.
const SHARE_AT_REST: f64 = 2.0 / 7.0;
/// Error of the slope at rest above which a note is given.
const VISIBLE: f64 = 0.01;
/// Widest gap relative to the filter length up to which the lattice energy can be subtracted.
const WIDEST_GAP: f64 = 0.5;

impl ThinFilm {
    /// Slope of the apparent contact angle due to the particle lattice at the start; `None` on a grid, or if its energy is subtracted.
    pub(crate) fn lattice_slope(&self) -> Option<f64> {
        let FilmEquation::Geometric(Geometric { smoothing_length }) = self.equation else { return None };
        let FilmMethod::Particles(FilmParticles { lattice_energy, .. }) = self.method else { return None };
        let highest = self.droplets.iter().map(|droplet| droplet.height).fold(0.0, f64::max);
        let is_kept = lattice_energy == LatticeEnergy::Kept || self.spacing > WIDEST_GAP * smoothing_length;
        is_kept.then(|| highest * self.spacing / (12.0_f64.sqrt() * smoothing_length.powi(2)))
    }

    /// Slope at which particles are at rest, if their lattice makes it steeper than prescribed.
    pub fn slope_at_rest_on_lattice(&self) -> Option<f64> {
        let slope = self.contact_angle?.tan();
        let lattice = self.lattice_slope()?;
        Some((slope * slope + SHARE_AT_REST * lattice * lattice).sqrt())
    }

    /// The note that the particle lattice changes the contact angle at rest from the prescribed one.
    pub(super) fn lattice_note(&self) -> Option<String> {
        let (wanted, found) = (self.contact_angle?, self.slope_at_rest_on_lattice()?);
        let error = found / wanted.tan() - 1.0;
        let excess = |error: f64| (1.0 + error).powi(2) - 1.0;
        let spacing = self.spacing * (excess(VISIBLE) / excess(error)).sqrt();
        (error > VISIBLE).then(|| {
            format!(
                "the particle lattice holds the contact line back: the film comes to rest at {:.1} degrees instead of {:.1}; finite differences, or \
                 a spacing of {spacing:.1e} m, would do",
                found.atan().to_degrees(),
                wanted.to_degrees()
            )
        })
    }
}
