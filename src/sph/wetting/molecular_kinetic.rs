//! The molecular kinetic theory of a moving contact line [Blake1969].
//!
//! U = 2 κ_0 λ sinh(σ (cos θ_e − cos θ_d) λ²/(2 k T)): molecules jump by λ between sites of the wall, κ_0 times a second at rest.
//! The parameters come from fits to measured angles and hold for one pair of liquid and wall. Viscous bending is left to the flow.

use crate::sph::wetting::LineState;

/// Boltzmann's constant in J/K (SI 2019).
const BOLTZMANN: f64 = 1.380_649e-23;

/// A static angle and the jumps of molecules.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MolecularKinetic {
    /// Static angle θ_e in rad.
    pub contact_angle: f64,
    /// Frequency κ_0 of the jumps at rest in 1/s.
    pub frequency: f64,
    /// Length λ of a jump in m.
    pub jump_length: f64,
    /// Temperature T in K.
    pub temperature: f64,
}

impl MolecularKinetic {
    /// Dynamic angle θ_d in rad \[Blake1969\].
    #[must_use]
    pub fn angle(&self, line: &LineState) -> f64 {
        let work = 2.0 * BOLTZMANN * self.temperature / (line.tension * self.jump_length.powi(2));
        let jumps = line.speed / (2.0 * self.frequency * self.jump_length);
        (self.contact_angle.cos() - work * jumps.asinh()).clamp(-1.0, 1.0).acos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sph::wetting::LineFriction;

    #[test]
    fn a_slow_line_feels_a_friction_in_proportion_to_its_speed() {
        let model = MolecularKinetic { contact_angle: 1.0, frequency: 1.0e6, jump_length: 1.0e-9, temperature: 293.0 };
        let friction = BOLTZMANN * model.temperature / (model.frequency * model.jump_length.powi(3));
        let linear = LineFriction { contact_angle: 1.0, friction };
        let line = LineState { present: 1.0, speed: 2.0e-5, tension: 0.03, viscosity: 1.0e-3, length: 1.0e-5 };
        let (found, expected) = (model.angle(&line), linear.angle(&line));
        // asinh(x) = x - x^3/6 at x = 1e-2.
        assert!(((found - 1.0) / (expected - 1.0) - 1.0).abs() < 1e-4, "{found} {expected}");
        assert!(found - 1.0 > 1e-3);
    }
}
