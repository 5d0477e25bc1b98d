//! A comparison as a run with a folder and a report, so that a study can have many of them side by side.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::comparison::{Comparison, Side};
use super::measures::measures;
use super::pair::{CompareError, Task};
use super::{direct, files, side_by_side};
use crate::run::execute::{Mode, RunError};
use crate::run::folder;
use crate::run::numbers::{self, Length, expected_speed};
use crate::run::processor_time::ProcessorTime;
use crate::run::report::{Machine, Reached, Report, SolverReport, Status, WallTime, readings};
use crate::run::simulation::Watcher;
use meniscus_core::solver::{Clock, Series};

/// Why a comparison has no report.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ExecuteError {
    /// Its folder, or a file in it.
    #[error(transparent)]
    Run(#[from] RunError),
    /// Its cases.
    #[error(transparent)]
    Cases(CompareError),
}

/// Compares both cases of a task and writes the files of the comparison and `report.json`; `resolved` is the text of both cases.
///
/// # Errors
/// [`ExecuteError`]. A failing solver and an interrupt are not errors here: the report states them.
pub(crate) fn execute(
    task: &Task<'_>,
    resolved: &str,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<Report, ExecuteError> {
    let (clock, processor_time) = (Instant::now(), ProcessorTime::start());
    let _claim = match task.mode {
        Mode::New => folder::create(task.folder),
        Mode::Resume => folder::reopen(task.folder, &task.folder.join(direct::RUN)),
    }
    .map_err(RunError::from)?;
    let (found, status, error) = match side_by_side::compare(task, interrupt, watcher) {
        Ok(found) => (Some(found), Status::Done, None),
        Err(CompareError::Interrupted) => (None, Status::Interrupted, None),
        Err(error @ (CompareError::Solver(_) | CompareError::Failed(_))) => {
            (None, Status::Failed, Some(error.to_string()))
        }
        Err(CompareError::Run(error)) => return Err(error.into()),
        Err(misfit) => return Err(ExecuteError::Cases(misfit)),
    };
    let mut report = report(task, resolved, found.as_ref());
    report.status = status;
    report.error = error;
    report.wall_time_s.total = clock.elapsed().as_secs_f64();
    // That of the direct simulation includes previous processes.
    let of_both = found.as_ref().and_then(|it| Some(it.network.processor_time_s? + it.direct.processor_time_s?));
    report.cpu_s = of_both.or(processor_time.seconds());
    if let Some(found) = &found {
        files::write(found, task.folder).map_err(RunError::from)?;
    }
    report.write(task.folder).map_err(RunError::from)?;
    Ok(report)
}

/// The report of a comparison; that without results if it is `None`.
fn report(task: &Task<'_>, resolved: &str, found: Option<&Comparison>) -> Report {
    let (none, pair) = (Side::default(), &task.pair);
    let [network, direct] = found.map_or([&none; 2], |found| [&found.network, &found.direct]);
    let reached = found.map_or(0.0, |_| pair.direct.end);
    let length = Length::of(pair.direct);
    let (speed, _) = expected_speed(pair.direct, length);
    let measured = found.map_or(Vec::new(), measures);
    let parts = [("network", network.wall_time_s), ("direct simulation", direct.wall_time_s)];
    Report {
        version: env!("CARGO_PKG_VERSION"),
        status: Status::Done,
        error: None,
        time_s: Some(reached),
        clock: Reached { clock: Clock::TIME, value: reached },
        steps: direct.steps,
        steady: None,
        measures: readings(measured, &Series::default(), &[]),
        expectations: Vec::new(),
        numbers: numbers::numbers(pair.direct, length, speed),
        length_of_numbers: length,
        depth: pair.direct.depth_text(),
        case: pair.direct.clone(),
        resolved_case: resolved.to_owned(),
        machine: Machine::present(),
        wall_time_s: WallTime { total: 0.0, parts: parts.into() },
        cpu_s: None,
        warnings: network.warnings.iter().chain(&direct.warnings).cloned().collect(),
        solver: SolverReport {
            unknowns: direct.unknowns,
            steps: direct.steps,
            wall_time_s: direct.wall_time_s,
            counts: Default::default(),
        },
    }
}
