//! Periodic sides with a given flow rate: the mean pressure gradient that drives it is an additional unknown of the pressure equation.
//!
//! The pressure is p − G·x with p periodic. The velocity at the end of the step is linear in G, so that for each direction w = ∂v/∂(Δt G) follows from an
//! additional right-hand side of the same matrix, and G from the required rate (Patankar, Liu and Sparrow 1977). The profile is not prescribed: it develops.

use nalgebra::{Matrix2, Vector2};

use crate::configuration::Configuration;
use crate::fields::Fields;
use crate::flow::Flow;
use crate::open::OpenSide;
use crate::parallel::{total, values};
use crate::poisson::Matrix;
use crate::surface_force::SurfaceForce;
use crate::terms::pressure_gradient;
use crate::view::View;
use meniscus_core::math::Vec2;
use meniscus_core::solver::SolverError;

/// Largest relative residual of a response: the change of G in a step is small, and so is the resulting divergence.
pub(super) const RESPONSE_RESIDUAL: f64 = 1e-3;

/// Fluid is connected between particles closer than this over dx: not through a wall, however thin.
const NEXT: f64 = 1.5;

/// Response to a mean pressure gradient of 1 Pa/m.
pub(super) struct Response {
    /// The periodic part of the pressure in m (Pa per Pa/m).
    pub(super) potential: Vec<f64>,
    /// The acceleration of the fluid particles in m³/kg (m/s² per Pa/m).
    pub(super) acceleration: Vec<Vec2>,
}

impl View<'_, Fields> {
    /// Whether pressure differences include the mean gradient; else it is a body force: sums that are not divided by their moment
    /// are not exact for linear pressures.
    pub(super) fn gradient_in_pressure(&self) -> bool {
        self.fields.interface.force.jump().is_some()
    }

    /// The right-hand side of the pressure equation for the unit gradient along `axis` \[PatankarLiuSparrow1977\]. `matrix` as assembled.
    pub(super) fn right_side_of_gradient(&self, axis: Vec2, matrix: &Matrix) -> Vec<f64> {
        if !self.gradient_in_pressure() {
            let by = (0..self.state.particles.moving()).map(|a| axis / self.fields.bulk.density[a]).collect();
            return self.minus_outflow(&self.neighborhood.images.velocity_field(by));
        }
        values(self.state.particles.len(), |a| {
            let coupling = &matrix.coupling[self.neighborhood.pairs.row(a)];
            self.neighborhood
                .pairs
                .of(a)
                .zip(coupling)
                .map(|(ab, coupling)| f64::from(*coupling) * axis.dot(&self.separation(a, ab.b)))
                .sum()
        })
    }

    /// The response to the unit gradient along `axis`, given the periodic part of its pressure.
    pub(super) fn response(&self, axis: Vec2, potential: Vec<f64>) -> Response {
        let (pairs, f, fluids) = (&self.neighborhood.pairs, &self.fields.bulk, self.state.particles.fluids);
        let extended = self.neighborhood.images.field(potential.clone());
        let mut acceleration;
        if let SurfaceForce::Jump { moment, .. } = &self.fields.interface.force {
            let rise = |a: usize, b: usize| -axis.dot(&self.separation(a, b));
            acceleration = pressure_gradient::difference(pairs, &f.volume, &f.density, &extended, rise, fluids);
            pressure_gradient::correct_gradient(moment, &mut acceleration);
        } else {
            acceleration = pressure_gradient::descent(pairs, &f.volume, &f.density, &extended, fluids);
            acceleration.iter_mut().zip(&*f.density).for_each(|(by, density)| *by += axis / *density);
        }
        Response { potential, acceleration }
    }

    /// Whether the fluid percolates through the period along the axis of the side.
    fn is_open(&self, side: &OpenSide) -> bool {
        let (inward, fluids) = (side.inward(), self.state.particles.fluids);
        let half = 0.5 * self.config.domain.bounds.size()[side.axis()];
        let reach = NEXT * self.config.method.spacing;
        // Unwrapped coordinate along the axis of each particle relative to the first of its component, along the connecting particles.
        let mut along = vec![f64::NAN; fluids];
        let mut waiting = Vec::new();
        for first in 0..fluids {
            if along[first].is_nan() {
                along[first] = 0.0;
                waiting.push(first);
            }
            while let Some(a) = waiting.pop() {
                for b in self.neighborhood.pairs.of(a).map(|ab| ab.b).filter(|&b| b < fluids) {
                    let r = self.separation(b, a);
                    if r.norm() > reach {
                        continue;
                    }
                    let here = along[a] + r.dot(&inward);
                    if along[b].is_nan() {
                        along[b] = here;
                        waiting.push(b);
                    } else if (along[b] - here).abs() > half {
                        return true;
                    }
                }
            }
        }
        false
    }
}

impl Flow {
    /// Gives the fluid at time zero the required flow rates: the initial velocity is made divergence-free, and the missing rate is added as by
    /// an impulsive pressure gradient.
    ///
    /// # Errors
    /// [`SolverError::Blocked`] if solids block the flow through a side, and errors of the pressure solve.
    pub(super) fn start_given_flow(&mut self) -> Result<(), SolverError> {
        let (flow, solve, work) = self.solving();
        let (through, particles) = (&flow.config.open.through, &flow.state.particles);
        if through.is_empty() {
            return Ok(());
        }
        if let Some(side) = through.iter().find(|side| !flow.is_open(side)) {
            return Err(SolverError::Blocked { side: side.name(), time: flow.state.time, step: flow.state.steps });
        }
        let moving = flow.neighborhood.images.velocity_field(particles.velocity[..particles.moving()].to_vec());
        let (by_walls, responses) = flow.project_kinematically(&moving, solve, work)?;
        let mut velocity = particles.velocity[..particles.fluids].to_vec();
        velocity.iter_mut().zip(&by_walls).for_each(|(v, by)| *v += by);
        let changes = gradient_changes(flow.config, &velocity, &responses, 1.0);
        add_responses(&mut velocity, &responses, &changes, 1.0);
        self.state.particles.velocity[..velocity.len()].copy_from_slice(&velocity);
        Ok(())
    }
}

/// The inward flow rate in m²/s through the side of fluid particles with the given velocities (m/s), averaged over the period.
fn flow_rate(config: &Configuration, side: &OpenSide, velocity: &[Vec2]) -> f64 {
    let (inward, period) = (side.inward(), config.domain.bounds.size()[side.axis()]);
    config.method.volume / period * total(velocity.len(), |a| velocity[a].dot(&inward))
}

/// The changes in Pa/m of the mean pressure gradients with which fluid of the given `velocity` (m/s) has the given flow rates at the end of a
/// step of length `dt` (s) \[PatankarLiuSparrow1977\].
pub(super) fn gradient_changes(config: &Configuration, velocity: &[Vec2], responses: &[Response], dt: f64) -> Vec<f64> {
    let through = &config.open.through;
    let missing = |i: usize| through[i].flow_rate() - flow_rate(config, &through[i], velocity);
    let rate = |i: usize, j: usize| dt * flow_rate(config, &through[i], &responses[j].acceleration);
    match through.len() {
        0 => vec![],
        1 => vec![missing(0) / rate(0, 0)],
        // One along each axis, coupled where solids deflect the flow.
        _ => {
            let rates = Matrix2::from_fn(rate);
            let changes = rates.lu().solve(&Vector2::new(missing(0), missing(1))).unwrap_or_default();
            vec![changes[0], changes[1]]
        }
    }
}

/// Corrects the `new` positions (m) of the fluid particles, so that the flow through the sides in a step of length `dt` (s) from the `old`
/// positions (m) is the required one: shifting and the density-error correction also transport fluid.
pub(super) fn keep_flow_rates(config: &Configuration, responses: &[Response], dt: f64, old: &[Vec2], new: &mut [Vec2]) {
    if responses.is_empty() {
        return;
    }
    let domain = &config.domain;
    let mut mean: Vec<Vec2> = new.iter().zip(old).map(|(&to, &from)| domain.separation(to, from) / dt).collect();
    let changes = gradient_changes(config, &mean, responses, dt);
    add_responses(&mut mean, responses, &changes, dt);
    new.iter_mut().zip(old).zip(mean).for_each(|((to, from), mean)| *to = domain.wrapped(from + dt * mean));
}

/// Adds to the `velocity` (m/s) of the fluid the effect of the changes (Pa/m) of the mean gradients in `dt` (s).
pub(super) fn add_responses(velocity: &mut [Vec2], responses: &[Response], changes: &[f64], dt: f64) {
    for (response, change) in responses.iter().zip(changes) {
        velocity.iter_mut().zip(&response.acceleration).for_each(|(v, by)| *v += dt * change * by);
    }
}
