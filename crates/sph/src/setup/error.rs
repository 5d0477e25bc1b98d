//! Errors of the construction of a solver from a case.

use meniscus_core::math::Vec2;
use meniscus_geometry::GeometryError;

/// A case that cannot be filled with particles.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// Invalid geometry.
    #[error("{0}")]
    Geometry(#[from] GeometryError),
    /// The box is too small for its periodic sides.
    #[error(
        "a periodic domain must be at least {needed:.3e} m long (three kernel supports), found {width:.3e} m by {height:.3e} m; \
         use a smaller spacing or a longer domain"
    )]
    PeriodTooShort {
        /// Minimum length in m.
        needed: f64,
        /// Width in m.
        width: f64,
        /// Height in m.
        height: f64,
    },
    /// An open side blocked by solids.
    #[error("solids block the open side `{0}` along its whole length; open another side, or leave a gap in the solids")]
    Blocked(&'static str),
    /// A parabola over several openings.
    #[error(
        "the side `{side}` has {openings} openings between its solids, and a parabola needs one; use profile = \"plug\" or a pressure"
    )]
    Openings {
        /// The side.
        side: &'static str,
        /// Number of its openings.
        openings: usize,
    },
    /// A solid or a pore that ends at an open side.
    #[error(
        "a shape ends at the open side `{side}` near ({:.3e}, {:.3e}) m; walls continue beyond an open side, so let the shape extend \
         {reach:.1e} m beyond it, or end before it", position.x, position.y
    )]
    EndsAtSide {
        /// The side.
        side: &'static str,
        /// Position in m.
        position: Vec2,
        /// Distance in m by which the shape must extend beyond the side.
        reach: f64,
    },
    /// No room for a single particle.
    #[error("no fluid particle fits into the pore at a spacing of {0:.3e} m; use a smaller spacing")]
    NoFluid(f64),
    /// A phase without a single particle, with a frozen interface.
    #[error(
        "the {0} phase has no particle in the pore, and relative permeabilities need both phases; enlarge its region in sph.initial"
    )]
    NoPhase(&'static str),
}

impl SetupError {
    /// The key of the case to change.
    pub fn key(&self) -> String {
        match self {
            Self::Geometry(_) => "geometry".to_owned(),
            Self::PeriodTooShort { .. } | Self::NoFluid(_) => "sph.spacing".to_owned(),
            Self::NoPhase(_) => "sph.initial".to_owned(),
            Self::Blocked(side) | Self::EndsAtSide { side, .. } => format!("sph.sides.{side}"),
            Self::Openings { side, .. } => format!("sph.sides.open.{side}.profile"),
        }
    }
}
