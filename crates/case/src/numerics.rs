//! `[sph.numerics]`: parameters of the method, and their defaults.

use super::surface_force::SurfaceForce;
use meniscus_core::input::tables::{Key, checked_tables, words};

checked_tables! {
    /// Parameters of the method.
    pub struct RawNumerics for Numerics {
        /// Form of the viscous term (default `stress`).
        pub viscous_term: ViscousTerm,
        /// Viscous force from the velocity at the end or the beginning of the step (default `implicit`).
        pub viscous_step: ViscousStep,
        /// Density-error correction in the pressure equation: largest share of the error removed per step (default 0.2;
        /// with `csf` 0.02; without tension 0).
        pub density_error_correction: f64 => Key::within("a share", 0.0, 1.0),
        /// Density-error correction by particle shifting: share of the error removed per step (default 0; without
        /// tension 0.2).
        pub density_error_shifting: f64 => Key::within("a share", 0.0, 1.0),
        /// Background pressure over `σ/h`, or over `ρ v²` without tension (default 0; with `csf` 0.5).
        pub background_pressure: f64 => Key::within("a factor", 0.0, 1.0e3),
        /// Strength of particle shifting (default 2; with `csf` 0).
        pub shifting: f64 => Key::within("a factor", 0.0, 100.0),
        /// Strength of the anti-clustering force in particle shifting (default 0.2; with `csf` or without tension 0).
        pub anti_clustering: f64 => Key::within("a factor", 0.0, 1.0),
        /// Largest stretch `β` of velocity differences at walls; sets the slip without a slip length (default 10.0).
        pub wall_stretch: f64 => Key::within("a factor", 1.0, 1.0e3),
        /// Wall particles follow walls that the lattice does not fit (default true).
        pub fitted_walls: bool,
        /// Particles follow the initial interface where the lattice does not fit it (default true; with `csf` or
        /// without tension false).
        pub fitted_interface: bool,
        /// Largest relative residual of the pressure solve (default 1e-6).
        pub pressure_tolerance: f64 => Key::within("a relative residual", 1.0e-13, 0.1),
        /// Factor on all limits of the time step; of that by velocity up to a Courant number of 0.3 (default 1).
        pub time_step_factor: f64 => Key::within("a factor", 1.0e-3, 10.0),
    }
}

words! {
    /// Forms of the viscous term.
    pub enum ViscousTerm {
        /// Szewc et al. 2012; Huber et al. 2013, Eq. 16.
        Szewc,
        /// Morris et al. 1997 with the harmonic mean of the viscosities.
        Morris,
        /// The same with the transposed velocity gradient where the viscosity changes.
        Stress,
    }

    /// Time integration of viscosity.
    pub enum ViscousStep {
        /// By the velocity at the end of the step: no limit of the time step.
        Implicit,
        /// By the velocity at its start: steps are short for high viscosity or fine spacing.
        Explicit,
    }
}

/// Defaults by the kind of flow. The paper's surface force orders its particles by background pressure and the density-error correction in the
/// pressure equation, the others by shifting and either that correction or the one by shifting (docs/numerics).
pub(crate) fn default(surface_force: Option<SurfaceForce>) -> Numerics {
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

/// Defaults of the flows at a frozen interface: those of one fluid, with particles along the interface.
pub(super) fn beside_frozen_interface() -> Numerics {
    Numerics { fitted_interface: true, ..default(None) }
}
