//! `[sph]`: direct simulation by incompressible SPH. Its table, the checks of its parts together, and the table of a checked simulation.

use super::fluid::{Fluid, RawInterface, RawPhases, density_ratio, fluid, tension};
use super::initial::{self, Initial, RawInitial};
use super::measure_groups::{MeasureSet, RawMeasures};
use super::network::state::Start;
use super::numerics::{self, Numerics, RawNumerics};
use super::open::{Open, open};
use super::side::Sides;
use super::sides::{RawSides, RawWalls, Walls, sides, wall_speeds, walls};
use super::surface_force::{RawSurfaceForce, SurfaceForce, interface};
use super::wetting::{self, RawWetting, WettingPatch};
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, tables};
use meniscus_core::math::{Vec2, rounded_down, rounded_up};
use meniscus_geometry::spec::GeometrySpec;
use meniscus_wetting::Wetting;

tables! {
    /// Direct simulation by incompressible SPH.
    pub(crate) struct RawSph {
        /// Initial particle spacing `dx` in m: at least 10 across the domain, 5 across the narrowest throat; at most
        /// 2e7 particles, and no more than the free memory holds (1.6 kB each).
        pub spacing: f64 => Key::positive("a spacing in m").example("spacing = 2.0e-5 # m"),
        /// Smoothing length over spacing, `h/dx` (default 1.5).
        pub smoothing_ratio: f64 => Key::within("smoothing length over spacing", 1.0, 3.0),
        /// With `geometry.depth`: factor of the velocity profile across the depth in inertia and in the in-plane viscous stress (default: that at which a duct
        /// as wide as the median throat has its exact flow rate, 1 in a deep and 1.2 in a shallow one).
        pub profile_factor: f64 => Key::within("a factor", 1.0, 2.0),
        /// Length of the dimensionless numbers in m (default: the shorter of narrowest throat and root of the drop
        /// area; else the shorter side).
        pub reference_length: f64 => Key::positive("a length in m"),
        /// Body force per mass along x and y in m/s² (default `[0.0, 0.0]`).
        pub gravity: [f64; 2],
        /// The one or two fluids.
        pub phases: RawPhases => Key::required(PHASES),
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
        /// Criteria that end a run before `time.end`.
        pub stop: RawSphStop,
        /// Groups of measures for the report, one empty table each.
        pub measure: RawMeasures,
    }

    /// Criteria that end a run before `time.end`.
    pub(crate) struct RawSphStop {
        /// Ends when the entering phase passes another open side: 20 particles of it have left (default false).
        pub breakthrough: bool,
        /// Ends when the largest connected part of the wetting phase is a spacing or more away from all walls (default false).
        pub detachment: bool,
    }
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
    /// The other phase, color 0; `None` in single-phase flow.
    pub non_wetting: Option<Fluid>,
    /// Interfacial tension in N/m; 0 in single-phase flow.
    pub tension: f64,
    /// Depth of the chip (distance between floor and lid) in m; `None` in the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth: Option<f64>,
    /// Factor of the velocity profile across the depth in inertia and in the in-plane viscous stress, if the case gives one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile_factor: Option<f64>,
    /// Form of the surface force; `None` if the tension is 0.
    pub surface_force: Option<SurfaceForce>,
    /// Wetting model; `None`: no line force.
    pub wetting_model: Option<Wetting>,
    /// Parts of the walls with their own contact angles.
    pub wetting_patches: Vec<WettingPatch>,
    /// The characteristic length L of the dimensionless numbers in m, if the case gives one.
    pub reference_length: Option<f64>,
    /// Body force per mass in m/s².
    pub gravity: Vec2,
    /// The four sides of the domain.
    pub sides: Sides,
    /// Properties of all walls.
    pub walls: Walls,
    /// Speeds in m/s of the walls at the left, right, bottom and top side, along x or y.
    pub wall_speeds: [f64; 4],
    /// The drive of the flow through the left, right, bottom and top side, if it is open or periodic with a prescribed flow.
    pub open: [Option<Open>; 4],
    /// Initial phases and velocity.
    pub initial: Initial,
    /// Parameters of the method with a default that rarely needs a change (`[sph.numerics]`).
    pub numerics: Numerics,
    /// Whether the run ends when the entering phase has passed another open side.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub stop_at_breakthrough: bool,
    /// Whether the run ends when the drop is off the walls.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub stop_at_detachment: bool,
    /// Groups of measures in addition to those of every run (`[sph.measure]`).
    pub measure: MeasureSet,
}

impl Sph {
    /// The tension in N/m of a moving interface; 0 if it is frozen.
    pub fn acting_tension(&self) -> f64 {
        if self.measure.relative_permeability { 0.0 } else { self.tension }
    }

    /// Depth of the chip in m; 1 in the plane, where rates are those per meter of depth.
    pub fn thickness(&self) -> f64 {
        self.depth.unwrap_or(1.0)
    }

    /// Whether the spacing does not resolve the slip of contact lines, and the angle does not compensate for it; `Some(true)` where the case gives a slip length
    /// all the same.
    pub fn has_unresolved_slip(&self) -> Option<bool> {
        let law = self.wetting_model.filter(|law| !matches!(law, Wetting::Cox(_) | Wetting::CoxVoinov(_)));
        let length = law.filter(|_| self.acting_tension() > 0.0).map(|_| self.walls.line_slip_length)?;
        let is_given = length != self.spacing || self.walls.slip_length > 0.0;
        (length < self.spacing || !is_given).then_some(is_given)
    }
}

/// The fluids in a case file.
const PHASES: &str = "[sph.phases.wetting] with preset, or density and viscosity";

/// Most particles that a run may have: their pairs then fill the memory of a large machine.
const MOST_PARTICLES: f64 = 2.0e7;

/// Fewest particles across the domain: below, the kernels of opposite sides overlap.
const FEWEST_ACROSS: f64 = 10.0;

/// Checks `[sph]` and sets its defaults; `geometry` is missing if it was wrong.
pub(super) fn sph(
    checker: &mut Checker,
    raw: &mut RawSph,
    geometry: Option<&GeometrySpec>,
    start: Option<Start>,
) -> Option<Sph> {
    let spacing = raw.spacing;
    if let (Some(spacing), Some(geometry)) = (spacing, geometry) {
        particle_count(checker, spacing, geometry);
    }
    let phases = raw.phases.get_or_insert_default();
    if phases.non_wetting.is_some() {
        let given = raw.interface.as_ref().and_then(|interface| interface.tension);
        if let Some(tension) = tension(checker, "sph.interface", phases, given) {
            raw.interface.get_or_insert_default().tension = Some(tension);
        }
    }
    let fluid_of_drop = phases.wetting.as_mut().map(|raw| fluid(checker, "sph.phases.wetting", raw));
    let liquid = checker.require("sph.phases.wetting", fluid_of_drop, PHASES);
    let other = phases.non_wetting.as_mut().map(|raw| fluid(checker, "sph.phases.non-wetting", raw));
    if let (Some(Some(a)), Some(Some(b))) = (&liquid, &other) {
        density_ratio(checker, a, b);
    }
    let two_phases = other.is_some();
    let (tension, surface_force) =
        if two_phases { interface(checker, raw.interface.as_ref(), &mut raw.surface_force) } else { (Some(0.0), None) };
    let wetting_model =
        if two_phases { wetting::model(checker, "sph.wetting", raw.wetting.as_mut(), tension) } else { None };
    if !two_phases {
        refuse_single_phase_keys(checker, raw);
    }
    let raw_sides = raw.sides.get_or_insert_default();
    let wall_speeds = wall_speeds(checker, raw_sides);
    let sides = sides(checker, raw_sides);
    let open = open(checker, &sides, &mut raw_sides.open, two_phases);
    let patches = match wetting_model {
        Some(model) => wetting::patches(checker, "sph.wetting", raw.wetting.as_mut(), model, Some(&sides), geometry),
        None => Vec::new(),
    };
    let stop_at_breakthrough = stop_at_breakthrough(checker, raw.stop.as_ref(), &sides, two_phases);
    let stop_at_detachment = stop_at_detachment(checker, raw.stop.as_ref(), two_phases);
    let raw_initial = raw.initial.get_or_insert_default();
    let initial = match raw_initial.network {
        Some(_) => initial::from_network(checker, raw_initial, two_phases, &sides, start),
        None => initial::initial(checker, raw_initial, two_phases, geometry),
    };
    let walls = walls(checker, raw.walls.get_or_insert_default(), wetting_model.is_some(), spacing);
    let measure = MeasureSet::from_raw(raw.measure.get_or_insert_default());
    let default = match measure.relative_permeability {
        true => numerics::beside_frozen_interface(),
        false => numerics::default(surface_force),
    };
    let numerics = RawNumerics::filled(&mut raw.numerics, default);
    Some(Sph {
        spacing: spacing?,
        smoothing_ratio: *raw.smoothing_ratio.get_or_insert(DEFAULT_SMOOTHING_RATIO),
        wetting: liquid??,
        non_wetting: match other {
            Some(other) => Some(other?),
            None => None,
        },
        tension: tension?,
        depth: None,
        profile_factor: raw.profile_factor,
        surface_force,
        wetting_model,
        wetting_patches: patches,
        reference_length: raw.reference_length,
        gravity: Vec2::from(*raw.gravity.get_or_insert_default()),
        sides,
        walls,
        wall_speeds,
        open: open?,
        initial: initial?,
        numerics,
        stop_at_breakthrough,
        stop_at_detachment,
        measure,
    })
}

/// Whether a run ends at breakthrough, which needs two phases and two open sides.
fn stop_at_breakthrough(checker: &mut Checker, raw: Option<&RawSphStop>, sides: &Sides, two_phases: bool) -> bool {
    let stops = raw.and_then(|stop| stop.breakthrough).unwrap_or(false);
    let open = sides.open().into_iter().filter(|is_open| *is_open).count() > 1;
    if stops && !(two_phases && open) {
        checker.refuse(
            "sph.stop.breakthrough",
            "breakthrough needs two phases, and an inlet and an outlet",
            "add them in [sph.phases] and [sph.sides], or leave this out",
        );
    }
    stops
}

/// Whether a run ends when a drop leaves the walls, which needs two phases.
fn stop_at_detachment(checker: &mut Checker, raw: Option<&RawSphStop>, two_phases: bool) -> bool {
    let stops = raw.and_then(|stop| stop.detachment).unwrap_or(false);
    if stops && !two_phases {
        checker.refuse(
            "sph.stop.detachment",
            "a drop that leaves the walls needs two phases",
            "add [sph.phases.non-wetting], or leave this out",
        );
    }
    stops
}

/// h/dx of the paper's examples.
const DEFAULT_SMOOTHING_RATIO: f64 = 1.5;

fn particle_count(checker: &mut Checker, spacing: f64, geometry: &GeometrySpec) {
    let across = [0, 1].map(|axis| (geometry.max[axis] - geometry.min[axis]) / spacing);
    let count = across[0] * across[1];
    let (width, height) = (geometry.max[0] - geometry.min[0], geometry.max[1] - geometry.min[1]);
    if count > MOST_PARTICLES {
        let enough = (width * height / MOST_PARTICLES).sqrt();
        checker.refuse(
            "sph.spacing",
            format!("a spacing of {spacing:e} m gives {count:.2e} particles in {width:e} m by {height:e} m, more than {MOST_PARTICLES:.0e}"),
            format!("a spacing of {:.2e} m or more would do; the spacing is in m", rounded_up(enough)),
        );
    }
    let narrow = across[0].min(across[1]);
    if narrow < FEWEST_ACROSS {
        checker.refuse(
            "sph.spacing",
            format!(
                "a spacing of {spacing:e} m gives {narrow:.1} particles across the domain, fewer than {FEWEST_ACROSS}"
            ),
            format!(
                "a spacing of {:.2e} m or less would do; the spacing is in m",
                rounded_down(width.min(height) / FEWEST_ACROSS)
            ),
        );
    }
}

fn refuse_single_phase_keys(checker: &mut Checker, raw: &RawSph) {
    let initial = raw.initial.as_ref();
    let given = [
        ("sph.interface", raw.interface.is_some()),
        ("sph.surface-force", raw.surface_force.is_some()),
        ("sph.wetting", raw.wetting.is_some()),
        ("sph.initial.background", initial.is_some_and(|initial| initial.background.is_some())),
        ("sph.initial.wetting", initial.is_some_and(|initial| initial.wetting.is_some())),
        ("sph.initial.non-wetting", initial.is_some_and(|initial| initial.non_wetting.is_some())),
        ("sph.initial.network", initial.is_some_and(|initial| initial.network.is_some())),
    ];
    for (path, _) in given.into_iter().filter(|(_, given)| *given) {
        checker.refuse(
            path,
            format!("`{path}` needs two phases, and there is no [sph.phases.non-wetting]"),
            "add the second phase, or leave this out",
        );
    }
}
