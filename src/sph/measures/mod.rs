//! Final results: those that every run reports, and groups that a case asks for, one file each.

mod balance;
mod bridge;
mod bubble;
mod cavity;
mod cylinder_array;
mod drop_on_disc;
mod every_run;
mod four_discs;
mod jurin;
mod laplace_drop;
mod layered;
mod moving_drop;
pub(crate) mod open;
mod poiseuille;
mod sessile_drop;
mod sliding;
mod slit;
mod spreading;
pub mod stream;
mod taylor_green;
mod throat;
mod wave;

use std::f64::consts::TAU;

use crate::analysis::phases::PhaseAreas;
use crate::case::checked::MeasureSet;
use crate::math::{Bounds, Vec2};
use crate::solver::{Measure, Series};
use crate::sph::observe::Observation;
use crate::sph::particles::Phase;
use crate::sph::projection::Flow;

/// A disc of the geometry, for measures that compare with closed forms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscOf {
    /// Center in m.
    pub center: Vec2,
    /// Radius in m.
    pub radius: f64,
}

/// What a measure may look at.
pub struct Subject<'a> {
    /// The flow at its end.
    pub flow: &'a Flow,
    /// What is seen of it.
    pub seen: &'a Observation,
    /// Areas of the phases at time zero.
    pub start: PhaseAreas,
    /// All records.
    pub series: &'a Series,
    /// The discs of the geometry.
    pub discs: &'a [DiscOf],
    /// The upright rectangles of the geometry.
    pub plates: &'a [Bounds],
    /// Speeds of the walls at the left, right, bottom and top side in m/s.
    pub wall_speeds: [f64; 4],
}

impl Subject<'_> {
    /// The two nearest discs as a pair with the requested contact angle, where there are two of one radius.
    fn disc_pair(&self) -> Option<crate::analysis::laws::pores::DiscPair> {
        let [a, rest @ ..] = self.discs else { return None };
        let distance = |b: &&DiscOf| (b.center - a.center).norm();
        let b = rest.iter().min_by(|b, c| distance(b).total_cmp(&distance(c)))?;
        let half_gap = 0.5 * distance(&b) - a.radius;
        let angle = self.flow.method.wetting?.static_angle();
        ((a.radius - b.radius).abs() < 1e-9 * a.radius).then_some(crate::analysis::laws::pores::DiscPair {
            radius: a.radius,
            half_gap,
            angle,
        })
    }
}

/// A measure; `uncertainty` in its unit.
fn measure(name: &str, value: f64, unit: &str, uncertainty: Option<f64>, method: &str) -> Measure {
    Measure { name: name.into(), value, unit: unit.into(), uncertainty, method: method.into() }
}

/// A group of measures.
type Group = fn(&Subject) -> Vec<Measure>;

/// All measures of a run.
#[must_use]
pub fn all(subject: &Subject, set: &MeasureSet) -> Vec<Measure> {
    let mut measures = every_run::measures(subject);
    measures.extend(open::measures(subject));
    let groups: [(bool, Group); 20] = [
        (set.sessile_drop, sessile_drop::measures),
        (set.laplace_drop, laplace_drop::measures),
        (set.poiseuille, poiseuille::measures),
        (set.taylor_green, taylor_green::measures),
        (set.capillary_bridge, bridge::measures),
        (set.four_discs, four_discs::measures),
        (set.drop_on_disc, drop_on_disc::measures),
        (set.oscillating_drop, moving_drop::oscillation),
        (set.shear_drop, moving_drop::shear),
        (set.capillary_wave, wave::measures),
        (set.rising_bubble, bubble::measures),
        (set.layered_poiseuille, layered::measures),
        (set.cavity, cavity::measures),
        (set.cylinder_array, cylinder_array::measures),
        (set.throat_entry, throat::measures),
        (set.jurin, jurin::measures),
        (set.moving_drop, sliding::measures),
        (set.spreading, spreading::measures),
        (set.slit_filling, slit::filling),
        (set.capillary_rise, slit::rise),
    ];
    for (_, group) in groups.iter().filter(|(wanted, _)| *wanted) {
        measures.extend(group(subject));
    }
    measures
}

/// Further columns of the series that the groups of `set` need for their measures: name and value.
#[must_use]
pub fn columns(flow: &Flow, seen: &Observation, set: &MeasureSet) -> Vec<(&'static str, f64)> {
    let mut columns = open::columns(flow);
    if set.oscillating_drop || set.shear_drop {
        columns.extend(moving_drop::columns(flow));
    }
    if set.capillary_wave {
        columns.extend(wave::columns(flow));
    }
    if set.rising_bubble {
        columns.extend(bubble::columns(flow, seen));
    }
    if set.moving_drop {
        columns.extend(sliding::columns(flow, seen));
    }
    if set.spreading {
        columns.extend(spreading::columns(seen));
    }
    if set.slit_filling {
        columns.extend(slit::filling_columns(flow, seen));
    }
    if set.capillary_rise {
        columns.extend(slit::rise_columns(flow, seen));
    }
    columns
}

/// Positions in m of the wetting particles, joined across periodic sides: right for parts shorter than a period.
fn wetting_points(flow: &Flow) -> Vec<Vec2> {
    let fluids = flow.particles.fluids;
    let wetting = |a: &usize| flow.particles.phase[*a] == Phase::Wetting;
    let inside: Vec<Vec2> = (0..fluids).filter(wetting).map(|a| flow.particles.position[a]).collect();
    let middle = Vec2::from_fn(|axis, _| match flow.domain.periods()[axis] {
        Some(period) => mean_on_circle(inside.iter().map(|x| x[axis]), period),
        None => 0.0,
    });
    // Points of a drop wider than half a period are still within half a period of its middle.
    inside.into_iter().map(|x| middle + flow.domain.separation(x, middle)).collect()
}

/// The mean direction of coordinates that repeat with `period`, in m.
fn mean_on_circle(coordinates: impl Iterator<Item = f64>, period: f64) -> f64 {
    let (sine, cosine) = coordinates.fold((0.0, 0.0), |(sine, cosine), x| {
        let angle = TAU * x / period;
        (sine + angle.sin(), cosine + angle.cos())
    });
    sine.atan2(cosine) / TAU * period
}

/// The values of two columns of the series, row by row.
fn pairs(series: &Series, column: &str) -> (Vec<f64>, Vec<f64>) {
    series.column("time_s").zip(series.column(column)).unzip()
}

/// A largest or smallest value between records.
struct Extremum {
    time: f64,
    value: f64,
    /// Standard uncertainties: what the parabola changes, and half of the interval of the records over √3.
    value_error: f64,
    time_error: f64,
}

/// The vertex of the parabola through the record `row` and its neighbors, where `row` is the largest or smallest of the three; else the record.
fn extremum(times: &[f64], values: &[f64], row: usize) -> Extremum {
    let at = |row: usize| Some((*times.get(row)?, *values.get(row)?));
    let (time, value) = at(row).unwrap_or((f64::NAN, f64::NAN));
    let vertex = || {
        let ((t0, v0), (t2, v2)) = (at(row.checked_sub(1)?)?, at(row + 1)?);
        let (before, after) = ((value - v0) / (time - t0), (v2 - value) / (t2 - time));
        let bend = (after - before) / (t2 - t0);
        let slope = before + bend * (time - t0);
        let step = -slope / (2.0 * bend);
        let inside = (t0 - time..=t2 - time).contains(&step);
        inside.then(|| Extremum {
            time: time + step,
            value: value + 0.5 * slope * step,
            value_error: (0.5 * slope * step).abs(),
            time_error: 0.25 * (t2 - t0) / 3.0_f64.sqrt(),
        })
    };
    vertex().unwrap_or(Extremum { time, value, value_error: 0.0, time_error: f64::NAN })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_between_records_is_found() {
        let times: Vec<f64> = (0..=20).map(|i| 0.1 * f64::from(i)).collect();
        let values: Vec<f64> = times.iter().map(|t| (t * 1.5).sin()).collect();
        let peak = extremum(&times, &values, 10);
        assert!((peak.time - std::f64::consts::FRAC_PI_2 / 1.5).abs() < 1e-3 && (peak.value - 1.0).abs() < 1e-4);
        let end = extremum(&times, &values, 20);
        assert_eq!((end.time, end.value), (times[20], values[20]));
    }

    #[test]
    fn the_mean_on_a_circle_lies_in_the_middle_of_a_part_across_the_seam() {
        // From 0.8 over the seam at 1 to 0.4: more than half of the period 1.
        let part = (0..=60).map(|i| (0.8 + 0.01 * f64::from(i)).rem_euclid(1.0));
        let mean = mean_on_circle(part, 1.0);
        assert!((mean - 0.1).abs() < 1e-12, "{mean}");
    }
}
