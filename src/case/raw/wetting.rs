//! `[sph.wetting]`: models of the contact angle and parts of the walls that differ.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::RawSideName;

tables! {
    /// Wetting models, exactly one of them, and parts of the walls that differ.
    pub struct RawWetting {
        /// Static angle by the unbalanced Young force (Huber et al. 2013, Eqs. 7 and 23).
        pub young: RawContactAngle,
        /// Static angle from the advancing and the receding one (Tadmor 2004).
        pub tadmor: RawAngleWindow,
        /// Contact line friction (Brochard-Wyart and de Gennes 1992).
        pub line_friction: RawLineFriction,
        /// Molecular kinetic theory (Blake and Haynes 1969).
        pub molecular_kinetic: RawMolecularKinetic,
        /// Viscous bending below the resolved scale (Voinov 1976, Cox 1986).
        pub cox_voinov: RawCoxVoinov,
        /// Fit of Hoffman's data (Kistler 1993).
        pub kistler: RawContactAngle,
        /// Fit of Hoffman's data (Jiang, Oh and Slattery 1979).
        pub jiang: RawContactAngle,
        /// Contact lines pinned between the receding and the advancing angle.
        pub hysteresis: RawAngleWindow,
        /// Parts of the walls with angles of their own, in the same model; later ones override earlier ones.
        pub patches: Vec<RawWettingPatch>,
    }

    /// A static contact angle.
    pub struct RawContactAngle {
        /// Static contact angle in degrees.
        pub contact_angle_deg: f64,
    }

    /// Two contact angles.
    pub struct RawAngleWindow {
        /// Advancing contact angle in degrees.
        pub advancing_angle_deg: f64,
        /// Receding contact angle in degrees, 0 to the advancing one.
        pub receding_angle_deg: f64,
    }

    /// Line friction.
    pub struct RawLineFriction {
        /// Static contact angle in degrees.
        pub contact_angle_deg: f64,
        /// Friction coefficient `ζ` in Pa s: unbalanced Young force over line speed.
        pub friction: f64,
    }

    /// Molecular kinetic theory.
    pub struct RawMolecularKinetic {
        /// Static contact angle in degrees.
        pub contact_angle_deg: f64,
        /// Jump frequency of molecules at rest in 1/s.
        pub frequency: f64,
        /// Jump length in m.
        pub jump_length: f64,
        /// Temperature in °C (default 20).
        pub temperature_c: f64,
    }

    /// Law of Cox and Voinov.
    pub struct RawCoxVoinov {
        /// Static contact angle in degrees.
        pub contact_angle_deg: f64,
        /// Slip length of the liquid on its wall in m.
        pub slip_length: f64,
    }

    /// A part of the walls with angles of its own: those of the model.
    pub struct RawWettingPatch {
        /// Shape whose surface is the patch, counted from 0; not with `side` (default: all walls).
        pub shape: u32,
        /// Wall side that is the patch (default: all walls).
        pub side: RawSideName,
        /// Stripes of the patch (default: the whole patch).
        pub stripes: RawStripes,
        /// Static angle in degrees (required if the model has one).
        pub contact_angle_deg: f64,
        /// Advancing angle in degrees (required if the model has one).
        pub advancing_angle_deg: f64,
        /// Receding angle in degrees, 0 to the advancing one (required if the model has one).
        pub receding_angle_deg: f64,
    }

    /// Stripes of a wall.
    pub struct RawStripes {
        /// Coordinate across the stripes (default `x`).
        pub along: RawAxis,
        /// Start of the first stripe in m (default 0).
        pub start: f64,
        /// Width of a stripe in m.
        pub width: f64,
        /// Distance from stripe to stripe in m, at least the width (default: a single stripe).
        pub period: f64,
    }
}

/// An axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawAxis {
    /// The first coordinate.
    X,
    /// The second coordinate.
    Y,
}
