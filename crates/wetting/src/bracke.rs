//! The fit of Bracke, De Voeght and Joos of the apparent angles of tapes drawn into liquids [Bracke1989].
//!
//! (cos θ_e − cos θ_d)/(cos θ_e + 1) = 2 Ca^(1/2), for advancing lines; the same law describes capillary rise (Joos et al. 1990). For a receding line the
//! change of the cosine is taken with the opposite sign, an extrapolation without measurements. The angle is that far from the line, as in Jiang's fit. Above
//! the Ca at which it reaches 180 degrees (0.25 at θ_e = 0) it stays there.

use super::law::{LineState, Parameter, WettingModel, law};

law! {
    /// Fit of tapes drawn into liquids (Bracke, De Voeght and Joos 1989).
    pub struct Bracke {
        /// Static contact angle in degrees.
        pub contact_angle_deg: Parameter::CONTACT_ANGLE,
    }
}

impl WettingModel for Bracke {
    /// Dynamic angle θ_d in rad by the fit of tapes drawn into liquids \[Bracke1989\].
    fn angle(&self, line: &LineState) -> f64 {
        line.angle_by_change_of_cosine(self.static_angle(), 2.0 * line.capillary_number().abs().sqrt())
    }
}
