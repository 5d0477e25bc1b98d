//! Contact line friction proportional to the speed of the line [BrochardWyart1992; deGennes1985].
//!
//! σ (cos θ_e − cos θ_d) = ζ U: the part of the unbalanced Young force that is dissipated at the line rather than in the fluid. The linear limit of the
//! molecular kinetic theory, with ζ = k T/(κ_0 λ³). For |U| > 2 σ/ζ the angle stays at 0 or 180 degrees.

use super::law::{LineState, Parameter, WettingModel, law};

law! {
    /// Contact line friction (Brochard-Wyart and de Gennes 1992).
    pub struct LineFriction {
        /// Static contact angle in degrees.
        pub contact_angle_deg: Parameter::CONTACT_ANGLE,
        /// Friction coefficient `ζ` in Pa s: unbalanced Young force over line speed.
        pub friction: Parameter::positive("a friction in Pa s", "friction = 0.05 # Pa s"),
    }
}

impl WettingModel for LineFriction {
    /// Dynamic angle θ_d in rad by contact line friction \[BrochardWyart1992\].
    fn angle(&self, line: &LineState) -> f64 {
        (self.static_angle().cos() - self.friction * line.speed / line.tension).clamp(-1.0, 1.0).acos()
    }
}
