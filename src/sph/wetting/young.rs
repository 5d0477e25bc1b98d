//! The unbalanced Young force (de Gennes 1985) as driving force of the contact line [Huber2013, Eq. 7].

use crate::sph::wetting::LineState;

/// f = σ_ns − σ_ws − σ_wn cos α = σ_wn (cos θ − cos α).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YoungForce {
    /// Static contact angle θ through the wetting phase, in rad: cos θ = (σ_ns − σ_ws)/σ_wn.
    pub contact_angle: f64,
}

impl YoungForce {
    /// Driving force in N/m along ν_ns [Huber2013, Eq. 7]: zero where the angle is the static one.
    #[must_use]
    pub fn driving_force(&self, line: &LineState) -> f64 {
        line.tension * (self.contact_angle.cos() - line.cos_alpha)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_at_its_static_angle_feels_no_force() {
        for degrees in [0.0_f64, 40.0, 90.0, 140.0, 180.0] {
            let contact_angle = degrees.to_radians();
            let line = LineState { cos_alpha: contact_angle.cos(), tension: 0.07 };
            assert_eq!(YoungForce { contact_angle }.driving_force(&line), 0.0);
        }
    }

    #[test]
    fn a_line_that_stands_too_steep_is_driven_outwards() {
        let model = YoungForce { contact_angle: 1.0 };
        assert!(model.driving_force(&LineState { cos_alpha: 1.5_f64.cos(), tension: 1.0 }) > 0.0);
        assert!(model.driving_force(&LineState { cos_alpha: 0.5_f64.cos(), tension: 1.0 }) < 0.0);
    }
}
