//! The exponent of a drop spreading on a wall (C13 of the benchmarks; Tanner's law in two dimensions: 1/7).

use meniscus_core::solver::{Measure, measure};
use meniscus_sph::flow::Flow;
use meniscus_sph::measures::{Columns, Subject};
use meniscus_sph::observe::Observation;

/// Distance between the two contact points in m.
pub(super) fn columns(_: &Flow, observation: &Observation) -> Columns {
    let lines: Vec<_> = observation.lines_with_angle().collect();
    // Contours continue across periodic sides, so the distance of the two ends of a drop needs no minimum image.
    let base = if let [a, b] = lines[..] { (b.position - a.position).norm() } else { f64::NAN };
    vec![("base_m", base)]
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let end = s.series.column("time_s").last().unwrap_or(f64::NAN);
    let all = s.series.column("time_s").zip(s.series.column("base_m"));
    let decade: Vec<(f64, f64)> =
        all.filter(|(t, base)| *t >= 0.1 * end && *base > 0.0).map(|(t, base)| (t.ln(), base.ln())).collect();
    // Trapezoidal weights in ln t, so that the many late records do not outweigh the few early ones.
    let weights: Vec<f64> = (0..decade.len())
        .map(|i| {
            let before = decade[i.saturating_sub(1)].0;
            let after = decade[(i + 1).min(decade.len() - 1)].0;
            0.5 * (after - before)
        })
        .collect();
    let total: f64 = weights.iter().sum();
    let mean = |f: fn(&(f64, f64)) -> f64| decade.iter().zip(&weights).map(|(p, w)| w * f(p)).sum::<f64>() / total;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let (up, down) = decade
        .iter()
        .zip(&weights)
        .fold((0.0, 0.0), |(up, down), (p, w)| (up + w * (p.0 - x) * (p.1 - y), down + w * (p.0 - x).powi(2)));
    let method = "slope of the logarithm of the base over that of the time in the last decade of the run, all of it weighed alike";
    vec![measure("spreading-exponent", up / down, "").by(method)]
}
