//! A run without files: its series and its report stay in memory, and its final state in its solver.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::execute::report;
use super::records::Records;
use super::report::Report;
use super::schedule::Schedule;
use super::simulation::{Simulation, Watcher};
use crate::case::Case;
use crate::io::FileError;
use crate::solver::{Series, Solver};

/// Runs a case with its solver, which is at time zero, to the same bits as [`execute`](super::execute::execute) does. `resolved` is the case file with all
/// defaults filled in; `interrupt` stops the run after the present step.
///
/// # Errors
/// [`FileError`] of the watcher. A failing solver, an interrupt or a missed expectation are not errors here: the report states them.
pub fn run_in_memory(
    case: &Case,
    resolved: &str,
    solver: &mut dyn Solver,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<(Report, Series), FileError> {
    let clock = Instant::now();
    let mut records = Records::default();
    let schedule = Schedule::new(&case.output, case.end);
    let mut simulation =
        Simulation { solver, schedule, steady: case.steady, records: &mut records, interrupt, watcher };
    let started = simulation.begin();
    let ended = started.and_then(|()| simulation.run());
    let mut report = report(case, resolved, solver, &records, &ended);
    report.wall_time_s.total = clock.elapsed().as_secs_f64();
    ended?;
    Ok((report, records.into_series()))
}

#[cfg(test)]
mod tests {
    use super::super::execute::{Job, Mode, execute};
    use super::super::mock::{MockSolver, case};
    use super::super::simulation::Unwatched;
    use super::*;

    #[test]
    fn series_and_measures_are_those_of_a_run_with_files() {
        let (case, folder) = (case(), tempfile::tempdir().unwrap());
        let interrupt = AtomicBool::new(false);
        let job = Job { case: &case, resolved: "", folder: folder.path().join("out"), mode: Mode::New };
        let written = execute(&job, &mut MockSolver::new(), &interrupt, &mut Unwatched).unwrap();
        let (report, series) = run_in_memory(&case, "", &mut MockSolver::new(), &interrupt, &mut Unwatched).unwrap();
        assert!(series.rows.len() > 2);
        assert_eq!(format!("{series:?}"), format!("{:?}", written.series));
        assert_eq!(report.measures, written.report.measures);
        assert_eq!((report.status, report.steps), (written.report.status, written.report.steps));
    }
}
