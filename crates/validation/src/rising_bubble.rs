//! A rising bubble of the wetting phase (B6 of the benchmarks; Hysing et al. 2009).

use std::f64::consts::PI;

use super::moments::Moments;
use super::series::{Extremum, extremum, pairs};
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, Series, measure};
use meniscus_geometry::interface::polyline::Polyline;
use meniscus_sph::flow::Flow;
use meniscus_sph::measures::{Columns, Subject};
use meniscus_sph::observe::Observation;
use meniscus_sph::particles::Phase;

/// Height of the center, mean rise velocity, and circularity.
pub(super) fn columns(flow: &Flow, observation: &Observation) -> Columns {
    let center = Moments::of_wetting_phase(flow).center;
    vec![
        ("bubble_center_m", center.dot(&up(flow))),
        ("bubble_speed_m_per_s", speed(flow)),
        ("bubble_circularity", circularity(&observation.interface)),
    ]
}

/// Unit vector opposite to gravity; along y without gravity.
fn up(flow: &Flow) -> Vec2 {
    (-flow.config.method.gravity).try_normalize(0.0).unwrap_or_else(Vec2::y)
}

fn speed(flow: &Flow) -> f64 {
    let p = &flow.state.particles;
    let inside: Vec<Vec2> = (0..p.fluids).filter(|&a| p.phase[a] == Phase::Wetting).map(|a| p.velocity[a]).collect();
    inside.iter().sum::<Vec2>().dot(&up(flow)) / inside.len() as f64
}

/// Perimeter of the circle with the area of the largest closed contour over the length of that contour.
fn circularity(interface: &[Polyline]) -> f64 {
    let closed = interface.iter().filter(|line| line.closed);
    let largest = closed.max_by(|a, b| a.signed_area().abs().total_cmp(&b.signed_area().abs()));
    largest.map_or(f64::NAN, |line| 2.0 * (PI * line.signed_area().abs()).sqrt() / line.length())
}

/// The maximum (`sign` = 1) or minimum (−1) of a column, interpolated between records.
fn turn(series: &Series, column: &str, sign: f64) -> Extremum {
    let (times, values) = pairs(series, column);
    let known = values.iter().enumerate().filter(|(_, value)| value.is_finite());
    let row = known.max_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1))).map(|(row, _)| row);
    // Without any value there is no such row either.
    extremum(&times, &values, row.unwrap_or(values.len()))
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let fastest = turn(s.series, "bubble_speed_m_per_s", 1.0);
    let least = turn(s.series, "bubble_circularity", -1.0);
    let between = "over all records, by the parabola through the three records there";
    vec![
        measure("rise-center-m", s.series.column("bubble_center_m").last().unwrap_or(f64::NAN), "m")
            .by("center of the wetting particles against gravity at the end"),
        measure("max-rise-velocity", fastest.value, "m/s")
            .by(format!("largest mean speed of the wetting particles against gravity {between}")),
        measure("min-circularity", least.value, "").by(format!(
            "least circumference of the circle of equal area over the length of the c = 0.5 contour {between}"
        )),
    ]
}
