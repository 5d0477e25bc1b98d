//! A frozen interface: the pore as a whole and then each phase alone, one after the other in one run.
//!
//! The other phase is part of the solid: no fluid passes the interface, and there is no slip on it. So the three flows have the same places of
//! particles at their starts, and differ in what counts as fluid. Each begins at rest and from these places, whatever the one before did to its
//! particles: the flow of a stage follows from the case and its own steps alone.

use crate::sph::flow::Flow;

/// Number of flows: of the whole pore, of the wetting and of the non-wetting phase, in this order.
pub(crate) const FLOWS: usize = 3;

/// Makes a flow at rest and at time zero.
pub(crate) type FlowAtRest = Box<dyn Fn() -> Flow + Send + Sync>;

/// The flows beside an interface that is frozen.
pub(crate) struct FrozenInterface {
    flows: [FlowAtRest; FLOWS],
}

impl FrozenInterface {
    /// The flows of the whole pore, of the wetting and of the non-wetting phase.
    pub(crate) fn new(flows: [FlowAtRest; FLOWS]) -> Self {
        Self { flows }
    }

    /// The flow of the whole pore at time zero.
    pub(crate) fn first(&self) -> Flow {
        self.flows[0]()
    }

    /// The flow of a stage at its start, which `before` has come to.
    pub(crate) fn flow(&self, stage: usize, before: &Flow) -> Flow {
        let mut flow = self.flows[stage.min(FLOWS - 1)]();
        (flow.state.time, flow.state.steps) = (before.state.time, before.state.steps);
        flow.work = before.work;
        flow
    }
}
