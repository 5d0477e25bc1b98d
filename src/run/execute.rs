//! One run from the folder to the report: prepares or resumes, runs, draws the picture, writes the report.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::claim::Claim;
use super::extension;
use super::folder;
use super::folder_error::FolderError;
use super::numbers::{self, Length};
use super::processor_time::ProcessorTime;
use super::records::Records;
use super::report::{self, Machine, Reached, Report, SolverReport, Status, readings, verdicts, wall_time};
use super::schedule::Schedule;
use super::setup;
use super::simulation::{Outcome, Simulation, Watcher};
use super::sink::{Start, compression};
use super::steady::Steadiness;
use meniscus_case::Case;
use meniscus_core::snapshot::Layer;
use meniscus_core::solver::{Clock, Measure, Results, Series, Solver, StateError};
use meniscus_core::table::Document;
use meniscus_output::checksum::fnv1a;
use meniscus_output::network_page::{self, TooMany};
use meniscus_output::picture::{PictureError, picture, region_map_picture};
use meniscus_output::{FileError, atomic, diagram, table, vtk};

/// Whether a run is new or resumed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// In a folder that does not exist or is empty.
    New,
    /// From the saved state in the folder; a run that ended may be extended to a later end.
    Resume,
}

/// A run and its output folder.
#[derive(Debug, Clone)]
pub struct Job<'a> {
    /// The case.
    pub case: &'a Case,
    /// The case file with all defaults filled in.
    pub resolved: &'a str,
    /// The output folder.
    pub folder: PathBuf,
    /// New or resumed.
    pub mode: Mode,
}

/// Why a run has no report.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The output folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file cannot be written or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The saved state does not fit the solver.
    #[error("{0}; start the run again without --resume")]
    State(#[from] StateError),
    /// The case cannot be written as JSON.
    #[error("the case cannot be encoded: {0}")]
    Case(String),
}

/// A run that ended, successfully or not, and left a report.
#[derive(Debug)]
pub struct Finished {
    /// The report, as written.
    pub report: Report,
    /// The rows of `series.csv`.
    pub series: Series,
    /// The output folder.
    pub folder: PathBuf,
    /// The picture, or why there is none.
    pub picture: Result<PathBuf, PictureError>,
    /// The page to play the displacement, of the runs that have one; how many pores it would have where they are too many.
    pub page: Option<Result<PathBuf, TooMany>>,
    /// Whether a resumed run was at its end already, so that nothing was done.
    pub was_at_end: bool,
}

/// The hash that identifies the case of a saved state: equal for equal values, however they were written.
pub(crate) fn case_hash(case: &Case) -> Result<u64, RunError> {
    serde_json::to_vec(case).map(|bytes| fnv1a(&bytes)).map_err(|error| RunError::Case(error.to_string()))
}

/// Runs a case with its solver, which is at time zero. `interrupt` stops it after the present step.
///
/// # Errors
/// [`RunError`] if there is no folder to write to or a record cannot be written. A failing solver, an interrupt or a missed expectation are not errors here:
/// the report states them.
pub fn execute(
    job: &Job<'_>,
    solver: &mut dyn Solver,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<Finished, RunError> {
    let (clock, mut processor_time) = (Instant::now(), ProcessorTime::start());
    let hash = case_hash(job.case)?;
    let (start, _claim) = prepare(job, solver, hash)?;
    if start != Start::New {
        processor_time = processor_time.after_that_in(&job.folder);
    }
    let compression = compression(&job.case.output);
    let mut records = Records::new(&job.folder, hash, start, compression, processor_time)?;
    let schedule = Schedule::new(&job.case.output, job.case.end);
    let steady = job.case.steady;
    let mut simulation = Simulation { solver, schedule, steady, records: &mut records, interrupt, watcher };
    let was_at_end = start != Start::New && simulation.is_at_end();
    let started = if start == Start::New { simulation.begin() } else { simulation.resume() };
    let ended = started.and_then(|()| simulation.run());
    // While the last records are still being written.
    let measures = solver.measures(records.series());
    let written = records.finish();
    let ended = ended.and_then(|outcome| written.map(|()| outcome));
    let mut report = report((job.case, job.resolved), solver, &records, measures, &ended);
    report.wall_time_s.total = clock.elapsed().as_secs_f64();
    report.cpu_s = records.processor_time();
    // The report of the run that reached the end has more: its wall time, its machine.
    let is_told = was_at_end && report::is_final(&job.folder);
    let written = if is_told { Ok(()) } else { report.write(&job.folder) };
    // The record that could not be written is the error to report, not the report after it.
    ended?;
    written?;
    let picture = draw(job, solver)?;
    write_results(job, &solver.results())?;
    draw_diagrams(job, solver)?;
    let page = write_page(job, solver)?;
    Ok(Finished { report, series: records.into_series(), folder: job.folder.clone(), picture, page, was_at_end })
}

/// Runs a case with its solver, which is at time zero, to the same bits without files: its series and its report stay in memory, and its final state in its
/// solver. `resolved` is the case file with all defaults filled in; `interrupt` stops the run after the present step.
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
    let (clock, mut records) = (Instant::now(), Records::default());
    let (schedule, steady) = (Schedule::new(&case.output, case.end), case.steady);
    let mut simulation = Simulation { solver, schedule, steady, records: &mut records, interrupt, watcher };
    let started = simulation.begin();
    let ended = started.and_then(|()| simulation.run());
    let measures = solver.measures(records.series());
    let mut report = report((case, resolved), solver, &records, measures, &ended);
    report.wall_time_s.total = clock.elapsed().as_secs_f64();
    ended?;
    Ok((report, records.into_series()))
}

/// Creates the folder, or loads the saved state in it, with exclusive access.
fn prepare(job: &Job<'_>, solver: &mut dyn Solver, hash: u64) -> Result<(Start, Claim), RunError> {
    match job.mode {
        Mode::New => Ok((Start::New, folder::create(&job.folder)?)),
        Mode::Resume => {
            let hash = extension::hash_of_shorter(&job.folder, job.case).unwrap_or(hash);
            let (saved, claim) = folder::resume(&job.folder, hash)?;
            solver.restore(&saved.state)?;
            Ok((Start::Resumed { series: saved.series, frames: saved.frames }, claim))
        }
    }
}

/// The report of a run of a case, as resolved, given its `measures` and how it `ended`, without its total times.
fn report(
    (case, resolved): (&Case, &str),
    solver: &dyn Solver,
    records: &Records,
    measures: Vec<Measure>,
    ended: &Result<Outcome, FileError>,
) -> Report {
    let (mut status, error) = match ended {
        Ok(Outcome::Done) => (Status::Done, None),
        Ok(Outcome::Interrupted) => (Status::Interrupted, None),
        Ok(Outcome::Failed(error)) => (Status::Failed, Some(error.to_string())),
        Err(error) => (Status::Failed, Some(error.to_string())),
    };
    let statistics = solver.statistics();
    let fastest = records.series().column("max_speed_m_per_s").filter(|speed| speed.is_finite()).fold(0.0, f64::max);
    let length = Length::of(case);
    let steady = case.steady.map(|steady| Steadiness::of(records.series(), &solver.watched(), &steady));
    let mut measures = readings(measures, records.series(), &solver.watched());
    measures.extend(steady.iter().map(report::steady_reading));
    let mut expectations = verdicts(&case.expect, &measures);
    if status != Status::Done {
        expectations.iter_mut().for_each(|verdict| verdict.pass = None);
    } else if expectations.iter().any(|verdict| verdict.pass == Some(false)) {
        status = Status::ExpectationFailed;
    }
    Report {
        version: env!("CARGO_PKG_VERSION"),
        status,
        error,
        time_s: (solver.clock() == Clock::TIME).then(|| solver.time()),
        clock: Reached { clock: solver.clock(), value: solver.time() },
        steps: solver.steps(),
        steady,
        numbers: numbers::reached(case, length, fastest, |name| measures.get(name).and_then(|reading| reading.value)),
        measures,
        expectations,
        length_of_numbers: length,
        depth: case.depth_text(),
        case: case.clone(),
        resolved_case: resolved.to_owned(),
        machine: Machine::present(),
        wall_time_s: wall_time(0.0, statistics.parts.iter().copied().chain(records.parts())),
        cpu_s: None,
        warnings: setup::warnings(case, solver, records.series()),
        solver: SolverReport::from(&statistics),
    }
}

/// The picture of the present state as PNG.
pub(super) fn drawn(case: &Case, solver: &dyn Solver) -> Result<Vec<u8>, PictureError> {
    let title = &case.title;
    let drawn = match solver.region_map() {
        Some(region_map) => region_map_picture(&region_map, title),
        None => picture(&solver.snapshot(), &solver.outline(), title, setup::frame(case).as_ref()),
    };
    drawn?.png()
}

/// Draws the final state. A picture that cannot be drawn does not fail the run; one that cannot be written does.
fn draw(job: &Job<'_>, solver: &dyn Solver) -> Result<Result<PathBuf, PictureError>, FileError> {
    let path: &Path = &job.folder.join("picture.png");
    match drawn(job.case, solver) {
        Ok(png) => atomic::write(path, &png).map(|()| Ok(path.to_path_buf())),
        Err(error) => Ok(Err(error)),
    }
}

/// Writes tables, layers and texts: one of each at a time, which are then in memory.
fn write_results(job: &Job<'_>, results: &Results<'_>) -> Result<(), FileError> {
    let folder = &job.folder;
    let layer = |layer: &Layer<'_>| {
        let path = folder.join(format!("{}.vtu", layer.name));
        let content = vtk::layer(layer, compression(&job.case.output))
            .map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
        atomic::write(&path, &content)
    };
    let text = |one: &Document<'_>| atomic::write_with(&folder.join(one.name), |to| one.write(to));
    let texts = || results.documents.iter().try_for_each(text);
    let tables = || results.tables.iter().try_for_each(|one| table::write(folder, &one()));
    let layers = || results.layers.iter().try_for_each(|one| layer(&one()));
    let (texts, (tables, layers)) = rayon::join(texts, || rayon::join(tables, layers));
    texts.and(tables).and(layers)
}

/// Draws the diagrams of the run; any that cannot be drawn are left out.
fn draw_diagrams(job: &Job<'_>, solver: &dyn Solver) -> Result<(), FileError> {
    for diagram in solver.diagrams() {
        if let Ok(Some(svg)) = diagram::svg(&diagram) {
            atomic::write(&job.folder.join(format!("diagram-{}.svg", diagram.name)), svg.as_bytes())?;
        }
    }
    Ok(())
}

/// Writes the page on which the displacement is played, if the solver has one.
fn write_page(job: &Job<'_>, solver: &dyn Solver) -> Result<Option<Result<PathBuf, TooMany>>, FileError> {
    let Some(playback) = solver.playback() else { return Ok(None) };
    let path = job.folder.join(network_page::NAME);
    match network_page::page(&job.case.title, &[(&job.case.title, &playback)]) {
        Ok(html) => atomic::write(&path, html.as_bytes()).map(|()| Some(Ok(path))),
        Err(too_many) => Ok(Some(Err(too_many))),
    }
}

#[cfg(test)]
#[allow(unreachable_pub, reason = "the tests beside the library use it too")]
#[path = "../../tests/support/files.rs"]
mod files;

#[cfg(test)]
mod tests;
