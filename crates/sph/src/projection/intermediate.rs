//! Intermediate results passed between the stages of a step.

use super::given_flow::Response;
use crate::images::Field;
use crate::open::InteriorPoints;
use meniscus_core::math::Vec2;

/// The intermediate state of a step, after the predictor.
pub(super) struct Predicted {
    pub(super) dt: f64,
    pub(super) limit: &'static str,
    /// The largest speed of a particle in m/s, relative to the mean velocity of all.
    pub(super) fastest: f64,
    /// v_int in m/s, without the gravity that the pressure balances.
    pub(super) velocity: Field<Vec2>,
    /// Interior points, for the velocity of the buffers of open sides.
    pub(super) interior: InteriorPoints,
    /// Results of the viscous solve.
    pub(super) damped: Damped,
}

/// Results of the pressure solve.
pub(super) struct Projected {
    /// Pressure in Pa, without the mean gradients that drive given flows.
    pub(super) pressure: Vec<f64>,
    /// Addition to the pressure for the start of the next step, in Pa; empty for zero.
    pub(super) viscous_pressure: Vec<f64>,
    /// Displacement in m of each fluid particle by the density-error correction by shifting, empty without it.
    pub(super) density_error_shift: Vec<Vec2>,
    /// Responses to unit gradients along the periodic sides with a given flow.
    pub(super) responses: Vec<Response>,
}

/// The end of a step before the particles move, after the corrector.
pub(super) struct Corrected {
    /// Velocity of fluid and buffers in m/s.
    pub(super) velocity: Vec<Vec2>,
    /// Changes of the mean gradients that drive given flows, in Pa/m.
    pub(super) gradient_changes: Vec<f64>,
    /// Results of the pressure solve, with these changes in the pressure.
    pub(super) projected: Projected,
}

/// Results of a viscous solve besides the acceleration; empty for an explicit step.
#[derive(Default)]
pub(super) struct Damped {
    /// Acceleration of the fluid in m/s² by the pressure of the previous step.
    pub(super) by_pressure: Vec<Vec2>,
    /// The fraction of the step beyond the longest explicit one.
    pub(super) excess: f64,
    /// θ Δt in s, with the weight θ of the velocity at the end of the step.
    pub(super) weight: f64,
    /// Number of iterations.
    pub(super) iterations: usize,
}
