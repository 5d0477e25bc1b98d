//! Error of the velocity against plane Poiseuille flow (A1 of the benchmarks), with its start-up.

use super::{Subject, measure};
use crate::analysis::laws::flow::Poiseuille;
use crate::solver::Measure;

pub fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, bounds) = (s.flow, s.flow.domain.bounds);
    let fluid = flow.method.wetting_fluid;
    let law = Poiseuille {
        force: fluid.density * flow.method.gravity.x,
        viscosity: fluid.viscosity,
        density: fluid.density,
        height: bounds.size().y,
    };
    let (mut error, mut size) = (0.0, 0.0);
    for (x, v) in flow.particles.position.iter().zip(&flow.particles.velocity).take(flow.particles.fluids) {
        let exact = law.at(x.y - bounds.min.y, flow.time);
        error += (v.x - exact).powi(2) + v.y.powi(2);
        size += exact * exact;
    }
    let method = "L2 norm over particles of the velocity less the start-up series at the end, over that of the series";
    vec![measure("velocity-l2-error", (error / size).sqrt(), "", None, method)]
}
