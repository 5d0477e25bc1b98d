//! Kistler's fit of the apparent angles that Hoffman measured in capillaries [Kistler1993; Hoffman1975].
//!
//! θ_d = f_H(Ca + f_H⁻¹(θ_e)), f_H(x) = arccos(1 − 2 tanh(5.16 (x/(1 + 1.31 x^0.99))^0.706)). Measured for silicone oils displacing air in glass capillaries;
//! receding lines continue the same curve. The angle is that far from the line: with a finely resolved flow, viscous bending is counted twice.

use std::f64::consts::PI;

use super::law::{LineState, Parameter, WettingModel, law};

law! {
    /// Fit of Hoffman's data (Kistler 1993; Hoffman 1975).
    pub struct Kistler {
        /// Static contact angle in degrees.
        pub contact_angle_deg: Parameter::CONTACT_ANGLE,
    }
}

/// Above this argument Hoffman's function equals 180 degrees to rounding.
const LARGEST_ARGUMENT: f64 = 1.0e3;

impl WettingModel for Kistler {
    /// Dynamic angle θ_d in rad by Kistler's fit of Hoffman's curve \[Kistler1993\].
    fn angle(&self, line: &LineState) -> f64 {
        hoffman((line.capillary_number() + shift(self.static_angle())).max(0.0))
    }
}

/// f_H, increasing from 0 to π.
fn hoffman(x: f64) -> f64 {
    let inner = 5.16 * (x / (1.0 + 1.31 * x.powf(0.99))).powf(0.706);
    (1.0 - 2.0 * inner.tanh()).clamp(-1.0, 1.0).acos().min(PI)
}

/// f_H⁻¹ by bisection: f_H is increasing.
fn shift(angle: f64) -> f64 {
    let (mut low, mut high) = (0.0, LARGEST_ARGUMENT);
    // From 1e3 to the last bit of 1e-6.
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if hoffman(middle) < angle { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
