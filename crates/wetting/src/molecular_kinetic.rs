//! The molecular kinetic theory of a moving contact line [Blake1969].
//!
//! U = 2 κ_0 λ sinh(σ (cos θ_e − cos θ_d) λ²/(2 k T)): molecules jump a distance λ between adsorption sites of the wall with the equilibrium frequency κ_0.
//! The parameters are fitted to measured angles and hold for one pair of liquid and wall. Viscous bending is left to the flow.

use super::law::{InSi, LineState, Parameter, WettingModel, law};
use meniscus_core::input::tables::Key;

/// Boltzmann's constant in J/K (SI 2019).
const BOLTZMANN: f64 = 1.380_649e-23;

/// 0 degrees Celsius in K.
const FREEZING: f64 = 273.15;

/// Range of temperatures of contact line measurements with liquids.
const TEMPERATURE: Parameter = Parameter {
    key: Key::within("a temperature in degrees Celsius", -100.0, 500.0).example("temperature-c = 20.0").default(20.0),
    si: Some(InSi { name: "temperature", of: kelvin }),
};

law! {
    /// Molecular kinetic theory (Blake and Haynes 1969).
    pub struct MolecularKinetic {
        /// Static contact angle in degrees.
        pub contact_angle_deg: Parameter::CONTACT_ANGLE,
        /// Jump frequency of molecules at rest in 1/s.
        pub frequency: Parameter::positive("a frequency in 1/s", "frequency = 1.0e6 # 1/s"),
        /// Jump length in m.
        pub jump_length: Parameter::positive("a length in m", "jump-length = 1.0e-9 # m"),
        /// Temperature in °C (default 20).
        pub temperature_c: TEMPERATURE,
    }
}

impl WettingModel for MolecularKinetic {
    /// Dynamic angle θ_d in rad by molecular kinetic theory \[Blake1969\].
    fn angle(&self, line: &LineState) -> f64 {
        let work = 2.0 * BOLTZMANN * kelvin(self.temperature_c) / (line.tension * self.jump_length.powi(2));
        let jumps = line.speed / (2.0 * self.frequency * self.jump_length);
        (self.static_angle().cos() - work * jumps.asinh()).clamp(-1.0, 1.0).acos()
    }
}

/// T in K from °C.
fn kelvin(celsius: f64) -> f64 {
    celsius + FREEZING
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LineFriction;

    /// [Blake1969]
    #[test]
    fn a_slow_line_feels_a_friction_in_proportion_to_its_speed() {
        let model =
            MolecularKinetic { contact_angle_deg: 57.3, frequency: 1.0e6, jump_length: 1.0e-9, temperature_c: 19.85 };
        let friction = BOLTZMANN * kelvin(model.temperature_c) / (model.frequency * model.jump_length.powi(3));
        let linear = LineFriction { contact_angle_deg: 57.3, friction };
        let line = LineState { present: 1.0, speed: 2.0e-5, tension: 0.03, viscosity: 1.0e-3, ..LineState::default() };
        let (found, expected) = (model.angle(&line), linear.angle(&line));
        let rest = model.static_angle();
        // asinh(x) = x - x^3/6 at x = 1e-2.
        assert!(((found - rest) / (expected - rest) - 1.0).abs() < 1e-4, "{found} {expected}");
        assert!(found - rest > 1e-3);
    }
}
