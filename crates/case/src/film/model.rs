//! A checked thin film.

use super::droplets::{FilmDroplet, FilmSymmetry};
use super::equation::FilmEquation;
use super::method::FilmMethod;
use meniscus_core::input::tables::words;

words! {
    /// The initial weight of a particle or node of a thin film.
    pub enum FilmWeights {
        /// The film of its cell: the mass is exact.
        Cell,
        /// The height at its position.
        Point,
    }
}

/// Viscosity, tension and density in scaled units: time, length and height are those of the scaled equations.
pub(super) const SCALED: (f64, f64, f64) = (1.0 / 3.0, 1.0, 1.0);

/// Droplets on the wall y = 0.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ThinFilm {
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
    /// Surface tension in N/m.
    pub tension: f64,
    /// Density in kg/m³; 0 if nothing depends on it.
    pub density: f64,
    /// Gravity towards the wall in m/s².
    pub gravity: f64,
    /// Initial distance of particles, or distance of grid nodes, in m.
    pub spacing: f64,
    /// Symmetry of the film.
    pub symmetry: FilmSymmetry,
    /// The droplets at time zero, from left to right.
    pub droplets: Vec<FilmDroplet>,
    /// The equation.
    pub equation: FilmEquation,
    /// Contact angle at rest in rad; `None` in complete wetting.
    pub contact_angle: Option<f64>,
    /// How the equation is solved.
    pub method: FilmMethod,
    /// Whether the weight of particles and nodes is the film of their cell or the height at their position.
    pub weights: FilmWeights,
}

impl ThinFilm {
    /// Whether time, length and height are those of the scaled equations.
    pub(crate) fn is_scaled(&self) -> bool {
        (self.viscosity, self.tension, self.density) == SCALED
    }

    /// Whether the droplet at rest is a parabola: on a precursor film without gravity. For the geometric equation it is a cosine.
    pub fn rests_as_cap(&self) -> bool {
        matches!(self.equation, FilmEquation::Precursor(_))
            && self.contact_angle.is_some()
            && self.gravity == 0.0
            && self.droplets.len() == 1
    }

    /// Whether the droplet spreads by the similarity solution about x = 0: a single one in the plane, completely wetting and without gravity.
    pub fn is_self_similar(&self) -> bool {
        let is_alone = matches!(&self.droplets[..], [droplet] if droplet.center == 0.0);
        self.contact_angle.is_none() && self.symmetry == FilmSymmetry::Plane && self.gravity == 0.0 && is_alone
    }

    /// Units of the scaled quantities: length along the wall and height in m, time in s. See `crates/film/src/scales.rs`.
    pub fn scales(&self) -> [f64; 3] {
        let largest = |value: fn(&FilmDroplet) -> f64| self.droplets.iter().map(value).fold(0.0, f64::max);
        let (length, height) = match self.contact_angle {
            None => (2.0 * largest(|droplet| droplet.half_width), 8.0 / 3.0 * largest(|droplet| droplet.height)),
            Some(angle) => {
                let area: f64 = self.droplets.iter().map(FilmDroplet::cross_section).sum();
                ((area / angle.tan()).sqrt(), (area * angle.tan()).sqrt())
            }
        };
        [length, height, 3.0 * self.viscosity * length / self.tension * (length / height).powi(3)]
    }
}
