//! A checked case: every value present, in SI units and in range. Made by `case::load`, read by set-up code only.

use super::film::checked::ThinFilm;
use crate::geometry::spec::{GeometrySpec, ShapeSpec};
use crate::math::Vec2;

/// A case that can be run.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Case {
    /// One line that says what the case shows.
    pub title: String,
    /// Domain and solids.
    pub geometry: GeometrySpec,
    /// The model that solves it.
    pub model: Model,
    /// End of the simulation in s.
    pub end: f64,
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
    pub wetting_model: Option<WettingModel>,
    /// Body force per mass in m/s².
    pub gravity: Vec2,
    /// What stands at the four sides of the domain.
    pub sides: Sides,
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

/// A Newtonian fluid.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Fluid {
    /// Density in kg/m³.
    pub density: f64,
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
}

/// Forms of the surface force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceForce {
    /// Continuum surface force [Huber2013, Eq. 20].
    Csf,
    /// Pressure jump across a sharp interface with fitted curvature.
    PressureJump,
}

/// Wetting models.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WettingModel {
    /// Unbalanced Young force [Huber2013, Eqs. 7 and 23].
    Young {
        /// Static contact angle through the wetting phase, in rad.
        contact_angle: f64,
    },
}

/// One side of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
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

/// Discretization choices and solver tolerances.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Numerics {
    /// Form of the viscous term.
    pub viscous_term: ViscousTerm,
    /// Share of the density error taken back per step: gamma of the drift source, 0 to 1.
    pub drift_source: f64,
    /// Background pressure in units of sigma/h (or of rho v² without tension), at least 0.
    pub background_pressure: f64,
    /// Particle shifting: A in δr = −A h v_max Δt ∇C, at least 0.
    pub shifting: f64,
    /// Largest stretch β of velocity differences at walls, at least 1: 10 is no slip, 1.5 slips by a quarter of dx.
    pub wall_stretch: f64,
    /// Largest relative residual of the pressure solve.
    pub pressure_tolerance: f64,
    /// Factor on all three limits of the time step, above 0 and at most 1.
    pub time_step_factor: f64,
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

/// Named groups of measures a case can ask for; each is a table `[sph.measure.NAME]`.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize)]
pub struct MeasureSet {
    /// `base-m`, `height-m` of a drop on a straight wall.
    pub sessile_drop: bool,
    /// `laplace-jump-ratio`, `parasitic-capillary-number` of a free drop.
    pub laplace_drop: bool,
    /// `velocity-l2-error` against plane Poiseuille flow driven by gravity.
    pub poiseuille: bool,
    /// `decay-rate-error` against the Taylor-Green vortex.
    pub taylor_green: bool,
    /// `filling-angle-deg`, `neck-half-width-m`, `capillary-pressure-ratio` of a bridge between two discs.
    pub capillary_bridge: bool,
    /// `interface-curvature-per-m` of the menisci between four discs.
    pub four_discs: bool,
    /// Wetted part and height of a drop on a disc.
    pub drop_on_disc: bool,
    /// Period and decay of a free drop that oscillates between two ellipses.
    pub oscillating_drop: bool,
    /// Amplitude of a standing wave on a flat interface.
    pub capillary_wave: bool,
    /// Height, speed and roundness of a bubble (the wetting phase) that rises.
    pub rising_bubble: bool,
    /// Deformation of a drop between two moving walls.
    pub shear_drop: bool,
    /// Velocity and flow rates of two layers between plates.
    pub layered_poiseuille: bool,
    /// Extreme velocities on the center lines of a lid-driven cavity.
    pub cavity: bool,
    /// Drag on the solids of a periodic cell that a body force drives fluid through.
    pub cylinder_array: bool,
    /// Capillary pressure over the entry pressure of the throat between two discs.
    pub throat_entry: bool,
    /// Difference of the mean levels on both sides of a plate.
    pub jurin: bool,
    /// Filled length of a slit between two open sides.
    pub slit_filling: bool,
    /// Height of the meniscus that rises from an open side.
    pub capillary_rise: bool,
}

/// What is written and when.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Output {
    /// Time between records of the series in s.
    pub series_every: f64,
    /// Time between VTK files in s, a whole multiple of nothing: it has its own schedule.
    pub vtk_every: f64,
    /// Distance of grid nodes over dx.
    pub grid_ratio: f64,
    /// Time between restart files in s.
    pub restart_every: f64,
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
