//! Checks of how a thin film is solved.

use super::checked::{FilmIntegrator, FilmMethod, FilmSums, LatticeEnergy};
use super::raw::{RawFilmIntegrator, RawFilmMethod, RawFilmSums, RawLatticeEnergy};
use crate::input::Checker;

/// Errors of a step over the initial width.
const TOLERANCES: (f64, f64) = (1.0e-12, 1.0e-3);
const DEFAULT_TOLERANCE: f64 = 1.0e-7;
/// Steps over the time since the start.
const STEP_SHARES: (f64, f64) = (1.0e-5, 0.1);
const DEFAULT_STEP_SHARE: f64 = 0.005;

/// The method of a case that names none. Particles rest at a steeper angle than asked for by the energy of their lattice, so that they are
/// it in complete wetting only.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum DefaultMethod {
    Particles,
    FiniteDifferences,
}

pub(super) fn method(
    checker: &mut Checker,
    raw: &RawFilmMethod,
    particles_can_be: bool,
    default: DefaultMethod,
) -> Option<FilmMethod> {
    if let (Some(_), Some(_)) = (&raw.particles, &raw.finite_differences) {
        checker.refuse(
            "thin-film.method",
            "expected exactly one method, found 2",
            "choose one of `particles`, `finite-differences`",
        );
        return None;
    }
    if raw.particles.is_some() && !particles_can_be {
        checker.refuse(
            "thin-film.method.particles",
            "particles solve the geometric equation in the plane, and no other",
            "leave the method out for finite differences",
        );
        return None;
    }
    if raw.finite_differences.is_some() || (raw.particles.is_none() && default == DefaultMethod::FiniteDifferences) {
        let path = "thin-film.method.finite-differences.step-share";
        let share = raw.finite_differences.as_ref().and_then(|raw| raw.step_share);
        let share = checker.within(path, share, STEP_SHARES, "a share");
        return Some(FilmMethod::FiniteDifferences { step_share: share.unwrap_or(DEFAULT_STEP_SHARE) });
    }
    let raw = raw.particles.clone().unwrap_or_default();
    let path = "thin-film.method.particles.tolerance";
    let tolerance = checker.within(path, raw.tolerance, TOLERANCES, "a relative error");
    let integrator = match raw.integrator {
        None | Some(RawFilmIntegrator::Stiff) => FilmIntegrator::Stiff,
        Some(RawFilmIntegrator::Explicit) => FilmIntegrator::Explicit,
    };
    Some(FilmMethod::Particles {
        integrator,
        tolerance: tolerance.unwrap_or(DEFAULT_TOLERANCE),
        lattice_energy: match raw.lattice_energy {
            None | Some(RawLatticeEnergy::Kept) => LatticeEnergy::Kept,
            Some(RawLatticeEnergy::TakenOff) => LatticeEnergy::TakenOff,
        },
        sums: match raw.sums {
            None | Some(RawFilmSums::Recursive) => FilmSums::Recursive,
            Some(RawFilmSums::Direct) => FilmSums::Direct,
        },
    })
}
