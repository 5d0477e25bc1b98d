//! Two layers between plates, the wetting phase below (A2 of the benchmarks).

use meniscus_core::solver::{Measure, measure};
use meniscus_sph::measures::Subject;
use meniscus_sph::particles::Phase;

/// Two layers between plates at y = 0 and y = H, driven by a force per volume; layer 1 is the lower one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayeredPoiseuille {
    /// Driving force per volume in N/m³.
    pub(crate) force: f64,
    /// Thicknesses in m.
    pub(crate) heights: [f64; 2],
    /// Dynamic viscosities in Pa s.
    pub(crate) viscosities: [f64; 2],
}

impl LayeredPoiseuille {
    /// Shear stress in Pa at the lower plate: velocity and stress are continuous at the interface.
    fn wall_stress(&self) -> f64 {
        let ([h1, h2], [m1, m2]) = (self.heights, self.viscosities);
        let load = h1 * h1 / (2.0 * m1) + (h1 * h2 + 0.5 * h2 * h2) / m2;
        self.force * load / (h1 / m1 + h2 / m2)
    }

    /// Velocity in m/s at `y` (m).
    pub(crate) fn velocity(&self, y: f64) -> f64 {
        let ([h1, _], [m1, m2]) = (self.heights, self.viscosities);
        let momentum = |y: f64| self.wall_stress() * y - 0.5 * self.force * y * y;
        if y <= h1 { momentum(y) / m1 } else { momentum(h1) / m1 + (momentum(y) - momentum(h1)) / m2 }
    }

    /// Flow rates of the two layers in m²/s.
    pub(crate) fn flow_rates(&self) -> [f64; 2] {
        let [h1, h2] = self.heights;
        // Simpson's rule is exact for parabolas.
        let rate = |from: f64, thickness: f64| {
            let at = |part: f64| self.velocity(from + part * thickness);
            thickness / 6.0 * (at(0.0) + 4.0 * at(0.5) + at(1.0))
        };
        [rate(0.0, h1), rate(h1, h2)]
    }
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, bounds, m) = (s.flow, s.flow.config.domain.bounds, &s.flow.config.method);
    let p = &flow.state.particles;
    let height = bounds.size().y;
    let below = height * s.observed.areas.saturation();
    // The driving force is per volume: the solution holds for equal densities only.
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
        rates[usize::from(p.phase[a] != Phase::Wetting)] +=
            flow.fields.bulk.volume[a] * p.velocity[a].x / bounds.size().x;
    }
    let exact = law.flow_rates();
    let method = "flow rate of the layer at the end over the exact one";
    vec![
        measure("layered-velocity-l2-error", (error / size).sqrt(), "")
            .by("L2 norm over particles of the velocity at the end less the steady one, over that of the steady one"),
        measure("wetting-flow-rate-ratio", rates[0] / exact[0], "").by(method),
        measure("non-wetting-flow-rate-ratio", rates[1] / exact[1], "").by(method),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layered_flow_has_the_printed_interface_velocity_and_rates() {
        for (m, interface, below, above) in [
            (1.0, 0.125, 0.041_666_7, 0.041_666_7),
            (2.0, 0.166_666_7, 0.052_083_3, 0.0625),
            (10.0, 0.227_272_7, 0.067_234_8, 0.160_984_8),
            (100.0, 0.247_524_8, 0.072_297_9, 1.103_547_9),
        ] {
            let flow = LayeredPoiseuille { force: 1.0, heights: [0.5, 0.5], viscosities: [1.0, 1.0 / m] };
            let [q1, q2] = flow.flow_rates();
            assert!((flow.velocity(0.5) - interface).abs() < 1e-7, "m {m}: {}", flow.velocity(0.5));
            assert!((q1 - below).abs() < 1e-7 && (q2 - above).abs() < 1e-7, "m {m}: {q1} {q2}");
            assert!(flow.velocity(1.0).abs() < 1e-14);
        }
    }
}
