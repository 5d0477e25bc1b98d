//! The state of a flow, from which a step starts or a resumed run continues. Everything else is derived from it.

use serde::{Deserialize, Serialize};

use crate::open::{BoundaryFluxes, GivenFlow};
use crate::particles::Particles;
use crate::wetting::lines::TrackedLine;
use meniscus_core::math::Vec2;

/// The saved state of a restart: these fields in this order.
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
    /// The contact lines at the start of the last step; those of the present positions are [`Flow::lines`](crate::flow::Flow::lines).
    pub lines: Vec<TrackedLine>,
    /// Fluxes through the sides.
    pub fluxes: BoundaryFluxes,
    /// State of the given flow through each periodic side of `Open::through`.
    pub given_flows: Vec<GivenFlow>,
    /// Direction along the wall in which the contact lines first moved by one spacing; `None` before.
    pub gone: Option<Vec2>,
}

impl FlowState {
    /// The state at time zero. `wall_depth` in m as returned by `fill`; `given_flows` is the number of periodic sides with a given flow rate.
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
