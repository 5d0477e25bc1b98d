//! Checks of `[sph]`: ranges of every value, and which values go together.

use super::checked::{Fluid, LineDelta, MeasureSet, Sph, SurfaceForce};
use super::network::state::Start;
use super::preset::{COLD, WARM};
use super::raw::{RawCsf, RawFluid, RawLineDelta, RawSph};
use super::sides::{sides, wall_speeds, walls};
use super::{initial, numerics, wetting};
use crate::geometry::spec::GeometrySpec;
use crate::input::{Checker, Range};
use crate::math::Vec2;

/// Most particles that a run may have: their pairs then fill the memory of a large machine.
const MOST_PARTICLES: f64 = 2.0e7;

/// Fewest particles across the domain: below, the kernels of opposite sides overlap.
const FEWEST_ACROSS: f64 = 10.0;

/// Smoothing length over spacing: below 1 too few neighbors, above 3 hundreds of them.
const SMOOTHING_RATIO: (f64, f64) = (1.0, 3.0);

/// Largest ratio of densities for which the pressure solve is known to converge.
const LARGEST_DENSITY_RATIO: f64 = 1.0e4;

/// Checks `[sph]`; `geometry` is missing where it was wrong.
pub(super) fn sph(
    checker: &mut Checker,
    raw: &RawSph,
    geometry: Option<&GeometrySpec>,
    start: Option<Start>,
) -> Option<Sph> {
    let spacing = checker.require_positive("sph.spacing", raw.spacing, "spacing = 2.0e-5 # m", "a spacing in m");
    if let (Some(spacing), Some(geometry)) = (spacing, geometry) {
        particle_count(checker, spacing, geometry);
    }
    let ratio =
        checker.within("sph.smoothing-ratio", raw.smoothing_ratio, SMOOTHING_RATIO, "smoothing length over spacing");
    let reference_length = raw.reference_length.and_then(|length| {
        let example = "reference-length = 1.0e-3 # m";
        checker.require_positive("sph.reference-length", Some(length), example, "a length in m")
    });
    let phases = raw.phases.clone().unwrap_or_default();
    let fluid_of_drop = phases.wetting.as_ref().map(|fluid| self::fluid(checker, "sph.phases.wetting", fluid));
    let liquid = checker.require(
        "sph.phases.wetting",
        fluid_of_drop,
        "[sph.phases.wetting] with preset, or density and viscosity",
    );
    let other = phases.non_wetting.as_ref().map(|fluid| self::fluid(checker, "sph.phases.non-wetting", fluid));
    if let (Some(Some(a)), Some(Some(b))) = (&liquid, &other) {
        density_ratio(checker, a, b);
    }
    let two_phases = other.is_some();
    let (tension, surface_force) = if two_phases { interface(checker, raw) } else { (Some(0.0), None) };
    let wetting_model =
        if two_phases { wetting::model(checker, "sph.wetting", raw.wetting.as_ref(), tension) } else { None };
    if !two_phases {
        refuse_single_phase_keys(checker, raw);
    }
    let raw_sides = raw.sides.clone().unwrap_or_default();
    let wall_speeds = wall_speeds(checker, &raw_sides);
    let open = super::open::open(checker, &raw_sides, two_phases);
    let sides = sides(checker, &raw_sides);
    let patches = match wetting_model {
        Some(model) => wetting::patches(checker, "sph.wetting", raw.wetting.as_ref(), model, Some(&sides), geometry),
        None => Vec::new(),
    };
    let raw_initial = raw.initial.clone().unwrap_or_default();
    let initial = match raw_initial.network {
        Some(_) => initial::from_network(checker, &raw_initial, two_phases, &sides, start),
        None => initial::initial(checker, &raw_initial, two_phases, geometry),
    };
    let walls = walls(checker, &raw.walls.clone().unwrap_or_default(), wetting_model.is_some(), spacing);
    let measure = MeasureSet::from_raw(&raw.measure.clone().unwrap_or_default());
    let default = match measure.relative_permeability {
        true => numerics::beside_frozen_interface(),
        false => numerics::default(surface_force),
    };
    let numerics = numerics::numerics(checker, &raw.numerics.clone().unwrap_or_default(), default);
    Some(Sph {
        spacing: spacing?,
        smoothing_ratio: ratio.unwrap_or(DEFAULT_SMOOTHING_RATIO),
        wetting: liquid??,
        non_wetting: match other {
            Some(other) => Some(other?),
            None => None,
        },
        tension: tension?,
        surface_force,
        wetting_model,
        wetting_patches: patches,
        reference_length,
        gravity: Vec2::from(raw.gravity.unwrap_or_default()),
        sides,
        walls,
        wall_speeds,
        open: open?,
        initial: initial?,
        numerics,
        measure,
    })
}

/// The surface force of a case that names none.
const DEFAULT_SURFACE_FORCE: SurfaceForce = SurfaceForce::PressureJump { curvature: None };

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
            format!("a spacing of {enough:.1e} m or more would do; the spacing is in m"),
        );
    }
    let narrow = across[0].min(across[1]);
    if narrow < FEWEST_ACROSS {
        checker.refuse(
            "sph.spacing",
            format!(
                "a spacing of {spacing:e} m gives {narrow:.1} particles across the domain, fewer than {FEWEST_ACROSS}"
            ),
            format!("a spacing of {:.1e} m or less would do; the spacing is in m", width.min(height) / FEWEST_ACROSS),
        );
    }
}

pub(super) fn fluid(checker: &mut Checker, at: &str, raw: &RawFluid) -> Option<Fluid> {
    let path = format!("{at}.temperature-c");
    let celsius = checker.within(&path, raw.temperature_c, (COLD, WARM), "a temperature in degrees Celsius");
    if raw.temperature_c.is_some() && raw.preset.is_none() {
        checker.refuse(
            path,
            "a temperature needs a preset",
            "add `preset`, or give the density and viscosity at that temperature",
        );
    }
    if raw.preset.is_none() && raw.density.is_none() && raw.viscosity.is_none() {
        let help = "add preset = \"water\", or density in kg/m3 and viscosity in Pa s";
        checker.refuse(format!("{at}.preset"), format!("expected a fluid in [{at}], found no property"), help);
        return None;
    }
    let preset = raw.preset.map(|preset| preset.at(celsius.unwrap_or(COLD)));
    let mut property = |key: &str, given: Option<f64>, known: Option<f64>, example: &str, what: &str| {
        let path = format!("{at}.{key}");
        checker.require_positive(&path, given.or(known), example, what)
    };
    let density =
        property("density", raw.density, preset.map(|p| p.density), "density = 998.2 # kg/m3", "a density in kg/m3");
    let viscosity = property(
        "viscosity",
        raw.viscosity,
        preset.map(|p| p.viscosity),
        "viscosity = 1.0e-3 # Pa s",
        "a viscosity in Pa s",
    );
    Some(Fluid { density: density?, viscosity: viscosity? })
}

fn density_ratio(checker: &mut Checker, wetting: &Fluid, other: &Fluid) {
    let ratio = wetting.density / other.density;
    if !(1.0 / LARGEST_DENSITY_RATIO..=LARGEST_DENSITY_RATIO).contains(&ratio) {
        checker.refuse(
            "sph.phases.non-wetting.density",
            format!("the density ratio of the phases is {ratio:.3e}, expected 1e-4 to 1e4"),
            "densities are in kg/m3: water has 998, air 1.2",
        );
    }
}

fn interface(checker: &mut Checker, raw: &RawSph) -> (Option<f64>, Option<SurfaceForce>) {
    const PATH: &str = "sph.interface.tension";
    let tension = checker.require(PATH, raw.interface.as_ref().and_then(|i| i.tension), "tension = 0.0276 # N/m");
    let tension = checker.in_range(PATH, tension, Range::AtLeast(0.0), "a tension in N/m");
    let force = raw.surface_force.as_ref();
    let chosen = match force.map(|force| (force.csf.is_some(), force.pressure_jump.is_some())) {
        None => DEFAULT_SURFACE_FORCE,
        Some((true, false)) => SurfaceForce::Csf { line_delta: line_delta(force.and_then(|force| force.csf.as_ref())) },
        Some((false, true)) => SurfaceForce::PressureJump {
            curvature: force.and_then(|force| force.pressure_jump.as_ref()).and_then(|jump| jump.curvature),
        },
        Some((both, _)) => {
            checker.refuse(
                "sph.surface-force",
                format!("expected exactly one surface force, found {}", if both { "two" } else { "none" }),
                "keep one of the tables [sph.surface-force.pressure-jump] and [sph.surface-force.csf]",
            );
            DEFAULT_SURFACE_FORCE
        }
    };
    if force.is_some() && tension == Some(0.0) {
        checker.refuse(
            "sph.surface-force",
            "a surface force needs a tension above 0",
            "raise sph.interface.tension, or leave this table out",
        );
    }
    (tension, tension.filter(|tension| *tension > 0.0).map(|_| chosen))
}

fn line_delta(raw: Option<&RawCsf>) -> LineDelta {
    match raw.and_then(|raw| raw.line_delta) {
        Some(RawLineDelta::Local) => LineDelta::Local,
        Some(RawLineDelta::Normalized) | None => LineDelta::Normalized,
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
