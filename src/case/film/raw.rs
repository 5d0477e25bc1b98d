//! The keys of `[thin-film]` as written: all optional, nothing checked but names and types.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::raw::{Empty, RawFluid, tables};

tables! {
    /// Droplets that spread on the wall y = 0, by a thin-film equation (Pang and O Naraigh 2022).
    pub struct RawThinFilm {
        /// The liquid; without it and `tension` the case is in scaled units: 3 mu = gamma = rho = 1.
        pub fluid: RawFluid,
        /// Surface tension in N/m (default that of the preset).
        pub tension: f64,
        /// Gravity towards the wall in m/s², below 0 for a wall that droplets hang from (default 0).
        pub gravity: f64,
        /// Initial distance of particles, or distance of grid nodes, in m.
        pub spacing: f64,
        /// The film across the plane of the picture (default `plane`).
        pub symmetry: RawFilmSymmetry,
        /// The droplets at time zero.
        pub droplets: Vec<RawDroplet>,
        /// The equation, how it makes contact lines move: one table whose name is the model.
        pub equation: RawFilmEquation,
        /// How the film wets the wall: one table whose name is the model (default `complete`).
        pub wetting: RawFilmWetting,
        /// How the equation is solved: one table whose name is the method (default `particles` where they can be).
        pub method: RawFilmMethod,
        /// What a particle or node stands for at time zero (default `cell`).
        pub weights: RawFilmWeights,
    }

    /// A droplet with a parabolic profile.
    pub struct RawDroplet {
        /// Its middle in m (default 0).
        pub center: f64,
        /// Half of the base width in m.
        pub half_width: f64,
        /// Height in the middle in m.
        pub height: f64,
    }

    /// Thin-film equations.
    pub struct RawFilmEquation {
        /// Geometric Thin-Film Equation: the film is smoothed.
        pub geometric: RawGeometric,
        /// Navier slip on the wall, for complete wetting.
        pub slip: RawSlip,
        /// A film that covers the wall.
        pub precursor: RawPrecursor,
    }

    /// The Geometric Thin-Film Equation.
    pub struct RawGeometric {
        /// Filter length alpha in m: film and contact line are smoothed over it.
        pub smoothing_length: f64,
    }

    /// The thin-film equation with slip.
    pub struct RawSlip {
        /// Slip length in m.
        pub slip_length: f64,
        /// Height in m of the film on the wall that counts as dry (default a tenth of the slip length).
        pub film_height: f64,
    }

    /// The thin-film equation with a precursor film.
    pub struct RawPrecursor {
        /// Height of the film in m.
        pub film_height: f64,
        /// Slip length in m (default: the wall sticks).
        pub slip_length: f64,
    }

    /// Wetting models of thin films.
    pub struct RawFilmWetting {
        /// The film spreads for ever.
        pub complete: Empty,
        /// The film comes to rest at a contact angle.
        pub partial: RawPartialWetting,
    }

    /// Partial wetting of a thin film.
    pub struct RawPartialWetting {
        /// Angle at which a droplet rests, in degrees, 0.1 to 45.
        pub contact_angle_deg: f64,
    }

    /// Methods for thin films.
    pub struct RawFilmMethod {
        /// Particles that carry the film, on an infinite line; for the geometric equation in the plane.
        pub particles: RawFilmParticles,
        /// Implicit finite differences.
        pub finite_differences: RawFilmGrid,
    }

    /// The particle method.
    pub struct RawFilmParticles {
        /// Integration in time (default `stiff`).
        pub integrator: RawFilmIntegrator,
        /// Largest error of a step over the initial width (default 1e-7).
        pub tolerance: f64,
        /// The energy of the particle lattice: `kept` as in the paper (default), or `taken-off`.
        pub lattice_energy: RawLatticeEnergy,
        /// How the sums over particles are taken (default `recursive`).
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
    /// ESDIRK34 of the library diffsol.
    DiffsolStiff,
    /// Tsit45 of the library diffsol.
    DiffsolExplicit,
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
