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

/// Period and decay of the elliptic mode.
pub fn oscillation(s: &Subject) -> Vec<Measure> {
    let (m, drop) = (&s.flow.method, drop(s));
    let inviscid = (3.0 * drop.tension / (drop.density * drop.radius.powi(3))).sqrt();
    let (times, values) = pairs(s.series, "elongation");
    let from = times.iter().position(|t| *t >= LEFT_OUT * TAU / inviscid).unwrap_or(times.len());
    let fit = damped::fit(&times[from..], &values[from..], inviscid);
    let period = fit.map_or(f64::NAN, |fit| TAU / fit.frequency);
    let decay = fit.map_or(f64::NAN, |fit| fit.decay);
    let equal = m.wetting_fluid == m.other_fluid;
    let exact = if equal { drop.elliptic_mode() } else { None };
    let method =
        "damped oscillation fitted to the elongation of the wetting phase along x, without the first quarter period";
    let over = "over that of the linear viscous mode of a drop in an equal fluid";
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
