//! What the stages of a step hand on to each other.

use super::given_flow::Response;
use crate::math::Vec2;
use crate::sph::images::Field;
use crate::sph::open::InteriorPoints;

/// The intermediate state of a step [Huber2013, Eq. 25].
pub(super) struct Predicted {
    pub(super) dt: f64,
    pub(super) limit: &'static str,
    /// The largest velocity of a particle in m/s, relative to the mean of all.
    pub(super) fastest: f64,
    /// v_int in m/s, without the gravity that goes with the pressure.
    pub(super) velocity: Field<Vec2>,
    /// Where the buffers of open sides take the velocity from.
    pub(super) interior: InteriorPoints,
    /// What comes of the viscous solve.
    pub(super) damped: Damped,
}

/// What one pressure solve finds.
pub(super) struct Projected {
    /// Pressure in Pa, without the mean gradients that drive given flows.
    pub(super) pressure: Vec<f64>,
    /// What the pressure that the next step begins with has more, in Pa; empty for nothing.
    pub(super) viscous_pressure: Vec<f64>,
    /// The way in m that each fluid particle goes for the density-error correction by shifting, empty where there is none.
    pub(super) density_error_shift: Vec<Vec2>,
    /// What unit gradients along the periodic sides with a given flow do.
    pub(super) responses: Vec<Response>,
}

/// The end of a step before the particles move [Huber2013, Eq. 26].
pub(super) struct Corrected {
    /// Velocity of fluid and buffers in m/s.
    pub(super) velocity: Vec<Vec2>,
    /// By how much the mean gradients that drive given flows change, in Pa/m.
    pub(super) gradient_changes: Vec<f64>,
    /// What the pressure solve found, its pressure with these changes.
    pub(super) projected: Projected,
}

/// What comes of a viscous solve beside the acceleration; nothing of an explicit step.
#[derive(Default)]
pub(super) struct Damped {
    /// Acceleration of the fluid in m/s² by the pressure before the step.
    pub(super) by_pressure: Vec<Vec2>,
    /// The share of the step beyond the longest explicit one.
    pub(super) excess: f64,
    /// θ Δt in s, with the weight θ of the velocity at the end of the step.
    pub(super) weight: f64,
    /// Iterations.
    pub(super) iterations: usize,
}
