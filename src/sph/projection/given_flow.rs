//! Periodic sides with a given flow rate: the mean pressure gradient that drives it is one more unknown of the pressure equation.
//!
//! The pressure is p − G·x with p periodic. The velocity at the end of the step is linear in G, so that of each direction w = ∂v/∂(Δt G) is
//! found with one more right side of the same matrix, and G follows from the rate that is asked for (Patankar, Liu and Sparrow 1977). The
//! profile is not given: it develops.

use nalgebra::{Matrix2, Vector2};

use super::Flow;
use crate::math::Vec2;
use crate::solver::SolverError;
use crate::sph::open::Through;
use crate::sph::pairs::{each, total};
use crate::sph::poisson::Matrix;
use crate::sph::terms::pressure_gradient;

/// Largest relative residual of a response: the change of G in a step is small, and so is the divergence that this leaves of it.
pub(super) const RESPONSE_RESIDUAL: f64 = 1e-3;

/// Fluid goes on from a particle to those nearer than this over dx: not through a wall, however thin.
const NEXT: f64 = 1.5;

/// What a mean pressure gradient of 1 Pa/m does.
pub(in crate::sph) struct Response {
    /// The periodic part of the pressure in m (Pa per Pa/m).
    pub(super) potential: Vec<f64>,
    /// The acceleration of the fluid particles in m³/kg (m/s² per Pa/m).
    pub(super) acceleration: Vec<Vec2>,
}

impl Flow {
    /// The mean pressure gradient −∇P in Pa/m that drives the given flows.
    #[must_use]
    pub fn driving_gradient(&self) -> Vec2 {
        self.open.through.iter().map(|through| through.state.gradient * through.way()).sum()
    }

    /// Whether differences of pressure have the mean gradient in them; else it is a body force: sums that do not divide by their moment
    /// are not exact for linear pressures.
    pub(super) fn gradient_in_pressure(&self) -> bool {
        self.fields.jump.is_some()
    }

    /// The rate in m²/s at which particles of the given velocities pass the side of `through` inwards, on the mean over the period.
    pub(super) fn flow_rate(&self, through: &Through, velocity: &[Vec2]) -> f64 {
        let (way, period) = (through.way(), self.domain.bounds.size()[through.side.axis()]);
        self.method.volume / period * total(self.particles.fluids, |a| velocity[a].dot(&way))
    }

    /// The right side of the pressure equation for the unit gradient along `way`; `matrix` as assembled.
    pub(super) fn right_side_of_gradient(&self, way: Vec2, matrix: &Matrix) -> Vec<f64> {
        let n = self.particles.len();
        if !self.gradient_in_pressure() {
            let mut by = vec![Vec2::zeros(); n];
            (0..self.particles.moving()).for_each(|a| by[a] = way / self.fields.density[a]);
            self.images.extend_velocity(&mut by);
            return self.minus_outflow(&by);
        }
        let mut right = vec![0.0; n];
        each(&mut right, |a| {
            let coupling = &matrix.coupling[self.pairs.row(a)];
            self.pairs
                .of(a)
                .zip(coupling)
                .map(|(ab, coupling)| f64::from(*coupling) * way.dot(&self.separation(a, ab.b)))
                .sum()
        });
        right
    }

    /// What the unit gradient along `way` does, with the periodic part of its pressure.
    pub(super) fn response(&self, way: Vec2, potential: Vec<f64>) -> Response {
        let (pairs, f, fluids) = (&self.pairs, &self.fields, self.particles.fluids);
        let mut extended = potential.clone();
        self.images.extend(&mut extended);
        let mut acceleration = vec![Vec2::zeros(); fluids];
        if self.gradient_in_pressure() {
            let rise = |a: usize, b: usize| -way.dot(&self.separation(a, b));
            pressure_gradient::difference(pairs, &f.volume, &f.density, &extended, rise, &mut acceleration);
            pressure_gradient::correct_gradient(&f.moment, &mut acceleration);
        } else {
            pressure_gradient::difference(pairs, &f.volume, &f.density, &extended, |_, _| 0.0, &mut acceleration);
            acceleration.iter_mut().zip(&f.density).for_each(|(by, density)| *by += way / *density);
        }
        Response { potential, acceleration }
    }

    /// x_a − x_b in m, of a particle and a particle or image.
    pub(super) fn separation(&self, a: usize, b: usize) -> Vec2 {
        let x = &self.particles.position;
        self.domain.separation(x[a], self.images.position(b, x))
    }

    /// The changes in Pa/m of the mean pressure gradients after which the fluid, now at the given `velocity` (m/s), has the given flow rates at
    /// the end of a step of length `dt` (s).
    pub(super) fn gradient_changes(&self, velocity: &[Vec2], responses: &[Response], dt: f64) -> Vec<f64> {
        let through = &self.open.through;
        let missing = |i: usize| through[i].flow_rate() - self.flow_rate(&through[i], velocity);
        let rate = |i: usize, j: usize| dt * self.flow_rate(&through[i], &responses[j].acceleration);
        match through.len() {
            0 => vec![],
            1 => vec![missing(0) / rate(0, 0)],
            // One along each axis, coupled where solids lead the fluid aside.
            _ => {
                let rates = Matrix2::from_fn(rate);
                let changes = rates.lu().solve(&Vector2::new(missing(0), missing(1))).unwrap_or_default();
                vec![changes[0], changes[1]]
            }
        }
    }

    /// Whether fluid that goes on from particle to particle along the axis of `through` comes back to itself.
    fn is_open(&self, through: &Through) -> bool {
        let (way, fluids) = (through.way(), self.particles.fluids);
        let half = 0.5 * self.domain.bounds.size()[through.side.axis()];
        let reach = NEXT * self.method.spacing;
        // How far along the axis each particle stands from the first of its part, by the particles between.
        let mut along = vec![f64::NAN; fluids];
        let mut waiting = Vec::new();
        for first in 0..fluids {
            if along[first].is_nan() {
                along[first] = 0.0;
                waiting.push(first);
            }
            while let Some(a) = waiting.pop() {
                for b in self.pairs.of(a).map(|ab| ab.b).filter(|&b| b < fluids) {
                    let r = self.separation(b, a);
                    if r.norm() > reach {
                        continue;
                    }
                    let here = along[a] + r.dot(&way);
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

    /// Sets the places `new` (m) of the fluid particles anew, so that what went through the sides in a step of length `dt` (s) from the places at
    /// its beginning is what is asked for: shifting and the density-error correction carry some along.
    pub(in crate::sph) fn keep_flow_rates(&self, responses: &[Response], dt: f64, new: &mut [Vec2]) {
        if responses.is_empty() {
            return;
        }
        let old = &self.particles.position;
        let mut mean: Vec<Vec2> =
            new.iter().zip(old).map(|(&to, &from)| self.domain.separation(to, from) / dt).collect();
        let changes = self.gradient_changes(&mean, responses, dt);
        add_responses(&mut mean, responses, &changes, dt);
        new.iter_mut().zip(old).zip(mean).for_each(|((to, from), mean)| *to = self.domain.wrapped(from + dt * mean));
    }

    /// Gives the fluid at time zero the flow rates that are asked for: what it has is made free of divergence, and what is missing is added as
    /// a pressure gradient that sets in at once does.
    ///
    /// # Errors
    /// [`SolverError::Blocked`] where solids close the way along a side, and what the pressure solve returns.
    pub(super) fn start_given_flow(&mut self) -> Result<(), SolverError> {
        if self.open.through.is_empty() {
            return Ok(());
        }
        if let Some(through) = self.open.through.iter().find(|through| !self.is_open(through)) {
            return Err(SolverError::Blocked { side: through.side.name(), time: self.time, step: self.steps });
        }
        let mut velocity = self.particles.velocity.clone();
        velocity[self.particles.moving()..].fill(Vec2::zeros());
        self.images.extend_velocity(&mut velocity);
        let (by_walls, responses) = self.project_kinematically(&velocity)?;
        let fluids = self.particles.fluids;
        velocity.truncate(fluids);
        velocity.iter_mut().zip(&by_walls).for_each(|(v, by)| *v += by);
        let changes = self.gradient_changes(&velocity, &responses, 1.0);
        add_responses(&mut velocity, &responses, &changes, 1.0);
        self.particles.velocity[..fluids].copy_from_slice(&velocity);
        Ok(())
    }
}

/// Adds to the `velocity` (m/s) of the fluid what the changes (Pa/m) of the mean gradients do in `dt` (s).
pub(super) fn add_responses(velocity: &mut [Vec2], responses: &[Response], changes: &[f64], dt: f64) {
    for (response, change) in responses.iter().zip(changes) {
        velocity.iter_mut().zip(&response.acceleration).for_each(|(v, by)| *v += dt * change * by);
    }
}
