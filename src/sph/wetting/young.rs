//! The unbalanced Young force (de Gennes 1985) as driving force of the contact line [Huber2013, Eq. 7].
//!
//! f = σ_ns − σ_ws − σ_wn cos α = σ_wn (cos θ − cos α): one angle, whatever the line does. Leaves out all that happens at the line
//! below the scale of the fit; how fast the line moves is left to the slip of the wall.

/// A static contact angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YoungForce {
    /// Static contact angle θ through the wetting phase, in rad: cos θ = (σ_ns − σ_ws)/σ_wn.
    pub contact_angle: f64,
}
