//! Checks of `[sph.numerics]`, and its defaults.

use super::checked::{Numerics, SurfaceForce, ViscousStep, ViscousTerm};
use super::raw::{RawNumerics, RawViscousStep, RawViscousTerm};
use crate::input::Checker;

/// Defaults by what flows. The paper's surface force keeps its particles in order by background pressure and the density-error correction in the pressure equation,
/// the others by shifting and either that correction or the one by shifting (docs/numerics).
pub(super) fn default(surface_force: Option<SurfaceForce>) -> Numerics {
    let (density_error_correction, density_error_shifting, background_pressure, shifting, anti_clustering) =
        match surface_force {
            Some(SurfaceForce::Csf { .. }) => (0.02, 0.0, 0.5, 0.0, 0.0),
            Some(SurfaceForce::PressureJump { .. }) => (0.2, 0.0, 0.0, 2.0, 0.2),
            None => (0.0, 0.2, 0.0, 2.0, 0.0),
        };
    Numerics {
        viscous_term: ViscousTerm::Stress,
        viscous_step: ViscousStep::Implicit,
        density_error_correction,
        density_error_shifting,
        background_pressure,
        shifting,
        anti_clustering,
        wall_stretch: 10.0,
        fitted_walls: true,
        fitted_interface: matches!(surface_force, Some(SurfaceForce::PressureJump { .. })),
        pressure_tolerance: 1.0e-6,
        time_step_factor: 1.0,
    }
}

/// Defaults of the flows beside a frozen interface: those of one fluid, with particles along the interface.
pub(super) fn beside_frozen_interface() -> Numerics {
    Numerics { fitted_interface: true, ..default(None) }
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
        density_error_correction: within(
            "density-error-correction",
            raw.density_error_correction,
            (0.0, 1.0),
            "a share",
            default.density_error_correction,
        ),
        density_error_shifting: within(
            "density-error-shifting",
            raw.density_error_shifting,
            (0.0, 1.0),
            "a share",
            default.density_error_shifting,
        ),
        background_pressure: within(
            "background-pressure",
            raw.background_pressure,
            (0.0, 1.0e3),
            "a factor",
            default.background_pressure,
        ),
        shifting: within("shifting", raw.shifting, (0.0, 100.0), "a factor", default.shifting),
        anti_clustering: within(
            "anti-clustering",
            raw.anti_clustering,
            (0.0, 1.0),
            "a factor",
            default.anti_clustering,
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
