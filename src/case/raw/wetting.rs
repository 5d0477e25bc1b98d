//! `[sph.wetting]`: models of the contact angle and parts of the walls that differ.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::RawSideName;

tables! {
    /// Wetting models, exactly one of them, and parts of the walls that differ.
    pub struct RawWetting {
        /// Unbalanced Young force at the contact line, Huber et al. 2013, Eqs. 7 and 23.
        pub young: RawContactAngle,
        /// Static angle from an advancing and a receding one, Tadmor 2004.
        pub tadmor: RawAngleWindow,
        /// Friction of the line in proportion to its speed, Brochard-Wyart and de Gennes 1992.
        pub line_friction: RawLineFriction,
        /// Molecular kinetic theory, Blake and Haynes 1969.
        pub molecular_kinetic: RawMolecularKinetic,
        /// Viscous bending between the slip length and the scale of the fit, Voinov 1976, Cox 1986.
        pub cox_voinov: RawCoxVoinov,
        /// Fit of Hoffman's data, Kistler 1993.
        pub kistler: RawContactAngle,
        /// Fit of Hoffman's data, Jiang et al. 1979.
        pub jiang: RawContactAngle,
        /// A line that holds between the receding and the advancing angle.
        pub hysteresis: RawAngleWindow,
        /// Parts of the walls with angles of their own; later ones lie over earlier ones.
        pub patches: Vec<RawWettingPatch>,
    }

    /// A static contact angle.
    pub struct RawContactAngle {
        /// Static contact angle through the wetting phase in degrees, 0 to 180.
        pub contact_angle_deg: f64,
    }

    /// Two contact angles.
    pub struct RawAngleWindow {
        /// Advancing angle through the wetting phase in degrees, 0 to 180.
        pub advancing_angle_deg: f64,
        /// Receding angle in degrees, 0 to the advancing one.
        pub receding_angle_deg: f64,
    }

    /// Line friction.
    pub struct RawLineFriction {
        /// Static contact angle through the wetting phase in degrees, 0 to 180.
        pub contact_angle_deg: f64,
        /// Friction in Pa s: tension times (cosine of the static less cosine of the dynamic angle) over the speed.
        pub friction: f64,
    }

    /// Molecular kinetic theory.
    pub struct RawMolecularKinetic {
        /// Static contact angle through the wetting phase in degrees, 0 to 180.
        pub contact_angle_deg: f64,
        /// Frequency of the jumps of molecules at rest in 1/s.
        pub frequency: f64,
        /// Length of a jump in m.
        pub jump_length: f64,
        /// Temperature in degrees Celsius (default 20).
        pub temperature_c: f64,
    }

    /// Law of Cox and Voinov.
    pub struct RawCoxVoinov {
        /// Static contact angle through the wetting phase in degrees, 0 to 180.
        pub contact_angle_deg: f64,
        /// Slip length of the liquid on its wall in m.
        pub slip_length: f64,
    }

    /// A part of the walls with angles of its own: those of the model.
    pub struct RawWettingPatch {
        /// Number of a shape of the geometry, from 0 on in the order of the file; not with `side` (default all walls).
        pub shape: u32,
        /// A side of the domain that is a wall; not with `shape`.
        pub side: RawSideName,
        /// Stripes of the wall (default all of it).
        pub stripes: RawStripes,
        /// Static contact angle in degrees, for models that have one.
        pub contact_angle_deg: f64,
        /// Advancing angle in degrees, for models that have one.
        pub advancing_angle_deg: f64,
        /// Receding angle in degrees, for models that have one.
        pub receding_angle_deg: f64,
    }

    /// Stripes of a wall.
    pub struct RawStripes {
        /// Coordinate that runs across the stripes (default `x`).
        pub along: RawAxis,
        /// Where a stripe begins, in m (default 0).
        pub start: f64,
        /// Width of a stripe in m.
        pub width: f64,
        /// From the beginning of one stripe to that of the next in m (default: a single stripe).
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
