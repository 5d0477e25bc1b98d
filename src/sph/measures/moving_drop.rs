//! Free drops that change their shape: oscillation between two ellipses and deformation in shear (B3 and B5 of the benchmarks).
//!
//! The shape is that of the ellipse with the second moments of the wetting particles, which needs no contour.

use std::f64::consts::{PI, TAU};

use super::{Subject, measure, pairs, wetting_points};
use crate::analysis::damped;
use crate::analysis::laws::waves::OscillatingDrop;
use crate::analysis::moments::Moments;
use crate::solver::Measure;
use crate::sph::projection::Flow;

/// The fit begins after this part of the inviscid period: until then the vorticity of the start spreads.
const LEFT_OUT: f64 = 0.25;

/// `elongation` along x and `deformation` along its own axes.
pub fn columns(flow: &Flow) -> [(&'static str, f64); 2] {
    let moments = Moments::of(&wetting_points(flow));
    [("elongation", moments.elongation()), ("deformation", moments.deformation())]
}

/// The drop at rest as the linear theory takes it; fluids that differ have no closed form here.
fn drop(s: &Subject) -> OscillatingDrop {
    let m = &s.flow.method;
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
pub fn oscillation(s: &Subject) -> Vec<Measure> {
    let (m, drop) = (&s.flow.method, drop(s));
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

/// Deformation of a drop between walls that move against each other.
pub fn shear(s: &Subject) -> Vec<Measure> {
    let (m, height) = (&s.flow.method, s.flow.domain.bounds.size().y);
    let [_, _, bottom, top] = s.wall_speeds;
    let rate = (top - bottom).abs() / height;
    let capillary = m.other_fluid.viscosity * rate * drop(s).radius / m.tension;
    let deformation = Moments::of(&wetting_points(s.flow)).deformation();
    vec![
        measure(
            "deformation",
            deformation,
            "",
            None,
            "(L - B)/(L + B) of the ellipse with the second moments of the wetting phase, at the end",
        ),
        measure(
            "deformation-ratio",
            deformation / capillary,
            "",
            None,
            "deformation over the capillary number viscosity x shear rate x radius / tension, its value for small drops in the plane",
        ),
    ]
}
