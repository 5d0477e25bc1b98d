//! A free drop that oscillates between two ellipses (B3 of the benchmarks).
//!
//! The shape is that of the ellipse with the second moments of the wetting particles, which needs no contour.

use std::f64::consts::{PI, TAU};

use super::damped;
use super::moments::Moments;
use super::series::pairs;
use crate::analysis::laws::waves::OscillatingDrop;
use crate::solver::Measure;
use crate::sph::flow::Flow;
use crate::sph::measures::{Columns, Group, Subject, measure};
use crate::sph::observe::Observation;

/// Columns and measures of its table `[sph.measure.oscillating-drop]`.
pub const GROUP: Group = Group { columns, ..Group::of(measures) };

/// The fit begins after this part of the inviscid period: until then the vorticity of the start spreads.
const LEFT_OUT: f64 = 0.25;

/// `elongation` along x and `deformation` along its own axes.
pub(super) fn columns(flow: &Flow, _: &Observation) -> Columns {
    let moments = Moments::of_wetting_phase(flow);
    vec![("elongation", moments.elongation()), ("deformation", moments.deformation())]
}

/// The drop at rest as the linear theory takes it; fluids that differ have no closed form here.
pub(super) fn drop(s: &Subject) -> OscillatingDrop {
    let m = &s.flow.setting.method;
    OscillatingDrop {
        radius: (s.seen.areas.wetting / PI).sqrt(),
        tension: m.tension,
        density: m.mean_density(),
        viscosity: m.wetting_fluid.viscosity,
    }
}

/// Period and decay, and both over those of the linear viscous solution.
///
/// The solution is fitted at the same times in the same way: beside its mode it has a part that decays as a power of time, by
/// which the half periods of a viscous drop differ by some percent.
fn measures(s: &Subject) -> Vec<Measure> {
    let (m, drop) = (&s.flow.setting.method, drop(s));
    let inviscid = drop.frequency();
    let (times, values) = pairs(s.series, "elongation");
    let from = times.iter().position(|t| *t >= LEFT_OUT * TAU / inviscid).unwrap_or(times.len());
    let (times, values) = (&times[from..], &values[from..]);
    let fit = damped::fit(times, values, inviscid);
    let exact = if m.wetting_fluid == m.other_fluid {
        let solution: Vec<f64> = times.iter().map(|&t| drop.elongation(t)).collect();
        damped::fit(times, &solution, inviscid)
    } else {
        None
    };
    let period = fit.map_or(f64::NAN, |fit| TAU / fit.frequency);
    let decay = fit.map_or(f64::NAN, |fit| fit.decay);
    let method =
        "damped oscillation fitted to the elongation of the wetting phase along x, without the first quarter period";
    let over = "over that of the linear viscous solution for a drop in an equal fluid, fitted at the same times";
    vec![
        measure("period-s", period, "s", fit.map(|fit| period * fit.errors[0] / fit.frequency), method),
        measure("decay-rate", decay, "1/s", fit.map(|fit| fit.errors[1]), method),
        measure("period-ratio", exact.map_or(f64::NAN, |e| period * e.frequency / TAU), "", None, over),
        measure("decay-rate-ratio", exact.map_or(f64::NAN, |e| decay / e.decay), "", None, over),
    ]
}
