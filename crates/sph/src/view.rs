//! Read access to a flow at one time.

use crate::configuration::Configuration;
use crate::conjugate_gradients::Convergence;
use crate::images::Field;
use crate::neighborhood::Neighborhood;
use crate::open::{GivenFlow, OpenSide};
use crate::state::FlowState;
use meniscus_core::math::Vec2;
use meniscus_core::solver::SolverError;

/// Configuration, state, neighborhood, and the fields `F` computed from these so far: a function with a view as argument reads no other
/// fields and changes nothing.
pub struct View<'a, F> {
    /// Configuration.
    pub config: &'a Configuration,
    /// State from which a step starts.
    pub state: &'a FlowState,
    /// Pairs and images.
    pub neighborhood: &'a Neighborhood,
    /// The fields.
    pub fields: &'a F,
}

impl<'a, F> View<'a, F> {
    /// The flow with other fields.
    pub(crate) fn with<G>(&self, fields: &'a G) -> View<'a, G> {
        let &Self { config, state, neighborhood, .. } = self;
        View { config, state, neighborhood, fields }
    }

    /// x_a − x_b in m, of a particle a and a particle or image b.
    #[inline]
    pub(crate) fn separation(&self, a: usize, b: usize) -> Vec2 {
        let position = &self.state.particles.position;
        self.config.domain.separation(position[a], self.neighborhood.images.position(b, position))
    }

    /// The velocities in m/s.
    pub(crate) fn velocity(&self) -> Field<Vec2> {
        self.neighborhood.images.velocity_field(self.state.particles.velocity.clone())
    }

    /// The periodic sides with a given flow rate, each with the state of its flow.
    pub(crate) fn given_flows(&self) -> impl Iterator<Item = (&'a OpenSide, &'a GivenFlow)> + use<'a, F> {
        self.config.open.through.iter().zip(&self.state.given_flows)
    }

    /// The error of a `system` that is not solved to its `tolerance`.
    pub(crate) fn not_converged(&self, system: &'static str, found: Convergence) -> SolverError {
        let (Convergence { residual, iterations, tolerance }, time, step) = (found, self.state.time, self.state.steps);
        SolverError::NotConverged { system, residual, tolerance, iterations, time, step }
    }

    /// The mean pressure gradient −∇P in Pa/m that drives the given flows.
    pub fn driving_gradient(&self) -> Vec2 {
        self.given_flows().map(|(side, given)| given.gradient * side.inward()).sum()
    }
}
