//! Viscous bending of the interface below the spacing, between two fluids of any viscosities [Cox1986].
//!
//! Near a moving contact line dθ/d ln r = Ca f(θ, q), with q the viscosity of the other phase over that of the wetting one. A wall with slip length λ keeps
//! the static angle up to about r = λ; the simulated flow keeps the imposed angle up to about the slip length b of the walls near lines, which the spacing
//! resolves. With ∫ dθ/f = Ca ln(b/λ) between the two angles, both flows agree farther out, so that neither speeds nor shapes depend on the spacing. Valid
//! for capillary numbers below about 0.1; inertia is neglected.

use std::f64::consts::PI;

use super::law::{LineState, Parameter, WettingModel, law};

/// Intervals of Simpson's rule.
const INTERVALS: usize = 24;

/// Maximum number of bisection and Newton steps for the angle; about four Newton steps suffice.
const STEPS: usize = 40;

/// Tolerance of the angle in rad.
const TOLERANCE: f64 = 1e-7;

law! {
    /// Viscous bending below the spacing, for any ratio of viscosities (Cox 1986).
    pub struct Cox {
        /// Static contact angle in degrees.
        pub contact_angle_deg: Parameter::CONTACT_ANGLE,
        /// Slip length of the wall in m, of the order of nanometers.
        pub slip_length: Parameter::positive("a slip length in m", "slip-length = 1.0e-9 # m"),
    }
}

impl WettingModel for Cox {
    /// θ_d in rad with ∫ dθ/f(θ, q) = Ca ln(b/λ) from θ_e to θ_d \[Cox1986\]. 0 or π where there is no solution, as the line then deposits a film.
    fn angle(&self, line: &LineState) -> f64 {
        let static_angle = self.static_angle();
        let decades = (line.slip_length / self.slip_length).ln().max(0.0);
        let wanted = line.capillary_number() * decades;
        if wanted == 0.0 {
            return static_angle;
        }
        let q = line.other_viscosity / line.viscosity;
        let turned = |angle: f64| bending(static_angle, angle, q);
        let [mut low, mut high] = if wanted > 0.0 { [static_angle, PI] } else { [0.0, static_angle] };
        if turned(low) >= wanted {
            return low;
        }
        if turned(high) <= wanted {
            return high;
        }
        let mut angle = static_angle;
        for _ in 0..STEPS {
            let missing = wanted - turned(angle);
            let bound = if missing > 0.0 { &mut low } else { &mut high };
            *bound = angle;
            let newton = angle + missing / inverse_of_f(angle, q);
            let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            if (next - angle).abs() < TOLERANCE {
                return next;
            }
            angle = next;
        }
        angle
    }
}

/// g(b) − g(a) = ∫ dθ/f(θ, q) from a to b in rad, by Simpson's rule.
fn bending(a: f64, b: f64, q: f64) -> f64 {
    let h = (b - a) / INTERVALS as f64;
    let weight = |i: usize| if i % 2 == 1 { 4.0 } else { 2.0 };
    let inner = (1..INTERVALS).map(|i| weight(i) * inverse_of_f(a + i as f64 * h, q));
    h / 3.0 * (inverse_of_f(a, q) + inner.sum::<f64>() + inverse_of_f(b, q))
}

/// 1/f(θ, q) of Cox 1986, smooth and 0 at θ = 0.
fn inverse_of_f(angle: f64, q: f64) -> f64 {
    // Below this, and as near to π, the differences cancel: the leading terms θ²/3 and q (π − θ)²/3.
    const SMALL: f64 = 1e-2;
    let other = PI - angle;
    if angle < SMALL {
        return angle * angle / 3.0;
    }
    if q > 0.0 && other < SMALL * q.min(1.0) {
        return q * other * other / 3.0;
    }
    let (sin, cos) = angle.sin_cos();
    let (wetting, opposite) = (angle * angle - sin * sin, other * other - sin * sin);
    let above = q * wetting * (other + sin * cos) + opposite * (angle - sin * cos);
    let below = 2.0 * sin * (q * q * wetting + 2.0 * q * (angle * other + sin * sin) + opposite);
    if below > 0.0 { above / below } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(speed: f64, q: f64, slip_length: f64) -> LineState {
        LineState { present: 0.0, speed, tension: 1.0, viscosity: 1.0, other_viscosity: q, length: 1.0, slip_length }
    }

    /// [Cox1986]
    #[test]
    fn beside_a_gas_small_angles_follow_the_law_of_voinov() {
        let model = Cox { contact_angle_deg: 40.0, slip_length: 1e-3 };
        for speed in [-1e-3, 1e-3, 5e-3] {
            let cube = 40_f64.to_radians().powi(3) + 9.0 * speed * 1e3_f64.ln();
            let found = model.angle(&line(speed, 0.0, 1.0)).to_degrees();
            assert!((found - cube.cbrt().to_degrees()).abs() < 0.3, "{found}");
        }
    }

    /// [Cox1986]
    #[test]
    fn the_same_line_told_through_the_other_phase_has_the_other_angle() {
        for (degrees, q, speed) in [(60.0, 0.3, 0.02), (90.0, 1.0, -0.02), (130.0, 5.0, 0.004)] {
            let here = Cox { contact_angle_deg: degrees, slip_length: 0.01 }.angle(&line(speed, q, 1.0));
            // The other phase recedes, and its capillary number has its own viscosity.
            let there = LineState { viscosity: q, other_viscosity: 1.0, ..line(-speed, q, 1.0) };
            let there = Cox { contact_angle_deg: 180.0 - degrees, slip_length: 0.01 }.angle(&there);
            assert!((here + there - PI).abs() < 1e-6, "{here} {there}");
        }
    }

    /// [Cox1986]
    #[test]
    fn equal_fluids_bend_at_a_right_angle_by_the_closed_value() {
        // f(π/2, 1) = 2π/(π²/4 − 1).
        let f = 2.0 * PI / (0.25 * PI * PI - 1.0);
        assert!((inverse_of_f(0.5 * PI, 1.0) * f - 1.0).abs() < 1e-12);
        let model = Cox { contact_angle_deg: 90.0, slip_length: 0.5 };
        let found = model.angle(&line(1e-4, 1.0, 1.0));
        assert!((found - 0.5 * PI - 1e-4 * f * 2_f64.ln()).abs() < 1e-6, "{found}");
    }

    #[test]
    fn a_resolved_slip_length_and_rest_leave_the_static_angle_and_fast_lines_end_at_0_and_180_degrees() {
        let model = Cox { contact_angle_deg: 50.0, slip_length: 1e-6 };
        assert_eq!(model.angle(&line(0.1, 1.0, 1e-6)), 50_f64.to_radians());
        assert_eq!(model.angle(&line(0.0, 1.0, 1.0)), 50_f64.to_radians());
        assert_eq!(model.angle(&line(-1.0, 1.0, 1.0)), 0.0);
        assert_eq!(model.angle(&line(1.0, 1.0, 1.0)), PI);
    }
}
