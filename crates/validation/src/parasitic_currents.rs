//! Parasitic currents about a drop, at rest or carried along: what should not move moves at this speed.

use super::series::last;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::measures::Subject;

/// Last fraction of the run over which the median is taken.
const LAST: f64 = 0.5;

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let mut speeds: Vec<f64> =
        last(s.series, "max_relative_speed_m_per_s", LAST).into_iter().map(|(_, speed)| speed).collect();
    speeds.sort_by(f64::total_cmp);
    let middle = speeds.get(speeds.len() / 2).copied().unwrap_or(f64::NAN);
    vec![measure("parasitic-speed-m-per-s", middle, "m/s").by(
        "median over the records of the last half of the largest speed of all particles of both fluids relative to their mean velocity",
    )]
}
