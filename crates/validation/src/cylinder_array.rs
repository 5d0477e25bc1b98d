//! Drag on the solids of a periodic cell (A5 to A7 of the benchmarks; Sangani & Acrivos 1982).

use super::series::pairs;
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::measures::Subject;

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, m) = (s.flow, &s.flow.config.method);
    let area = flow.config.domain.bounds.area();
    let p = &flow.state.particles;
    let flux: Vec2 = (0..p.fluids).map(|a| flow.fields.bulk.volume[a] * p.velocity[a]).sum();
    let force = m.wetting_fluid.density * m.gravity;
    // Along the force, so that its direction is arbitrary.
    let along = force.try_normalize(0.0).unwrap_or_else(Vec2::x);
    let mean = flux.dot(&along) / area;
    // The part carried by side walls is subtracted from the total; the rest acts on the solids within the cell.
    let bounds = flow.config.domain.bounds;
    let is_side = |x: Vec2| !bounds.contains(x);
    let mu_u = m.wetting_fluid.viscosity * mean;
    let drag = (force.norm() * area - flow.view().friction(|_, x| is_side(x)).dot(&along)) / mu_u;
    let permeability = mu_u / force.norm();
    let method = "force per volume times the area of the cell less the friction on its sides that are walls, over viscosity and the \
                  velocity averaged over the whole cell, at the end";
    let method_of_mean = "velocity along the force averaged over the whole cell, solids at rest, at the end";
    let method_of_permeability = "viscosity times mean velocity over force per volume";
    let pull = force.norm() * s.observed.areas.wetting;
    let unsteady = acceleration(s) / pull;
    let method_of_unsteady = "magnitude of the rate of the momentum, across the force too, between the last two records over the force on the \
                              fluid; the drag of a flow that still gathers speed is too high";
    vec![
        measure("drag-over-mu-u", drag, "").by(method),
        measure("mean-velocity-m-per-s", mean, "m/s").by(method_of_mean),
        measure("permeability-m2", permeability, "m2").by(method_of_permeability),
        measure("unsteady-share", unsteady, "").by(method_of_unsteady),
    ]
}

/// Magnitude in N/m of the rate of change of the fluid's momentum between the last two records.
fn acceleration(s: &Subject) -> f64 {
    let (times, x) = pairs(s.series, "momentum_x_kg_per_m_s");
    let (_, y) = pairs(s.series, "momentum_y_kg_per_m_s");
    let momenta: Vec<Vec2> = x.into_iter().zip(y).map(|(x, y)| Vec2::new(x, y)).collect();
    match (&times[..], &momenta[..]) {
        ([.., before, now], [.., was, is]) => (is - was).norm() / (now - before),
        _ => f64::NAN,
    }
}
