//! Two layers between plates, the wetting phase below (A2 of the benchmarks).

use crate::analysis::laws::flow::LayeredPoiseuille;
use crate::solver::Measure;
use crate::sph::measures::{Group, Subject, measure};
use crate::sph::particles::Phase;

/// Measures of its table `[sph.measure.layered-poiseuille]`.
pub const GROUP: Group = Group::of(measures);

fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, bounds, m) = (s.flow, s.flow.setting.domain.bounds, &s.flow.setting.method);
    let p = &flow.state.particles;
    let height = bounds.size().y;
    let below = height * s.seen.areas.saturation();
    // A force per volume: the densities are equal, or the law does not hold.
    let equal = m.wetting_fluid.density == m.other_fluid.density;
    let law = LayeredPoiseuille {
        force: if equal { m.mean_density() * m.gravity.x } else { f64::NAN },
        heights: [below, height - below],
        viscosities: [m.wetting_fluid.viscosity, m.other_fluid.viscosity],
    };
    let (mut error, mut size, mut rates) = (0.0, 0.0, [0.0; 2]);
    for a in 0..p.fluids {
        let exact = law.velocity(p.position[a].y - bounds.min.y);
        error += (p.velocity[a].x - exact).powi(2) + p.velocity[a].y.powi(2);
        size += exact * exact;
        rates[usize::from(p.phase[a] != Phase::Wetting)] += flow.fields.volume[a] * p.velocity[a].x / bounds.size().x;
    }
    let exact = law.flow_rates();
    let method = "flow rate of the layer at the end over the exact one";
    vec![
        measure(
            "layered-velocity-l2-error",
            (error / size).sqrt(),
            "",
            None,
            "L2 norm over particles of the velocity at the end less the steady one, over that of the steady one",
        ),
        measure("wetting-flow-rate-ratio", rates[0] / exact[0], "", None, method),
        measure("non-wetting-flow-rate-ratio", rates[1] / exact[1], "", None, method),
    ]
}
