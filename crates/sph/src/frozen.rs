//! A frozen interface: flow through the whole pore and then through each phase alone, one after the other in one run.
//!
//! The other phase is part of the solid: no fluid crosses the interface, and there is no slip on it. So the three flows have the same initial
//! particle positions and differ in which particles are fluid. Each starts at rest from these positions, independently of the stage before: the
//! flow of a stage is determined by the case and its own steps alone.

use crate::flow::Flow;

/// Number of flows: of the whole pore, of the wetting and of the non-wetting phase, in this order.
pub(crate) const FLOWS: usize = 3;

/// Constructs a flow at rest and at time zero.
pub(crate) type FlowAtRest = Box<dyn Fn() -> Flow + Send + Sync>;

/// The flows with a frozen interface.
pub(crate) struct FrozenInterface {
    /// The flows of the whole pore, of the wetting and of the non-wetting phase.
    pub(crate) flows: [FlowAtRest; FLOWS],
}

impl FrozenInterface {
    /// The flow of a stage at its start, with the time, step count and work of `before`, the end of the previous stage.
    pub(crate) fn flow(&self, stage: usize, before: &Flow) -> Flow {
        let mut flow = self.flows[stage.min(FLOWS - 1)]();
        (flow.state.time, flow.state.steps) = (before.state.time, before.state.steps);
        flow.work = before.work;
        flow
    }
}
