//! The fit of Jiang, Oh and Slattery of the apparent angles that Hoffman measured in capillaries [Jiang1979; Hoffman1975].
//!
//! (cos θ_e − cos θ_d)/(cos θ_e + 1) = tanh(4.96 Ca^0.702), for advancing lines. For a receding line the change of the cosine is taken with the opposite
//! sign, an extrapolation without measurements. The angle is that far from the line, as in Kistler's fit.

use super::law::{LineState, Parameter, WettingModel, law};

law! {
    /// Fit of Hoffman's data (Jiang, Oh and Slattery 1979).
    pub struct Jiang {
        /// Static contact angle in degrees.
        pub contact_angle_deg: Parameter::CONTACT_ANGLE,
    }
}

impl WettingModel for Jiang {
    /// Dynamic angle θ_d in rad by the fit of Jiang, Oh and Slattery to Hoffman's curve [Jiang1979, Eq. 7].
    fn angle(&self, line: &LineState) -> f64 {
        let change = (4.96 * line.capillary_number().abs().powf(0.702)).tanh();
        line.angle_by_change_of_cosine(self.static_angle(), change)
    }
}
