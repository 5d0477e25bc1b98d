//! A meniscus in the throat between two discs (C7 of the benchmarks), compared with the entry pressure.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Subject, measure};
use crate::analysis::laws::pores::entry_curvature;
use crate::solver::Measure;

pub fn measures(s: &Subject) -> Vec<Measure> {
    let ([a, b, ..], Some(wetting)) = (s.discs, s.flow.method.wetting) else { return vec![] };
    let distance = (b.center - a.center).norm();
    let angle = wetting.static_angle();
    // Above 90 degrees the other fluid is the one that wets.
    let [acute, sign] = if angle > FRAC_PI_2 { [PI - angle, -1.0] } else { [angle, 1.0] };
    let exact = entry_curvature([a.radius, b.radius], distance, acute).map(|curvature| sign * curvature);
    let found = &s.seen.capillary_pressure;
    let ratio = |pressure: f64| exact.map_or(f64::NAN, |exact| pressure / (s.flow.method.tension * exact));
    let fitted: Vec<f64> = s.seen.lines_with_angle().map(|line| -line.curvature).collect();
    let curvature = fitted.iter().sum::<f64>() / fitted.len() as f64;
    vec![
        measure(
            "entry-pressure-ratio",
            ratio(found.value),
            "",
            Some(ratio(found.uncertainty(s.flow.method.tension, s.flow.method.kernel.h)).abs()),
            "capillary pressure at the end over the exact entry pressure of the throat, tension/r*",
        ),
        measure(
            "entry-curvature-ratio",
            ratio(curvature * s.flow.method.tension),
            "",
            None,
            "curvature of the fitted meniscus at the end over 1/r*",
        ),
    ]
}
