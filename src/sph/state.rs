//! The state of a flow: what a step goes on from, and so what a resumed run needs. Everything else follows from it.

use serde::{Deserialize, Serialize};

use crate::math::Vec2;
use crate::sph::open::{BoundaryFluxes, GivenFlow};
use crate::sph::particles::Particles;
use crate::sph::wetting::lines::TrackedLine;

/// What restart saves: these fields in this order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlowState {
    /// Time in s.
    pub time: f64,
    /// Steps since time zero.
    pub steps: u64,
    /// Length of the last step in s, 0 before the first.
    pub last_dt: f64,
    /// The particles.
    pub particles: Particles,
    /// Depth of each wall particle in m.
    pub wall_depth: Vec<f64>,
    /// The contact lines as the last step left them; those of the present positions are [`Flow::lines`](crate::sph::flow::Flow::lines).
    pub lines: Vec<TrackedLine>,
    /// What passed through the sides.
    pub fluxes: BoundaryFluxes,
    /// How the given flow through each periodic side of `Open::through` goes on.
    pub given_flows: Vec<GivenFlow>,
    /// The unit vector along the wall that the contact lines had gone a spacing along, once they had.
    pub gone: Option<Vec2>,
}

impl FlowState {
    /// The state at time zero. `wall_depth` in m as `fill` returns it; `given_flows` periodic sides have a given flow rate.
    pub(crate) fn new(particles: Particles, wall_depth: Vec<f64>, given_flows: usize) -> Self {
        let next_id = u32::try_from(particles.len()).unwrap_or(u32::MAX);
        Self {
            time: 0.0,
            steps: 0,
            last_dt: 0.0,
            wall_depth,
            lines: Vec::new(),
            fluxes: BoundaryFluxes::new(&particles.phase[..particles.fluids], next_id),
            given_flows: vec![GivenFlow::default(); given_flows],
            gone: None,
            particles,
        }
    }
}
