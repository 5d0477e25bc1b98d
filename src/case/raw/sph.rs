//! `[sph]`: direct simulation, its fluids, walls, initial state and parameters.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Empty, RawMeasures, RawSides, RawWetting};
use crate::case::preset::Preset;
use crate::geometry::spec::ShapeSpec;

tables! {
    /// Direct simulation by incompressible SPH.
    pub struct RawSph {
        /// Initial particle spacing `dx` in m: at least 10 across the domain, 5 across the narrowest throat; at most
        /// 2e7 particles, and no more than the free memory holds (1.6 kB each).
        pub spacing: f64,
        /// Smoothing length over spacing, `h/dx` (default 1.5).
        pub smoothing_ratio: f64,
        /// Length of the dimensionless numbers in m (default: the shorter of narrowest throat and root of the drop
        /// area; else the shorter side).
        pub reference_length: f64,
        /// Body force per mass along x and y in m/s² (default `[0.0, 0.0]`).
        pub gravity: [f64; 2],
        /// The one or two fluids.
        pub phases: RawPhases,
        /// Interface between the fluids.
        pub interface: RawInterface,
        /// Model of the surface force, one table (default `pressure-jump`).
        pub surface_force: RawSurfaceForce,
        /// Wetting model, one table (default: none).
        pub wetting: RawWetting,
        /// The four sides of the domain (default: walls).
        pub sides: RawSides,
        /// Slip of all walls, those of shapes and those at the sides.
        pub walls: RawWalls,
        /// Phases and velocity at time zero.
        pub initial: RawInitial,
        /// Parameters of the method, which rarely need a change.
        pub numerics: RawNumerics,
        /// Groups of measures for the report, one empty table each.
        pub measure: RawMeasures,
    }

    /// The fluids.
    pub struct RawPhases {
        /// Phase through which contact angles are measured.
        pub wetting: RawFluid,
        /// The other phase.
        pub non_wetting: RawFluid,
    }

    /// A Newtonian fluid, by name or by its properties; a property given beside a name wins.
    pub struct RawFluid {
        /// Fluid with known properties.
        pub preset: Preset,
        /// Temperature of the preset in °C (default 20).
        pub temperature_c: f64,
        /// Density in kg/m³; the density ratio is 1e-4 to 1e4 (default: that of the preset).
        pub density: f64,
        /// Dynamic viscosity in Pa s (default: that of the preset).
        pub viscosity: f64,
    }

    /// The interface between the fluids.
    pub struct RawInterface {
        /// Interfacial tension in N/m; above 0 in a network (required with two fluids).
        pub tension: f64,
    }

    /// Forms of the surface force.
    pub struct RawSurfaceForce {
        /// Continuum surface force with contact line force (Huber et al. 2013, Eqs. 20 and 23).
        pub csf: RawCsf,
        /// Pressure jump across a sharp interface with fitted curvature; the default model.
        pub pressure_jump: RawPressureJump,
    }

    /// The pressure jump.
    pub struct RawPressureJump {
        /// For tests: curvature of all interfaces in 1/m, positive where the wetting phase is convex; contact angles
        /// are then ignored (default: fitted).
        pub curvature: f64,
    }

    /// The continuum surface force.
    pub struct RawCsf {
        /// Line force normalized along each contact line (Eqs. 21 and 22), or in closed form per particle (default
        /// `normalized`).
        pub line_delta: RawLineDelta,
    }

    /// What all walls are like, those of shapes and those at the sides.
    pub struct RawWalls {
        /// Navier slip length of all walls in m (default 0.0).
        pub slip_length: f64,
        /// Slip length near contact lines in m; needs a wetting model (default: `slip-length`, else one spacing).
        pub line_slip_length: f64,
    }

    /// The state at time zero.
    pub struct RawInitial {
        /// Phase outside of the shapes (default `non-wetting`).
        pub background: RawPhase,
        /// Shapes filled with the phase that is not the background; each holds a particle of the pore (required with
        /// two fluids).
        pub wetting: Vec<ShapeSpec>,
        /// File with the state of a network of the same geometry, in place of `background` and `wetting`.
        pub network: PathBuf,
        /// Initial velocity: at most one field (default `rest`).
        pub velocity: RawVelocity,
    }

    /// Initial velocity fields; exactly one of them.
    pub struct RawVelocity {
        /// No motion.
        pub rest: Empty,
        /// Uniform velocity in m/s.
        pub uniform: [f64; 2],
        /// Taylor-Green vortices, one period per domain.
        pub taylor_green: RawTaylorGreen,
    }

    /// Taylor-Green vortices.
    pub struct RawTaylorGreen {
        /// Largest speed in m/s.
        pub speed: f64,
    }

    /// Parameters of the method.
    pub struct RawNumerics {
        /// Form of the viscous term (default `stress`).
        pub viscous_term: RawViscousTerm,
        /// Viscous force from the velocity at the end or the beginning of the step (default `implicit`).
        pub viscous_step: RawViscousStep,
        /// Density-error correction in the pressure equation: largest share of the error removed per step (default 0.2;
        /// with `csf` 0.02; without tension 0).
        pub density_error_correction: f64,
        /// Density-error correction by particle shifting: share of the error removed per step (default 0; without
        /// tension 0.2).
        pub density_error_shifting: f64,
        /// Background pressure over `σ/h`, or over `ρ v²` without tension (default 0; with `csf` 0.5).
        pub background_pressure: f64,
        /// Strength of particle shifting (default 2; with `csf` 0).
        pub shifting: f64,
        /// Strength of the anti-clustering force in particle shifting (default 0.2; with `csf` or without tension 0).
        pub anti_clustering: f64,
        /// Largest stretch `β` of velocity differences at walls; sets the slip without a slip length (default 10.0).
        pub wall_stretch: f64,
        /// Wall particles follow walls that the lattice does not fit (default true).
        pub fitted_walls: bool,
        /// Particles follow the initial interface where the lattice does not fit it (default true; with `csf` or
        /// without tension false).
        pub fitted_interface: bool,
        /// Largest relative residual of the pressure solve (default 1e-6).
        pub pressure_tolerance: f64,
        /// Factor on all limits of the time step; of that by velocity up to a Courant number of 0.3 (default 1).
        pub time_step_factor: f64,
    }
}

/// A phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawPhase {
    /// The phase through which angles are measured.
    Wetting,
    /// The other phase.
    NonWetting,
}

/// Forms of the contact line delta.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawLineDelta {
    /// Huber et al. 2013, Eqs. 21 and 22, line by line.
    Normalized,
    /// In closed form, particle by particle.
    Local,
}

/// How viscosity goes on in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawViscousStep {
    /// By the velocity at the end of the step: no limit of the time step.
    Implicit,
    /// By the velocity at its beginning: steps are short where the fluid is thick or the spacing fine.
    Explicit,
}

/// Forms of the viscous term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawViscousTerm {
    /// Szewc et al. 2012; Huber et al. 2013, Eq. 16.
    Szewc,
    /// Morris et al. 1997 with the harmonic mean of the viscosities.
    Morris,
    /// The same with the transposed velocity gradient where the viscosity changes.
    Stress,
}
