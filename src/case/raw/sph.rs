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
        /// Initial particle spacing dx in m.
        pub spacing: f64,
        /// Smoothing length over spacing, 1 to 3 (default 1.5).
        pub smoothing_ratio: f64,
        /// The length L of the dimensionless numbers in m (default of the narrowest throat, of the drop, or of the gap).
        pub reference_length: f64,
        /// Body force per mass along x and y in m/s² (default none).
        pub gravity: [f64; 2],
        /// The one or two fluids.
        pub phases: RawPhases,
        /// Interface between the fluids.
        pub interface: RawInterface,
        /// Form of the surface force: one table whose name is the model (default `pressure-jump`).
        pub surface_force: RawSurfaceForce,
        /// Wetting model: one table whose name is the model (default none).
        pub wetting: RawWetting,
        /// What stands at the four sides of the domain (default walls).
        pub sides: RawSides,
        /// What all walls are like.
        pub walls: RawWalls,
        /// Which phase is where at the start, and how it moves.
        pub initial: RawInitial,
        /// Parameters of the method that rarely need a change.
        pub numerics: RawNumerics,
        /// Groups of measures for the report: one empty table each.
        pub measure: RawMeasures,
    }

    /// The fluids.
    pub struct RawPhases {
        /// The phase through which contact angles are measured.
        pub wetting: RawFluid,
        /// The other phase; absent in single-phase flow.
        pub non_wetting: RawFluid,
    }

    /// A Newtonian fluid, by name or by its properties; a property given beside a name wins.
    pub struct RawFluid {
        /// A fluid with known properties.
        pub preset: Preset,
        /// Temperature of the preset in degrees Celsius, 20 to 25 (default 20).
        pub temperature_c: f64,
        /// Density in kg/m³.
        pub density: f64,
        /// Dynamic viscosity in Pa s.
        pub viscosity: f64,
    }

    /// The interface between the fluids.
    pub struct RawInterface {
        /// Interfacial tension in N/m.
        pub tension: f64,
    }

    /// Forms of the surface force.
    pub struct RawSurfaceForce {
        /// Continuum surface force, Huber et al. 2013, Eq. 20.
        pub csf: RawCsf,
        /// Pressure jump across a sharp interface.
        pub pressure_jump: RawPressureJump,
    }

    /// The pressure jump.
    pub struct RawPressureJump {
        /// Curvature in 1/m of all interfaces, positive where the wetting phase is convex, for tests of all but the fits (default fitted).
        pub curvature: f64,
    }

    /// The continuum surface force.
    pub struct RawCsf {
        /// How the force of a contact line is spread over particles: so that each line has its whole force (`normalized`, the
        /// default), or by a form of each particle alone (`local`).
        pub line_delta: RawLineDelta,
    }

    /// What all walls are like, those of shapes and those at the sides.
    pub struct RawWalls {
        /// Navier's slip length in m: on the wall, the velocity along it is this length times its slope (default 0).
        pub slip_length: f64,
        /// The same near contact lines, in m (default `slip-length`; where that is not given, one spacing).
        pub line_slip_length: f64,
    }

    /// The state at time zero.
    pub struct RawInitial {
        /// The phase outside of the shapes below (default `non-wetting`).
        pub background: RawPhase,
        /// Shapes filled with the wetting phase (with the background `wetting`: with the other one).
        pub wetting: Vec<ShapeSpec>,
        /// State of a network that says which phase is where, relative to the case file (in place of `background` and `wetting`).
        pub network: PathBuf,
        /// Velocity: one key whose name is the field (default `rest`).
        pub velocity: RawVelocity,
    }

    /// Initial velocity fields; exactly one of them.
    pub struct RawVelocity {
        /// No motion.
        pub rest: Empty,
        /// The same velocity everywhere, in m/s.
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
        /// How viscosity goes on in time (default `implicit`).
        pub viscous_step: RawViscousStep,
        /// Largest share of the density error taken back per step by the velocities, 0 to 1 (default 0.2, with `csf` 0.02, without tension 0).
        pub drift_source: f64,
        /// Share of the density error taken back per step by moving particles without their velocities, 0 to 1 (default 0, without tension 0.2).
        pub drift_correction: f64,
        /// Background pressure in units of tension over smoothing length, or of density times speed squared (default
        /// 0, with `csf` 0.5).
        pub background_pressure: f64,
        /// Particle shifting against uneven density, over h times the largest speed times the step (default 2, with `csf` 0).
        pub shifting: f64,
        /// Strength of the push at short range in the shifting, from 0 (none) to 1 (default 0.2 with the pressure jump, else 0).
        pub short_range_push: f64,
        /// Largest stretch of velocity differences at walls: 10 for no slip, less lets the fluid slip (default 10; 1.5 is a slip
        /// length of a quarter of the spacing).
        pub wall_stretch: f64,
        /// Whether wall particles stand in layers along curved and oblique walls, and the fluid is packed to them (default true);
        /// else they stand on the lattice.
        pub fitted_walls: bool,
        /// Whether the first particles on both sides of the initial interface stand in layers along it, and the fluid is packed to them
        /// (default true with the pressure jump, else false).
        pub fitted_interface: bool,
        /// Largest relative residual of the pressure solve (default 1e-6).
        pub pressure_tolerance: f64,
        /// Factor on all limits of the time step, above 0 and at most 10 (default 1).
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
