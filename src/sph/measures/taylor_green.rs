//! Decay rate of Taylor-Green vortices (A3 of the benchmarks).

use super::{Subject, measure};
use crate::analysis::laws::flow::taylor_green_decay;
use crate::solver::Measure;

pub fn measures(s: &Subject) -> Vec<Measure> {
    let flow = s.flow;
    let fluid = flow.method.wetting_fluid;
    let mut energy = s.series.column("kinetic_energy_J_per_m");
    let (first, last) = (energy.next().unwrap_or(f64::NAN), energy.last().unwrap_or(f64::NAN));
    let length = flow.domain.bounds.size().x;
    let exact = taylor_green_decay(fluid.viscosity / fluid.density, length, flow.time).ln();
    let error = 0.5 * (last / first).ln() / exact - 1.0;
    let method = "rate of decay of the square root of the kinetic energy over the run, over 8 pi^2 nu/L^2, less 1";
    vec![measure("decay-rate-error", error, "", None, method)]
}
