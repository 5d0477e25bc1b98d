//! `[thin-film.method]`: how a thin film is solved.

use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, checked_tables, tables, words};

tables! {
    /// Methods for thin films.
    pub(crate) struct RawFilmMethod {
        /// Particles on an infinite line, for the geometric equation in the plane.
        pub particles: RawFilmParticles,
        /// Implicit finite differences, for every equation.
        pub finite_differences: RawFilmGrid,
    }
}

checked_tables! {
    /// The particle method.
    pub struct RawFilmParticles for FilmParticles {
        /// Implicit of order 4, or Dormand and Prince of order 5 (default `stiff`).
        pub integrator: FilmIntegrator,
        /// Largest error of a step over the initial width (default 1e-7).
        pub tolerance: f64 => Key::within("a relative error", 1.0e-12, 1.0e-3),
        /// Keeps or subtracts the energy of the particle lattice (default `kept`).
        pub lattice_energy: LatticeEnergy,
        /// Sums over particles in linear time, or over all pairs for comparison (default `recursive`).
        pub sums: FilmSums,
    }

    /// The finite-difference method.
    pub struct RawFilmGrid for FilmGrid {
        /// Longest step over the time since the start (default 0.005).
        pub step_share: f64 => Key::within("a share", 1.0e-5, 0.1),
    }
}

words! {
    /// Integration of the particles of a thin film.
    pub enum FilmIntegrator {
        /// Linearly implicit, order 4: steps as long as the solution allows.
        Stiff,
        /// Dormand and Prince, order 5: the time step is limited by stability.
        Explicit,
    }

    /// Treatment of the energy of the particle lattice.
    pub enum LatticeEnergy {
        /// Kept, as in the paper.
        Kept,
        /// Its gradient is subtracted: not in the paper, order 4 as long as gaps are below half a filter length.
        TakenOff,
    }

    /// Evaluation of the sums over the particles of a thin film.
    pub enum FilmSums {
        /// From neighbor to neighbor, in linear time.
        Recursive,
        /// Over all pairs, for comparison: quadratic time.
        Direct,
    }
}

/// Methods for thin films.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmMethod {
    /// Particles on an infinite line.
    Particles(FilmParticles),
    /// Implicit finite differences: over a periodic domain for the geometric equation in the plane, else between walls.
    FiniteDifferences(FilmGrid),
}

const PARTICLES: FilmParticles = FilmParticles {
    integrator: FilmIntegrator::Stiff,
    tolerance: 1.0e-7,
    lattice_energy: LatticeEnergy::Kept,
    sums: FilmSums::Recursive,
};
const GRID: FilmGrid = FilmGrid { step_share: 0.005 };

/// The default method of a case. Due to the energy of their lattice, particles come to rest at too steep an angle, so they are the default in complete wetting
/// only.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum DefaultMethod {
    Particles,
    FiniteDifferences,
}

pub(super) fn method(
    checker: &mut Checker,
    raw: &mut RawFilmMethod,
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
        return Some(FilmMethod::FiniteDifferences(RawFilmGrid::filled(&mut raw.finite_differences, GRID)));
    }
    Some(FilmMethod::Particles(RawFilmParticles::filled(&mut raw.particles, PARTICLES)))
}
