//! A standing wave on a flat interface (B4 of the benchmarks), compared with the linear viscous solution.

use std::f64::consts::TAU;

use super::series::pairs;
use crate::analysis::laws::waves::CapillaryWave;
use crate::solver::Measure;
use crate::sph::flow::Flow;
use crate::sph::measures::{Columns, Group, Subject, measure};
use crate::sph::observe::Observation;
use crate::sph::particles::Phase;

/// Columns and measures of its table `[sph.measure.capillary-wave]`.
pub const GROUP: Group = Group { columns, ..Group::of(measures) };

/// Amplitude in m of the first Fourier mode along x of the area of the wetting phase, crest in the middle of the box.
fn columns(flow: &Flow, _: &Observation) -> Columns {
    let (bounds, fluids) = (flow.setting.domain.bounds, flow.state.particles.fluids);
    let length = bounds.size().x;
    let mode = |a: usize| {
        let x = flow.state.particles.position[a].x - bounds.center().x;
        flow.fields.volume[a] * (TAU * x / length).cos()
    };
    let wetting = (0..fluids).filter(|&a| flow.state.particles.phase[a] == Phase::Wetting);
    vec![("wave_amplitude_m", 2.0 / length * wetting.map(mode).sum::<f64>())]
}

fn measures(s: &Subject) -> Vec<Measure> {
    let m = &s.flow.setting.method;
    let wave = CapillaryWave {
        length: s.flow.setting.domain.bounds.size().x,
        tension: m.tension,
        density: m.wetting_fluid.density,
        viscosity: m.wetting_fluid.viscosity,
    };
    let (times, values) = pairs(s.series, "wave_amplitude_m");
    let start = values.first().copied().unwrap_or(f64::NAN);
    let squares: f64 = times.iter().zip(&values).map(|(&t, a)| (a / start - wave.amplitude(t)).powi(2)).sum();
    let equal = m.wetting_fluid == m.other_fluid;
    let error = if equal { (squares / times.len() as f64).sqrt() } else { f64::NAN };
    let method = "root mean square over the records of amplitude over first amplitude less the linear viscous solution for equal fluids";
    vec![measure("wave-rms-error", error, "", None, method)]
}
