//! The keys of a case file and of a shape file, as written: all optional, nothing checked but names and types.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::film::raw::RawThinFilm;
use super::preset::Preset;
use crate::geometry::spec::{ShapeSpec, SolidSide};

/// Derives and attributes of every table of a case file or another input file.
macro_rules! tables {
    ($($(#[$outer:meta])* pub struct $name:ident { $($(#[$inner:meta])* pub $field:ident: $kind:ty,)* })*) => {$(
        $(#[$outer])*
        #[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
        pub struct $name {
            $($(#[$inner])*
            #[serde(skip_serializing_if = "Option::is_none")]
            pub $field: Option<$kind>,)*
        }
    )*};
}
pub(crate) use tables;

tables! {
    /// A case file. SI units everywhere; angles in degrees in keys that end in `-deg`, through the wetting phase.
    pub struct RawCase {
        /// Version of the format: 1.
        pub format: u32,
        /// One line that says what the case shows.
        pub title: String,
        /// Domain and solids: a shape file, or shapes written here.
        pub geometry: RawGeometry,
        /// Direct simulation by incompressible SPH.
        pub sph: RawSph,
        /// Droplets on a flat wall, by a thin-film equation.
        pub thin_film: RawThinFilm,
        /// How long the simulation runs.
        pub time: RawTime,
        /// What is written and when.
        pub output: RawOutput,
        /// Measures that must come out as said; otherwise the run ends with exit code 5.
        pub expect: Vec<RawExpectation>,
    }

    /// A shape file: domain and solids.
    pub struct RawShapeFile {
        /// Version of the format: 1.
        pub format: u32,
        /// Lower left corner of the domain in m.
        pub min: [f64; 2],
        /// Upper right corner of the domain in m.
        pub max: [f64; 2],
        /// Whether the shapes are solid (`inside`, the default) or the pore (`outside`).
        pub solid: SolidSide,
        /// The shapes; overlaps are united.
        pub shapes: Vec<ShapeSpec>,
    }

    /// Domain and solids of a case.
    pub struct RawGeometry {
        /// Shape file, relative to the case file.
        pub file: PathBuf,
        /// Lower left corner of the domain in m; with `file`, in place of the file's.
        pub min: [f64; 2],
        /// Upper right corner of the domain in m; with `file`, in place of the file's.
        pub max: [f64; 2],
        /// Whether the shapes are solid (`inside`, the default) or the pore (`outside`); not with `file`.
        pub solid: SolidSide,
        /// The shapes; overlaps are united; not with `file`.
        pub shapes: Vec<ShapeSpec>,
    }

    /// Direct simulation by incompressible SPH.
    pub struct RawSph {
        /// Initial particle spacing dx in m.
        pub spacing: f64,
        /// Smoothing length over spacing, 1 to 3 (default 1.5).
        pub smoothing_ratio: f64,
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
        /// Pressure jump across a sharp interface with fitted curvature.
        pub pressure_jump: Empty,
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
    }

    /// Wetting models, exactly one of them, and parts of the walls that differ.
    pub struct RawWetting {
        /// Unbalanced Young force at the contact line, Huber et al. 2013, Eqs. 7 and 23.
        pub young: RawContactAngle,
        /// Static angle from an advancing and a receding one, Tadmor 2004.
        pub tadmor: RawAngleWindow,
        /// Friction of the line in proportion to its speed, Brochard-Wyart and de Gennes 1992.
        pub line_friction: RawLineFriction,
        /// Molecular kinetic theory, Blake and Haynes 1969.
        pub molecular_kinetic: RawMolecularKinetic,
        /// Viscous bending between the slip length and the scale of the fit, Voinov 1976, Cox 1986.
        pub cox_voinov: RawCoxVoinov,
        /// Fit of Hoffman's data, Kistler 1993.
        pub kistler: RawContactAngle,
        /// Fit of Hoffman's data, Jiang et al. 1979.
        pub jiang: RawContactAngle,
        /// A line that holds between the receding and the advancing angle.
        pub hysteresis: RawAngleWindow,
        /// Parts of the walls with angles of their own; later ones lie over earlier ones.
        pub patches: Vec<RawWettingPatch>,
    }

    /// A static contact angle.
    pub struct RawContactAngle {
        /// Static contact angle through the wetting phase in degrees, 0 to 180.
        pub contact_angle_deg: f64,
    }

    /// Two contact angles.
    pub struct RawAngleWindow {
        /// Advancing angle through the wetting phase in degrees, 0 to 180.
        pub advancing_angle_deg: f64,
        /// Receding angle in degrees, 0 to the advancing one.
        pub receding_angle_deg: f64,
    }

    /// Line friction.
    pub struct RawLineFriction {
        /// Static contact angle through the wetting phase in degrees, 0 to 180.
        pub contact_angle_deg: f64,
        /// Friction in Pa s: tension times (cosine of the static less cosine of the dynamic angle) over the speed.
        pub friction: f64,
    }

    /// Molecular kinetic theory.
    pub struct RawMolecularKinetic {
        /// Static contact angle through the wetting phase in degrees, 0 to 180.
        pub contact_angle_deg: f64,
        /// Frequency of the jumps of molecules at rest in 1/s.
        pub frequency: f64,
        /// Length of a jump in m.
        pub jump_length: f64,
        /// Temperature in degrees Celsius (default 20).
        pub temperature_c: f64,
    }

    /// Law of Cox and Voinov.
    pub struct RawCoxVoinov {
        /// Static contact angle through the wetting phase in degrees, 0 to 180.
        pub contact_angle_deg: f64,
        /// Slip length of the liquid on its wall in m.
        pub slip_length: f64,
    }

    /// A part of the walls with angles of its own: those of the model.
    pub struct RawWettingPatch {
        /// Number of a shape of the geometry, from 0 on in the order of the file; not with `side` (default all walls).
        pub shape: u32,
        /// A side of the domain that is a wall; not with `shape`.
        pub side: RawSideName,
        /// Stripes of the wall (default all of it).
        pub stripes: RawStripes,
        /// Static contact angle in degrees, for models that have one.
        pub contact_angle_deg: f64,
        /// Advancing angle in degrees, for models that have one.
        pub advancing_angle_deg: f64,
        /// Receding angle in degrees, for models that have one.
        pub receding_angle_deg: f64,
    }

    /// Stripes of a wall.
    pub struct RawStripes {
        /// Coordinate that runs across the stripes (default `x`).
        pub along: RawAxis,
        /// Where a stripe begins, in m (default 0).
        pub start: f64,
        /// Width of a stripe in m.
        pub width: f64,
        /// From the beginning of one stripe to that of the next in m (default: a single stripe).
        pub period: f64,
    }

    /// The four sides of the domain.
    pub struct RawSides {
        /// x = min (default `wall`).
        pub left: RawSide,
        /// x = max (default `wall`).
        pub right: RawSide,
        /// y = min (default `wall`).
        pub bottom: RawSide,
        /// y = max (default `wall`).
        pub top: RawSide,
        /// Speeds of walls along themselves (default at rest).
        pub speed: RawWallSpeeds,
        /// What drives the flow through open sides, and what comes in.
        pub open: RawOpenSides,
    }

    /// The open sides: a table for each side that fluid passes through.
    pub struct RawOpenSides {
        /// Of the side at x = min.
        pub left: RawOpenSide,
        /// Of the side at x = max.
        pub right: RawOpenSide,
        /// Of the side at y = min.
        pub bottom: RawOpenSide,
        /// Of the side at y = max.
        pub top: RawOpenSide,
    }

    /// An inlet, an outlet, or a periodic side with a given flow; one of pressure, velocity and flow rate.
    pub struct RawOpenSide {
        /// Pressure at the side in Pa (inlet; outlet, default 0).
        pub pressure: f64,
        /// Mean velocity inwards in m/s (inlet, periodic).
        pub velocity: f64,
        /// Area that comes in per time in m²/s: volume per time and depth (inlet, periodic).
        pub flow_rate: f64,
        /// How the velocity is spread over the side (default `plug`).
        pub profile: RawProfile,
        /// Phase that comes in (default: what stands at the side at the start).
        pub phase: RawPhase,
    }

    /// Speeds of the walls at the sides, each along itself.
    pub struct RawWallSpeeds {
        /// Along y in m/s (default 0).
        pub left: f64,
        /// Along y in m/s (default 0).
        pub right: f64,
        /// Along x in m/s (default 0).
        pub bottom: f64,
        /// Along x in m/s (default 0).
        pub top: f64,
    }

    /// The state at time zero.
    pub struct RawInitial {
        /// The phase outside of the shapes below (default `non-wetting`).
        pub background: RawPhase,
        /// Shapes filled with the wetting phase (with the background `wetting`: with the other one).
        pub wetting: Vec<ShapeSpec>,
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
        /// Share of the density error taken back per step, 0 to 1 (default 0.02, with `pressure-jump` 0.2).
        pub drift_source: f64,
        /// Background pressure in units of tension over smoothing length, or of density times speed squared (default
        /// 0.5, without tension 0).
        pub background_pressure: f64,
        /// Particle shifting against crowding, over h times the largest speed times the step (default 0, without tension 2).
        pub shifting: f64,
        /// Largest stretch of velocity differences at walls: 10 for no slip, less lets contact lines slip (default 10,
        /// with a wetting model and no slip length 1.5: a slip length of a quarter of the spacing).
        pub wall_stretch: f64,
        /// Whether wall particles stand in layers along curved and oblique walls, and the fluid is packed to them, or all
        /// on the lattice (default true).
        pub fitted_walls: bool,
        /// Largest relative residual of the pressure solve (default 1e-6).
        pub pressure_tolerance: f64,
        /// Factor on all limits of the time step, above 0 and at most 1 (default 1).
        pub time_step_factor: f64,
    }

    /// Groups of measures.
    pub struct RawMeasures {
        /// Base and height of a drop on a straight wall.
        pub sessile_drop: Empty,
        /// Pressure jump and parasitic currents of a free drop.
        pub laplace_drop: Empty,
        /// Velocity error against plane Poiseuille flow.
        pub poiseuille: Empty,
        /// Decay rate against the Taylor-Green vortex.
        pub taylor_green: Empty,
        /// Filling angle, neck and pressure of a bridge between two discs.
        pub capillary_bridge: Empty,
        /// Curvature of the menisci between four discs.
        pub four_discs: Empty,
        /// Wetted part and height of a drop on a disc.
        pub drop_on_disc: Empty,
        /// Period and decay of a free drop that oscillates between two ellipses.
        pub oscillating_drop: Empty,
        /// Amplitude of a standing wave on a flat interface.
        pub capillary_wave: Empty,
        /// Height, speed and roundness of a bubble (the wetting phase) that rises.
        pub rising_bubble: Empty,
        /// Deformation of a drop between two moving walls.
        pub shear_drop: Empty,
        /// Velocity and flow rates of two layers between plates.
        pub layered_poiseuille: Empty,
        /// Extreme velocities on the center lines of a lid-driven cavity.
        pub cavity: Empty,
        /// Drag on the solids of a periodic cell that a body force drives fluid through.
        pub cylinder_array: Empty,
        /// Capillary pressure over the entry pressure of the throat between two discs.
        pub throat_entry: Empty,
        /// Difference of the mean levels on both sides of a plate.
        pub jurin: Empty,
        /// Angles, speeds and forces of a drop that moves or is held on a wall.
        pub moving_drop: Empty,
        /// Exponent of the width of a drop that spreads.
        pub spreading: Empty,
        /// Filled length of a slit between two open sides.
        pub slit_filling: Empty,
        /// Height of the meniscus that rises from an open side.
        pub capillary_rise: Empty,
    }

    /// How long the simulation runs.
    pub struct RawTime {
        /// End of the simulation in s.
        pub end: f64,
    }

    /// What is written and when.
    pub struct RawOutput {
        /// Particle, grid and interface files (default: 50 records).
        pub vtk: RawEvery,
        /// Rows of series.csv (default: 200 records).
        pub series: RawEvery,
        /// The regular grid.
        pub grid: RawGrid,
        /// Files to resume from (default: 10 records).
        pub restart: RawEvery,
    }

    /// A schedule.
    pub struct RawEvery {
        /// Time between records in s.
        pub every_time: f64,
    }

    /// The regular grid of the output.
    pub struct RawGrid {
        /// Distance of grid nodes over the particle spacing (default 1).
        pub ratio: f64,
    }

    /// A measure that must come out as said.
    pub struct RawExpectation {
        /// Name of a measure, such as `contact-angle-deg`.
        pub measure: String,
        /// Expected value in the measure's unit.
        pub value: f64,
        /// Largest accepted deviation, same unit.
        pub tolerance: f64,
    }
}

/// A table without keys: its name says all.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Empty {}

/// A phase.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawPhase {
    /// The phase through which angles are measured.
    Wetting,
    /// The other phase.
    NonWetting,
}

/// What stands at a side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawSide {
    /// Joined to the opposite side.
    Periodic,
    /// A solid no-slip wall; contact lines may stand on it.
    Wall,
    /// A no-slip wall by image particles; no contact angle is set on it.
    Image,
    /// A mirror: free slip.
    Symmetry,
    /// Open, with a velocity, a flow rate or a pressure.
    Inlet,
    /// Open, with a pressure.
    Outlet,
}

/// A side by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawSideName {
    /// x = min.
    Left,
    /// x = max.
    Right,
    /// y = min.
    Bottom,
    /// y = max.
    Top,
}

/// An axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawAxis {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
}

/// How the velocity of an inlet is spread over its side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawProfile {
    /// The same everywhere.
    Plug,
    /// A parabola that vanishes at walls.
    Parabolic,
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
