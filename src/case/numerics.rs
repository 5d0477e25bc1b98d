//! Checks of `[sph.numerics]`, and its defaults.

use super::check::Checker;
use super::checked::{Numerics, SurfaceForce, ViscousStep, ViscousTerm};
use super::raw::{RawNumerics, RawViscousStep, RawViscousTerm};

/// Defaults by what flows. The paper's surface force keeps its particles in order by background pressure and drift source,
/// the others by shifting and either drift source or drift correction (docs/numerics).
pub(super) fn default(surface_force: Option<SurfaceForce>) -> Numerics {
    let (drift_source, drift_correction, background_pressure, shifting, short_range_push) = match surface_force {
        Some(SurfaceForce::Csf { .. }) => (0.02, 0.0, 0.5, 0.0, 0.0),
        Some(SurfaceForce::PressureJump { .. }) => (0.2, 0.0, 0.0, 2.0, 0.2),
        None => (0.0, 0.2, 0.0, 2.0, 0.0),
    };
    Numerics {
        viscous_term: ViscousTerm::Stress,
        viscous_step: ViscousStep::Implicit,
        drift_source,
        drift_correction,
        background_pressure,
        shifting,
        short_range_push,
        wall_stretch: 10.0,
        fitted_walls: true,
        fitted_interface: matches!(surface_force, Some(SurfaceForce::PressureJump { .. })),
        pressure_tolerance: 1.0e-6,
        time_step_factor: 1.0,
    }
}

pub(super) fn numerics(checker: &mut Checker, raw: &RawNumerics, default: Numerics) -> Numerics {
    let mut within = |key: &str, given: Option<f64>, range: (f64, f64), what: &str, default: f64| {
        checker.within(&format!("sph.numerics.{key}"), given, range, what).unwrap_or(default)
    };
    Numerics {
        viscous_term: match raw.viscous_term {
            None => default.viscous_term,
            Some(RawViscousTerm::Stress) => ViscousTerm::Stress,
            Some(RawViscousTerm::Morris) => ViscousTerm::Morris,
            Some(RawViscousTerm::Szewc) => ViscousTerm::Szewc,
        },
        viscous_step: match raw.viscous_step {
            None => default.viscous_step,
            Some(RawViscousStep::Implicit) => ViscousStep::Implicit,
            Some(RawViscousStep::Explicit) => ViscousStep::Explicit,
        },
        drift_source: within("drift-source", raw.drift_source, (0.0, 1.0), "a share", default.drift_source),
        drift_correction: within(
            "drift-correction",
            raw.drift_correction,
            (0.0, 1.0),
            "a share",
            default.drift_correction,
        ),
        background_pressure: within(
            "background-pressure",
            raw.background_pressure,
            (0.0, 1.0e3),
            "a factor",
            default.background_pressure,
        ),
        shifting: within("shifting", raw.shifting, (0.0, 100.0), "a factor", default.shifting),
        short_range_push: within(
            "short-range-push",
            raw.short_range_push,
            (0.0, 1.0),
            "a factor",
            default.short_range_push,
        ),
        wall_stretch: within("wall-stretch", raw.wall_stretch, (1.0, 1.0e3), "a factor", default.wall_stretch),
        fitted_walls: raw.fitted_walls.unwrap_or(default.fitted_walls),
        fitted_interface: raw.fitted_interface.unwrap_or(default.fitted_interface),
        pressure_tolerance: within(
            "pressure-tolerance",
            raw.pressure_tolerance,
            (1.0e-13, 0.1),
            "a relative residual",
            default.pressure_tolerance,
        ),
        time_step_factor: within(
            "time-step-factor",
            raw.time_step_factor,
            (1.0e-3, 10.0),
            "a factor",
            default.time_step_factor,
        ),
    }
}
