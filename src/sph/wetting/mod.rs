//! Contact lines tracked from step to step, and the contact line force as a volume force.
//!
//! The division follows the paper (section 3.2): a wetting model (`crate::wetting`) gives the contact angle to impose, depending on the
//! motion of the line. With the pressure jump the circle fit meets the wall at that angle θ; with the continuum force the line is driven
//! by σ (cos θ − cos α), which `contact_line` distributes over the particles. `lines` tracks the lines and determines their speeds.

pub mod contact_line;
pub mod lines;
pub(crate) mod wall;

/// Driving force f_wns = σ (cos θ − cos α) in N/m along ν_ns, from the wetting to the other phase [Huber2013, Eq. 7].
pub(crate) fn driving_force(tension: f64, angle: f64, cos_alpha: f64) -> f64 {
    tension * (angle.cos() - cos_alpha)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Huber2013, Eq. 7]
    #[test]
    fn a_line_at_its_static_angle_feels_no_force() {
        for degrees in [0.0_f64, 40.0, 90.0, 140.0, 180.0] {
            let angle = degrees.to_radians();
            assert_eq!(driving_force(0.07, angle, angle.cos()), 0.0);
        }
    }

    /// [Huber2013, Eq. 7]
    #[test]
    fn a_line_that_stands_too_steep_is_driven_outwards() {
        assert!(driving_force(1.0, 1.0, 1.5_f64.cos()) > 0.0);
        assert!(driving_force(1.0, 1.0, 0.5_f64.cos()) < 0.0);
    }
}
