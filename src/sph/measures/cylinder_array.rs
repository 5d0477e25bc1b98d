//! Drag on the solids of a periodic cell (A5 of the benchmarks; Sangani & Acrivos 1982).

use super::{Subject, measure};
use crate::math::Vec2;
use crate::solver::Measure;

pub fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, m) = (s.flow, &s.flow.method);
    let area = flow.domain.bounds.area();
    let p = &flow.particles;
    let flux: Vec2 = (0..p.fluids).map(|a| flow.fields.volume[a] * p.velocity[a]).sum();
    let force = m.wetting_fluid.density * m.gravity;
    // Along the force, so that its direction does not matter.
    let along = force.try_normalize(0.0).unwrap_or_else(Vec2::x);
    let mean = flux.dot(&along) / area;
    let drag = force.norm() * area / (m.wetting_fluid.viscosity * mean);
    let method = "force per volume times the area of the cell, over viscosity and the velocity averaged over the whole cell, at the end";
    let method_of_permeability =
        "viscosity times mean velocity over force per volume; its inverse times the cell's area is the drag";
    vec![
        measure("drag-over-mu-u", drag, "", None, method),
        measure("permeability-m2", area / drag, "m2", None, method_of_permeability),
    ]
}
