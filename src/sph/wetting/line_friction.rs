//! Friction of the contact line in proportion to its speed [BrochardWyart1992; deGennes1985].
//!
//! σ (cos θ_e − cos θ_d) = ζ U: what the unbalanced Young force does not spend on the fluid is spent at the line. The linear limit
//! of the molecular kinetic theory, with ζ = k T/(κ_0 λ³). Beyond |U| = 2 σ/ζ the angle stays at 0 or 180 degrees.

use crate::sph::wetting::LineState;

/// A static angle and a friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineFriction {
    /// Static angle θ_e in rad.
    pub contact_angle: f64,
    /// Friction ζ in Pa s.
    pub friction: f64,
}

impl LineFriction {
    /// Dynamic angle θ_d in rad \[BrochardWyart1992\].
    #[must_use]
    pub fn angle(&self, line: &LineState) -> f64 {
        (self.contact_angle.cos() - self.friction * line.speed / line.tension).clamp(-1.0, 1.0).acos()
    }
}
