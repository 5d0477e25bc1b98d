//! `[sph.surface-force]`: the model of the surface force.

use super::fluid::RawInterface;
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{tables, words};

tables! {
    /// Forms of the surface force.
    pub(crate) struct RawSurfaceForce {
        /// Continuum surface force with contact line force (Huber et al. 2013, Eqs. 20 and 23).
        pub csf: RawCsf,
        /// Pressure jump across a sharp interface with fitted curvature; the default model.
        pub pressure_jump: RawPressureJump,
    }

    /// The pressure jump.
    pub(crate) struct RawPressureJump {
        /// For tests: curvature of all interfaces in 1/m, positive where the wetting phase is convex; contact angles
        /// are then ignored (default: fitted).
        pub curvature: f64,
    }

    /// The continuum surface force.
    pub(crate) struct RawCsf {
        /// Line force normalized along each contact line (Eqs. 21 and 22), or in closed form per particle (default
        /// `normalized`).
        pub line_delta: LineDelta,
    }
}

words! {
    /// Forms of the contact line delta.
    pub enum LineDelta {
        /// Huber et al. 2013, Eqs. 21 and 22, line by line.
        Normalized,
        /// In closed form, particle by particle.
        Local,
    }
}

/// Forms of the surface force.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceForce {
    /// Continuum surface force [Huber2013, Eq. 20].
    Csf {
        /// Distribution of the contact line force.
        line_delta: LineDelta,
    },
    /// Pressure jump across a sharp interface.
    PressureJump {
        /// Curvature in 1/m of all interfaces, fitted if `None`.
        curvature: Option<f64>,
    },
}

/// The default surface force.
const DEFAULT_SURFACE_FORCE: SurfaceForce = SurfaceForce::PressureJump { curvature: None };

/// Tension and surface force of two fluids; no force without a tension.
pub(super) fn interface(
    checker: &mut Checker,
    interface: Option<&RawInterface>,
    force: &mut Option<RawSurfaceForce>,
) -> (Option<f64>, Option<SurfaceForce>) {
    const PATH: &str = "sph.interface.tension";
    let tension = checker.require(PATH, interface.and_then(|interface| interface.tension), "tension = 0.0276 # N/m");
    let is_given = force.is_some();
    if !is_given && tension.is_some_and(|tension| tension > 0.0) {
        *force = Some(RawSurfaceForce { pressure_jump: Some(RawPressureJump::default()), csf: None });
    }
    let chosen = match force.as_ref().map(|force| (&force.csf, &force.pressure_jump)) {
        None => DEFAULT_SURFACE_FORCE,
        Some((Some(csf), None)) => SurfaceForce::Csf { line_delta: csf.line_delta.unwrap_or(LineDelta::Normalized) },
        Some((None, Some(jump))) => SurfaceForce::PressureJump { curvature: jump.curvature },
        Some((csf, _)) => {
            checker.refuse(
                "sph.surface-force",
                format!("expected exactly one surface force, found {}", if csf.is_some() { "two" } else { "none" }),
                "keep one of the tables [sph.surface-force.pressure-jump] and [sph.surface-force.csf]",
            );
            DEFAULT_SURFACE_FORCE
        }
    };
    if is_given && tension == Some(0.0) {
        checker.refuse(
            "sph.surface-force",
            "a surface force needs a tension above 0",
            "raise sph.interface.tension, or leave this table out",
        );
    }
    (tension, tension.filter(|tension| *tension > 0.0).map(|_| chosen))
}
