//! The keys of `[thin-film]` as written: all optional, nothing checked but names and types.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::raw::{Empty, RawFluid, tables};

tables! {
    /// Droplets that spread on the wall y = 0, by a thin-film equation (Pang and O Naraigh 2022).
    pub struct RawThinFilm {
        /// The liquid; its density is needed with gravity only.
        pub fluid: RawFluid,
        /// Surface tension in N/m (default: that of the preset).
        pub tension: f64,
        /// Gravity towards the wall in m/s², negative for hanging droplets; capillary length at least 2 spacings
        /// (default 0).
        pub gravity: f64,
        /// Initial distance of particles or nodes in m: at least 10 per half width, at most 1e7 on the wall.
        pub spacing: f64,
        /// Plane film, or axisymmetric about x = 0 (default `plane`).
        pub symmetry: RawFilmSymmetry,
        /// Initial droplets: parabolas without overlap.
        pub droplets: Vec<RawDroplet>,
        /// Exactly one equation.
        pub equation: RawFilmEquation,
        /// At most one wetting model (default `complete`).
        pub wetting: RawFilmWetting,
        /// At most one method (default `particles` for the geometric equation in complete wetting in the plane, else
        /// `finite-differences`).
        pub method: RawFilmMethod,
        /// Particles and nodes represent the film of their cell, or the height at their position (default `cell`).
        pub weights: RawFilmWeights,
    }

    /// A droplet with a parabolic profile.
    pub struct RawDroplet {
        /// Center in m; 0 about an axis (default 0).
        pub center: f64,
        /// Half of the initial base width in m.
        pub half_width: f64,
        /// Initial central height in m: 1e-6 to 5 half widths, in scaled units to 1000.
        pub height: f64,
    }

    /// Thin-film equations.
    pub struct RawFilmEquation {
        /// Geometric thin-film equation with a smoothed film (Pang and Ó Náraigh 2022).
        pub geometric: RawGeometric,
        /// Navier slip on the wall; complete wetting only.
        pub slip: RawSlip,
        /// Precursor film on the wall.
        pub precursor: RawPrecursor,
    }

    /// The Geometric Thin-Film Equation.
    pub struct RawGeometric {
        /// Filter length `α` in m: at least 1 spacing, with particles 2, at most 0.4 half widths; on a grid at most 1000 spacings.
        pub smoothing_length: f64,
    }

    /// The thin-film equation with slip.
    pub struct RawSlip {
        /// Slip length `λ` in m, at most half of the droplet height.
        pub slip_length: f64,
        /// Film height in m that counts as dry, 1e-6 to 0.2 of the droplet height (default: a tenth of the slip
        /// length).
        pub film_height: f64,
    }

    /// The thin-film equation with a precursor film.
    pub struct RawPrecursor {
        /// Film height in m, 1e-6 to 0.2 of the droplet height.
        pub film_height: f64,
        /// Slip length `λ` in m, at most half of the droplet height (default: no slip).
        pub slip_length: f64,
    }

    /// Wetting models of thin films.
    pub struct RawFilmWetting {
        /// The film spreads without end.
        pub complete: Empty,
        /// The film comes to rest at a contact angle.
        pub partial: RawPartialWetting,
    }

    /// Partial wetting of a thin film.
    pub struct RawPartialWetting {
        /// Static contact angle in degrees; the droplet at rest must fit the domain.
        pub contact_angle_deg: f64,
    }

    /// Methods for thin films.
    pub struct RawFilmMethod {
        /// Particles on an infinite line, for the geometric equation in the plane.
        pub particles: RawFilmParticles,
        /// Implicit finite differences, for every equation.
        pub finite_differences: RawFilmGrid,
    }

    /// The particle method.
    pub struct RawFilmParticles {
        /// Implicit of order 4, or Dormand and Prince of order 5 (default `stiff`).
        pub integrator: RawFilmIntegrator,
        /// Largest error of a step over the initial width (default 1e-7).
        pub tolerance: f64,
        /// Keeps or subtracts the energy of the particle lattice (default `kept`).
        pub lattice_energy: RawLatticeEnergy,
        /// Sums over particles in linear time, or over all pairs for comparison (default `recursive`).
        pub sums: RawFilmSums,
    }

    /// The finite-difference method.
    pub struct RawFilmGrid {
        /// Longest step over the time since the start (default 0.005).
        pub step_share: f64,
    }
}

/// The film across the plane of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawFilmSymmetry {
    /// The same at any depth.
    Plane,
    /// The same all around the axis x = 0.
    Axis,
}

/// What a particle or node of a thin film stands for at time zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawFilmWeights {
    /// The film of its cell: the mass is exact.
    Cell,
    /// The height at its place.
    Point,
}

/// Integration of the particles of a thin film.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawFilmIntegrator {
    /// Linearly implicit, order 4: steps as long as the solution allows.
    Stiff,
    /// Dormand and Prince, order 5: steps as short as stability wants.
    Explicit,
}

/// What is done about the energy of the particle lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawLatticeEnergy {
    /// Nothing, as in the paper.
    Kept,
    /// Its gradient is taken off: not in the paper, order 4 where gaps stay below half a filter length.
    TakenOff,
}

/// How the sums over the particles of a thin film are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawFilmSums {
    /// From neighbor to neighbor, in a time in proportion to their number.
    Recursive,
    /// Over all pairs, to compare with: the time goes as the square of the number.
    Direct,
}
