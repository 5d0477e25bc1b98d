//! Rise of the wetting phase in a slit from an open side (C4 of the benchmarks).

use super::series::{extremum, pairs};
use super::slit_filling::entry;
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::flow::Flow;
use meniscus_sph::measures::{Columns, Subject};
use meniscus_sph::observe::Observation;

/// `apex_m`: distance of the nearest point of the interface from the side through which the wetting phase enters.
pub(super) fn columns(flow: &Flow, observation: &Observation) -> Columns {
    let apex = entry(flow).map_or(f64::NAN, |side| {
        let points = observation.interface.iter().flat_map(|line| &line.points);
        points.map(|x: &Vec2| -side.overshoot(*x)).fold(f64::INFINITY, f64::min)
    });
    vec![("apex_m", apex)]
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (times, heights) = pairs(s.series, "apex_m");
    let Some(&last) = heights.last() else { return vec![] };
    let turn = |from: usize, sign: f64| {
        let rest = heights.iter().enumerate().skip(from);
        rest.max_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1))).map(|(i, _)| i)
    };
    let peak = turn(0, 1.0).unwrap_or_default();
    let low = turn(peak, -1.0).unwrap_or(peak);
    let [highest, lowest] = [peak, low].map(|row| extremum(&times, &heights, row));
    let method = "the point of the interface that is nearest to the side of entry, over all records, by the parabola through the three records there";
    vec![
        measure("peak-apex-m", highest.value, "m").by(format!("largest distance of {method}")),
        measure("peak-time-s", highest.time, "s").by(format!("time of the largest distance of {method}")),
        measure("minimum-apex-m", lowest.value, "m").by(format!("least distance after the peak of {method}")),
        measure("minimum-time-s", lowest.time, "s")
            .by(format!("time of the least distance after the peak of {method}")),
        measure("final-apex-m", last, "m")
            .by("distance of the point of the interface nearest to the side of entry, at the end"),
    ]
}
