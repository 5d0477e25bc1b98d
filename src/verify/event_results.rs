//! Event pressures from runs of whole pores: the pressures between which the menisci jump.
//!
//! In the step of the jump the invading phase fills at least half of the area that it fills by the formula. The event lies between the
//! largest capillary pressure of menisci at rest at the end of an earlier step, as measured in the phases, and the pressure of the next step.

use super::events::PlannedEvent;
use super::fluids::Fluids;
use super::plan::Kind;
use super::results::{Direct, Run, Status, runs_of, unfinished};
use crate::io::series;
use crate::network::cycles::FluidPhase;
use crate::study::folder::StudyFolder;
use crate::study::results::RunResult;

/// Fraction of the area of an event that is filled in the step of the jump.
const FILLED: f64 = 0.5;
/// Difference between both spacings in tension/width above which neither is trusted.
const COARSE: f64 = 0.05;

/// An event with the results by formula and by direct simulation.
#[derive(Debug)]
pub(crate) struct EventRow<'a> {
    /// The event.
    pub(crate) planned: &'a PlannedEvent,
    /// Event pressure by the formula in Pa, invading less defending phase.
    pub(crate) formula: f64,
    /// The same by direct simulation.
    pub(crate) direct: Option<Direct>,
    /// Tension over throat width in Pa.
    pub(crate) scale: f64,
    /// Outcome.
    pub(crate) status: Status,
    /// Particles of the finest run.
    pub(crate) particles: Option<f64>,
    /// Wall time of all runs in s.
    pub(crate) wall_time: f64,
    /// Names of complete runs, for their pictures.
    pub(crate) runs: Vec<String>,
}

impl EventRow<'_> {
    /// Direct value less the formula in Pa.
    pub(crate) fn difference(&self) -> Option<f64> {
        Some(self.direct?.value - self.formula)
    }

    /// The same over tension/width.
    pub(crate) fn relative_difference(&self) -> Option<f64> {
        Some(self.difference()? / self.scale)
    }
}

/// A record of a run with pressure steps.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Record {
    /// Pressure at the inlet less that at the outlet in Pa.
    applied: f64,
    /// Capillary pressure in Pa, invading less defending phase.
    capillary: f64,
    /// Area of the invading phase in m².
    area: f64,
}

/// The pressure at which the menisci jump.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Left {
    /// Between these pressures in Pa.
    Between(f64, f64),
    /// In the first step, at this pressure in Pa.
    AtFirst(f64),
    /// Not up to this pressure in Pa.
    Not(f64),
}

/// The row of an event; `spacings` in order.
pub(crate) fn event_row<'a>(
    planned: &'a PlannedEvent,
    fluids: &Fluids,
    spacings: &[u32],
    results: &[RunResult],
    folder: &StudyFolder,
) -> EventRow<'a> {
    let runs = runs_of(planned.number, Kind::Event, spacings, results);
    let complete = || runs.iter().filter(|run| run.is_complete());
    let mut row = EventRow {
        planned,
        formula: fluids.pressure(planned.curvature),
        direct: None,
        scale: planned.subdomain.as_ref().map_or(f64::NAN, |subdomain| fluids.tension / subdomain.width),
        status: Status::Open,
        particles: runs.last().and_then(|run| run.number("unknowns")),
        wall_time: complete().filter_map(|run| run.number("wall-time-s")).sum::<f64>() + 0.0,
        runs: complete().map(|run| run.result.run.name.clone()).collect(),
    };
    match &planned.subdomain {
        Err(why) => row.status = Status::Impossible(why.to_string()),
        Ok(subdomain) => (row.direct, row.status) = judged(&runs, subdomain.area, row.scale, fluids.invading, folder),
    }
    row
}

fn judged(runs: &[Run], area: f64, scale: f64, invading: FluidPhase, folder: &StudyFolder) -> (Option<Direct>, Status) {
    if let Some(status) = unfinished(runs) {
        return (None, status);
    }
    let mut found: Vec<(f64, f64)> = Vec::new();
    for run in runs {
        let Some(records) = records(folder, &run.result.run.name, invading) else {
            return (None, Status::Failed("its series.csv cannot be read".to_owned()));
        };
        match left(&records, FILLED * area) {
            Left::Between(low, high) => found.push((0.5 * (low + high), 0.5 * (high - low).abs())),
            Left::AtFirst(pressure) => {
                return (
                    None,
                    Status::UnderResolved(format!("the menisci leave at the first pressure of {pressure:.1} Pa")),
                );
            }
            Left::Not(pressure) => {
                return (None, Status::UnderResolved(format!("no event up to {pressure:.1} Pa")));
            }
        }
    }
    let Some(&(value, half)) = found.last() else { return (None, Status::Open) };
    let coarser = found.len().checked_sub(2).map(|before| found[before].0);
    let direct = Direct { value, error: coarser.map(|coarser| (value - coarser).abs() + half) };
    match coarser {
        Some(coarser) if (value - coarser).abs() > COARSE * scale => {
            let percent = 100.0 * (value - coarser).abs() / scale;
            (Some(direct), Status::UnderResolved(format!("both spacings differ by {percent:.1} % of tension/width")))
        }
        _ => (Some(direct), Status::Ok),
    }
}

fn records(folder: &StudyFolder, run: &str, invading: FluidPhase) -> Option<Vec<Record>> {
    let series = series::read(&series::path(&folder.run(run))).ok()?;
    let (sign, area) = match invading {
        FluidPhase::NonWetting => (1.0, "non_wetting_area_m2"),
        FluidPhase::Wetting => (-1.0, "wetting_area_m2"),
    };
    let column = |name: &str| series.column(name).collect::<Vec<f64>>();
    let [applied, capillary, area] = ["pressure_difference_Pa", "capillary_pressure_Pa", area].map(column);
    let records = applied.into_iter().zip(capillary).zip(area);
    Some(records.map(|((applied, capillary), area)| Record { applied, capillary: sign * capillary, area }).collect())
}

/// The jump of the menisci: the first step in which the invading phase gains `gain` (m²).
fn left(records: &[Record], gain: f64) -> Left {
    // The last record of each step.
    let is_end = |k: &usize| records.get(k + 1).is_none_or(|next| next.applied > records[*k].applied);
    let ends: Vec<Record> = (0..records.len()).filter(is_end).map(|k| records[k]).collect();
    let Some(first) = records.first() else { return Left::Not(f64::NAN) };
    let mut before = first.area;
    let jump = ends.iter().position(|end| {
        let gained = end.area - before;
        before = end.area;
        gained >= gain
    });
    let Some(jump) = jump else { return Left::Not(ends.last().map_or(f64::NAN, |end| end.applied)) };
    let stood = (0..jump).filter(|&k| ends[k].capillary.is_finite());
    let Some(last) = stood.max_by(|&a, &b| ends[a].capillary.total_cmp(&ends[b].capillary)) else {
        return Left::AtFirst(first.applied);
    };
    Left::Between(ends[last].capillary, ends[last + 1].applied)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(applied: f64, capillary: f64, area: f64) -> Record {
        Record { applied, capillary, area }
    }

    #[test]
    fn menisci_leave_between_the_last_step_at_which_they_stood_and_the_next() {
        let mut records = vec![
            record(10.0, 8.0, 1.0),
            record(10.0, 9.9, 1.1),
            record(12.0, 11.8, 1.2),
            record(14.0, 13.0, 1.3),
            // A slow filling begins in the step before.
            record(14.0, 5.0, 1.5),
            record(16.0, 15.9, 3.0),
        ];
        assert_eq!(left(&records, 1.0), Left::Between(11.8, 14.0));
        assert_eq!(left(&records, 2.0), Left::Not(16.0));
        assert_eq!(left(&records[2..], 0.2), Left::Between(11.8, 14.0));
        records[1].area = 3.0;
        assert_eq!(left(&records, 1.0), Left::AtFirst(10.0));
        assert!(matches!(left(&[], 1.0), Left::Not(_)));
    }
}
