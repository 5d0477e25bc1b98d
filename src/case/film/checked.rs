//! A checked `[thin-film]`: every value present, in SI units and in range.

/// Viscosity, tension and density in scaled units: time, length and height are those of the scaled equations.
pub(super) const SCALED: (f64, f64, f64) = (1.0 / 3.0, 1.0, 1.0);

/// Droplets on the wall y = 0.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ThinFilm {
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
    /// Surface tension in N/m.
    pub tension: f64,
    /// Density in kg/m³; 0 where nothing depends on it.
    pub density: f64,
    /// Gravity towards the wall in m/s².
    pub gravity: f64,
    /// Initial distance of particles, or distance of grid nodes, in m.
    pub spacing: f64,
    /// The film across the plane of the picture.
    pub symmetry: FilmSymmetry,
    /// The droplets at time zero, from left to right.
    pub droplets: Vec<FilmDroplet>,
    /// The equation.
    pub equation: FilmEquation,
    /// Angle of rest in rad; absent in complete wetting.
    pub contact_angle: Option<f64>,
    /// How the equation is solved.
    pub method: FilmMethod,
    /// Whether particles and nodes hold the film of their cell (or the height at their place).
    pub weights: FilmWeights,
}

impl ThinFilm {
    /// Whether time, length and height are those of the scaled equations.
    #[must_use]
    pub fn is_scaled(&self) -> bool {
        (self.viscosity, self.tension, self.density) == SCALED
    }

    /// Whether the droplet rests as a parabola: on a precursor film without gravity. That of the geometric equation is a cosine.
    #[must_use]
    pub fn rests_as_cap(&self) -> bool {
        matches!(self.equation, FilmEquation::Precursor { .. })
            && self.contact_angle.is_some()
            && self.gravity == 0.0
            && self.droplets.len() == 1
    }

    /// Whether the droplet spreads by the similarity solution about x = 0: one in the plane, completely wetting and without gravity.
    #[must_use]
    pub fn is_self_similar(&self) -> bool {
        let is_alone = matches!(&self.droplets[..], [droplet] if droplet.center == 0.0);
        self.contact_angle.is_none() && self.symmetry == FilmSymmetry::Plane && self.gravity == 0.0 && is_alone
    }

    /// One unit of each scaled quantity: length along the wall and height in m, time in s. `src/thin_film/scales.rs` tells what they stand for.
    #[must_use]
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

impl FilmDroplet {
    /// Area in m².
    #[must_use]
    pub fn cross_section(&self) -> f64 {
        4.0 / 3.0 * self.half_width * self.height
    }
}

/// A parabolic droplet; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct FilmDroplet {
    /// Its middle.
    pub center: f64,
    /// Half of the base width.
    pub half_width: f64,
    /// Height in the middle.
    pub height: f64,
}

/// The film across the plane of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmSymmetry {
    /// The same at any depth.
    Plane,
    /// The same all around the axis x = 0.
    Axis,
}

/// Thin-film equations; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmEquation {
    /// Geometric Thin-Film Equation.
    Geometric {
        /// Filter length α.
        smoothing_length: f64,
    },
    /// Navier slip.
    Slip {
        /// Slip length.
        slip_length: f64,
        /// Height of the film on the wall that counts as dry.
        film_height: f64,
    },
    /// Precursor film.
    Precursor {
        /// Its height.
        film_height: f64,
        /// Slip length; 0 for a wall that sticks.
        slip_length: f64,
    },
}

/// Methods for thin films.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmMethod {
    /// Particles on an infinite line.
    Particles {
        /// Integration in time.
        integrator: FilmIntegrator,
        /// Largest error of a step over the initial width.
        tolerance: f64,
        /// What is done about the energy of the particle lattice.
        lattice_energy: LatticeEnergy,
        /// How the sums over particles are taken.
        sums: FilmSums,
    },
    /// Implicit finite differences: over a periodic domain for the geometric equation in the plane, else between walls.
    FiniteDifferences {
        /// Longest step over the time since the start.
        step_share: f64,
    },
}

/// Integration of the particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmIntegrator {
    /// Linearly implicit, order 4.
    Stiff,
    /// Dormand and Prince, order 5.
    Explicit,
}

/// What is done about the energy of the particle lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LatticeEnergy {
    /// Nothing.
    Kept,
    /// Its gradient is taken off the rates.
    TakenOff,
}

/// How the sums over particles are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmSums {
    /// From neighbor to neighbor.
    Recursive,
    /// Over all pairs.
    Direct,
}

/// What particles and nodes stand for at time zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmWeights {
    /// The film of their cell.
    Cell,
    /// The height at their place.
    Point,
}
