//! The unbalanced Young force (de Gennes 1985) as driving force of the contact line [Huber2013, Eq. 7].
//!
//! f = σ_ns − σ_ws − σ_wn cos α = σ_wn (cos θ − cos α): a constant angle, independent of the line. Effects at the line below the scale of the fit are not
//! included; the speed of the line follows from the slip of the wall.

use super::law::{LineState, Parameter, WettingModel, law};

law! {
    /// Static angle by the unbalanced Young force (de Gennes 1985; Huber et al. 2013, Eqs. 7 and 23).
    pub struct Young {
        /// Static contact angle in degrees.
        pub contact_angle_deg: Parameter::CONTACT_ANGLE,
    }
}

impl WettingModel for Young {
    /// θ: cos θ = (σ_ns − σ_ws)/σ_wn.
    fn angle(&self, _: &LineState) -> f64 {
        self.static_angle()
    }

    fn is_dynamic(&self) -> bool {
        false
    }
}
