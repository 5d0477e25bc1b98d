//! A checked case: every value present, in SI units and in range. Made by `case::load`, read by set-up code only.

use super::film::checked::ThinFilm;
pub use super::measures::MeasureSet;
use super::network::checked::PoreNetwork;
use super::network::state::Start;
pub use super::patches::{PatchedWall, Stripes, WettingPatch};
pub use super::steady::{FEWEST_ROWS, SteadyStop};
use crate::geometry::spec::{GeometrySpec, ShapeSpec};
use crate::math::Vec2;
use crate::wetting::Wetting;

/// A case that can be run.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Case {
    /// One line that says what the case shows.
    pub title: String,
    /// Domain and solids.
    pub geometry: GeometrySpec,
    /// The model that solves it.
    pub model: Model,
    /// End of the simulation in s; of a network the most that it can displace, in pore volumes.
    pub end: f64,
    /// When the run counts as steady, and whether it then ends (`[time.steady]`); absent: it goes on to its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steady: Option<SteadyStop>,
    /// What is written and when.
    pub output: Output,
    /// What the run must give.
    pub expect: Vec<Expectation>,
}

/// The models.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Direct simulation by incompressible SPH.
    Sph(Box<Sph>),
    /// Droplets on a flat wall by a thin-film equation (`[thin-film]`).
    ThinFilm(Box<ThinFilm>),
    /// A pore network and a quasi-static displacement in it (`[network]`).
    Network(Box<PoreNetwork>),
}

/// Direct simulation by incompressible SPH (`[sph]`).
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Sph {
    /// Initial particle spacing dx in m.
    pub spacing: f64,
    /// Smoothing length over spacing, h/dx.
    pub smoothing_ratio: f64,
    /// The phase through which angles are measured, color 1.
    pub wetting: Fluid,
    /// The other phase, color 0; absent in single-phase flow.
    pub non_wetting: Option<Fluid>,
    /// Interfacial tension in N/m; 0 in single-phase flow.
    pub tension: f64,
    /// Form of the surface force; absent where the tension is 0.
    pub surface_force: Option<SurfaceForce>,
    /// Wetting model; absent: no line force.
    pub wetting_model: Option<Wetting>,
    /// Parts of the walls with angles of their own.
    pub wetting_patches: Vec<WettingPatch>,
    /// The length L of the dimensionless numbers in m, where the case gives one.
    pub reference_length: Option<f64>,
    /// Body force per mass in m/s².
    pub gravity: Vec2,
    /// What stands at the four sides of the domain.
    pub sides: Sides,
    /// What all walls are like.
    pub walls: Walls,
    /// Speeds in m/s of the walls at the left, right, bottom and top side, along x or y.
    pub wall_speeds: [f64; 4],
    /// What drives the flow through the left, right, bottom and top side, where it is open or periodic with a given flow.
    pub open: [Option<Open>; 4],
    /// Initial phases and velocity.
    pub initial: Initial,
    /// Parameters of the method with a default that rarely needs a change (`[sph.numerics]`).
    pub numerics: Numerics,
    /// What the report measures beyond what every run has (`[sph.measure]`).
    pub measure: MeasureSet,
}

impl Sph {
    /// The tension in N/m of an interface that moves; 0 where it is frozen.
    #[must_use]
    pub fn acting_tension(&self) -> f64 {
        if self.measure.relative_permeability { 0.0 } else { self.tension }
    }

    /// Whether contact lines slip by a spacing, with an angle that does not make up for it.
    #[must_use]
    pub fn has_lines_that_slip_by_a_spacing(&self) -> bool {
        let law = self.wetting_model.filter(|law| !matches!(law, Wetting::Cox(_) | Wetting::CoxVoinov(_)));
        law.is_some()
            && self.acting_tension() > 0.0
            && self.walls.line_slip_length == self.spacing
            && self.walls.slip_length == 0.0
    }
}

/// A Newtonian fluid.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Fluid {
    /// Density in kg/m³.
    pub density: f64,
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
}

/// Forms of the surface force.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceForce {
    /// Continuum surface force [Huber2013, Eq. 20].
    Csf {
        /// How the force of a contact line is spread.
        line_delta: LineDelta,
    },
    /// Pressure jump across a sharp interface.
    PressureJump {
        /// Curvature in 1/m of all interfaces, fitted where there is none.
        curvature: Option<f64>,
    },
}

/// Forms of the contact line delta [Huber2013, Eq. 21].
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LineDelta {
    /// So that each line has its whole force.
    Normalized,
    /// By a form of each particle alone.
    Local,
}

/// One side of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// Joined to the opposite side.
    Periodic,
    /// A solid no-slip wall of wall particles; contact lines may stand on it.
    Wall,
    /// A no-slip wall by image particles [Huber2013, Eqs. 32-34]; no contact angle is set on it.
    Image,
    /// A mirror: free slip.
    Symmetry,
    /// Open, with a velocity, a flow rate or a pressure.
    Inlet,
    /// Open, with a pressure.
    Outlet,
}

/// What drives the flow through an open side, and what comes in.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Open {
    /// What is given at the side.
    pub drive: Drive,
    /// Whether the phase that comes in is the wetting one; absent: what stands at the side at the start.
    pub enters_wetting: Option<bool>,
    /// How a given pressure rises in steps.
    pub pressure_steps: Option<PressureSteps>,
}

/// A pressure that rises in equal steps.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct PressureSteps {
    /// Height of a step in Pa.
    pub rise: f64,
    /// Time for which each pressure is held in s.
    pub every_time: f64,
}

/// What is given at an open side.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Drive {
    /// A pressure in Pa.
    Pressure(f64),
    /// The mean velocity inwards in m/s.
    Velocity(f64, Profile),
    /// The area that comes in per time in m²/s.
    FlowRate(f64, Profile),
}

/// How the velocity of an inlet is spread over its side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Profile {
    /// The same everywhere.
    Plug,
    /// A parabola that vanishes at walls.
    Parabolic,
}

/// Names of the sides in the order of their numbers.
pub const SIDES: [&str; 4] = ["left", "right", "bottom", "top"];

/// The four sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct Sides {
    /// x = min.
    pub left: Side,
    /// x = max.
    pub right: Side,
    /// y = min.
    pub bottom: Side,
    /// y = max.
    pub top: Side,
}

/// Initial state.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Initial {
    /// The wetting phase is the union of these shapes (`[[sph.initial.wetting]]`) ...
    pub wetting: Vec<ShapeSpec>,
    /// ... or, where true, all that is outside of them (`sph.initial.background = "wetting"`).
    pub wetting_is_background: bool,
    /// The state of a network that says it instead (`sph.initial.network`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub network: Option<Start>,
    /// Initial velocity.
    pub velocity: InitialVelocity,
}

/// Initial velocity fields.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum InitialVelocity {
    /// At rest.
    Rest,
    /// The same velocity everywhere, in m/s.
    Uniform(Vec2),
    /// Taylor-Green vortices of the given speed in m/s, one period per domain.
    TaylorGreen(f64),
}

/// What all walls are like, those of shapes and those at the sides.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Walls {
    /// Navier's slip length in m.
    pub slip_length: f64,
    /// The same near contact lines.
    pub line_slip_length: f64,
}

/// Discretization choices and solver tolerances.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Numerics {
    /// Form of the viscous term.
    pub viscous_term: ViscousTerm,
    /// How viscosity goes on in time.
    pub viscous_step: ViscousStep,
    /// Largest share of the density error removed per step by the pressure equation, gamma, 0 to 1.
    pub density_error_correction: f64,
    /// Share of the density error taken back per step by moving particles, their velocities left as they are.
    pub density_error_shifting: f64,
    /// Background pressure in units of sigma/h (or of rho v² without tension), at least 0.
    pub background_pressure: f64,
    /// Particle shifting: A in δr = −A h v_max Δt ∇C, at least 0.
    pub shifting: f64,
    /// Strength R of the anti-clustering force in particle shifting, 0 to 1.
    pub anti_clustering: f64,
    /// Largest stretch β of velocity differences at walls, at least 1: 10 is no slip, 1.5 slips by a quarter of dx everywhere.
    pub wall_stretch: f64,
    /// Whether wall particles follow walls that the lattice does not fit.
    pub fitted_walls: bool,
    /// Whether particles follow the initial interface where the lattice does not fit it.
    pub fitted_interface: bool,
    /// Largest relative residual of the pressure solve.
    pub pressure_tolerance: f64,
    /// Factor on all limits of the time step, above 0 and at most 10.
    pub time_step_factor: f64,
}

/// How viscosity goes on in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ViscousStep {
    /// By the velocity at the end of the step.
    Implicit,
    /// By the velocity at its beginning.
    Explicit,
}

/// Forms of the viscous term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ViscousTerm {
    /// Szewc et al. 2012 [Huber2013, Eq. 16].
    Szewc,
    /// Morris et al. 1997 with the harmonic mean of the viscosities.
    Morris,
    /// The same with the transposed velocity gradient where the viscosity changes.
    Stress,
}

/// What is written and when.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Output {
    /// Time between records of the series in s; of a network, displaced pore volumes. So are the other intervals.
    pub series_every: f64,
    /// Time between VTK files in s, a whole multiple of nothing: it has its own schedule.
    pub vtk_every: f64,
    /// How arrays in VTK files are compressed.
    pub vtk_compression: Compression,
    /// Distance of grid nodes over dx.
    pub grid_ratio: f64,
    /// Time between restart files in s.
    pub restart_every: f64,
}

/// How arrays in VTK files are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Compression {
    /// Not at all.
    None,
    /// By zlib.
    #[default]
    Zlib,
    /// By LZ4.
    Lz4,
}

/// A measure that must come out as said.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Expectation {
    /// Name of a measure.
    pub measure: String,
    /// Expected value in the measure's unit.
    pub value: f64,
    /// Largest accepted deviation, same unit.
    pub tolerance: f64,
}
