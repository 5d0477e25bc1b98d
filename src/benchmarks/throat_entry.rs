//! A meniscus that rests where the pressure in a throat is largest (C7 of the benchmarks); between two discs compared with the exact one.

use std::f64::consts::PI;

use crate::analysis::laws::pores::entry_curvature;
use crate::solver::Measure;
use crate::sph::measures::{Group, Subject, measure};

/// Measures of its table `[sph.measure.throat-entry]`.
pub const GROUP: Group = Group::of(measures);

fn measures(s: &Subject) -> Vec<Measure> {
    let (tension, h) = (s.flow.setting.method.tension, s.flow.setting.method.kernel.h);
    let found = &s.seen.capillary_pressure;
    let pressure = measure(
        "entry-pressure-Pa",
        found.value,
        "Pa",
        Some(found.uncertainty(tension, h)),
        "capillary pressure p_n - p_w at the end: the entry pressure where the invading phase fills up to its meniscus of largest curvature",
    );
    let ([a, b], Some(wetting)) = (s.discs, s.flow.setting.method.wetting) else { return vec![pressure] };
    let distance = (b.center - a.center).norm();
    // The phase of the larger pressure is the one that invades; the angle is that through the other one.
    let angle = wetting.static_angle();
    let [defending, sign] = if found.value < 0.0 { [PI - angle, -1.0] } else { [angle, 1.0] };
    let exact = entry_curvature([a.radius, b.radius], distance, defending).map(|curvature| sign * curvature);
    let ratio = |pressure: f64| exact.map_or(f64::NAN, |exact| pressure / (tension * exact));
    let fitted: Vec<f64> = s.seen.lines_with_angle().map(|line| -line.curvature).collect();
    let curvature = fitted.iter().sum::<f64>() / fitted.len() as f64;
    vec![
        pressure,
        measure(
            "entry-pressure-ratio",
            ratio(found.value),
            "",
            Some(ratio(found.uncertainty(tension, h)).abs()),
            "capillary pressure at the end over the exact entry pressure of the throat, tension/r*",
        ),
        measure(
            "entry-curvature-ratio",
            ratio(curvature * tension),
            "",
            None,
            "curvature of the fitted meniscus at the end over 1/r*",
        ),
    ]
}
