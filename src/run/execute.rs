//! One run from the folder to the report: prepares or resumes, runs, draws the picture, writes the report.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::folder::{self, FolderError};
use super::numbers::{self, Length};
use super::processor_time::ProcessorTime;
use super::report::{self, Machine, Reached, Report, SolverReport, Status, readings, verdicts, wall_time};
use super::schedule::Schedule;
use super::simulation::{Outcome, Records, Simulation, Watcher};
use super::sink::Start;
use crate::case::checked::Case;
use crate::io::checksum::fnv1a;
use crate::io::picture::{PictureError, mosaic_picture, picture};
use crate::io::{FileError, atomic, diagram, table, vtk};
use crate::solver::{Clock, Results, Solver, StateError};

/// Whether a run is new or goes on with one that stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// In a folder that does not exist or is empty.
    New,
    /// From the saved state in the folder.
    Resume,
}

/// What is to be run and where the results go.
#[derive(Debug, Clone)]
pub struct Job<'a> {
    /// The case.
    pub case: &'a Case,
    /// The case file with all that was filled in.
    pub resolved: &'a str,
    /// The output folder.
    pub folder: PathBuf,
    /// New or resumed.
    pub mode: Mode,
}

/// A run that has no report.
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

/// A run that ended, well or not, and left a report.
#[derive(Debug)]
pub struct Finished {
    /// The report, as written.
    pub report: Report,
    /// The output folder.
    pub folder: PathBuf,
    /// The picture, or why there is none.
    pub picture: Result<PathBuf, PictureError>,
    /// Whether a resumed run was at its end already, so that nothing was done.
    pub was_at_end: bool,
}

/// The hash that tells whether a saved state belongs to a case: equal for equal values, however they were written.
///
/// # Errors
/// [`RunError::Case`].
pub fn case_hash(case: &Case) -> Result<u64, RunError> {
    serde_json::to_vec(case).map(|bytes| fnv1a(&bytes)).map_err(|error| RunError::Case(error.to_string()))
}

/// Runs a case with its solver, which stands at time zero. `interrupt` stops it after the present step.
///
/// # Errors
/// [`RunError`] where there is no folder to write to or a record cannot be written. A solver that fails, an interrupt or
/// a missed expectation are no errors here: the report says so.
pub fn execute(
    job: &Job<'_>,
    solver: &mut dyn Solver,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<Finished, RunError> {
    let (clock, mut processor_time) = (Instant::now(), ProcessorTime::start());
    let hash = case_hash(job.case)?;
    let start = prepare(job, solver, hash)?;
    let was_at_end = start != Start::New && (solver.time() >= job.case.end || solver.is_done());
    if start != Start::New {
        processor_time = processor_time.after_that_in(&job.folder);
    }
    let mut records = Records::new(&job.folder, hash, start, processor_time)?;
    let schedule = Schedule::new(&job.case.output, job.case.end);
    let mut simulation = Simulation { solver, schedule, records: &mut records, interrupt, watcher };
    let begun = if start == Start::New { simulation.begin(&job.folder) } else { Ok(()) };
    let ended = begun.and_then(|()| simulation.run());
    let (status, error) = match &ended {
        Ok(Outcome::Done) => (Status::Done, None),
        Ok(Outcome::Interrupted) => (Status::Interrupted, None),
        Ok(Outcome::Failed(error)) => (Status::Failed, Some(error.to_string())),
        Err(error) => (Status::Failed, Some(error.to_string())),
    };
    let mut report = report(job, solver, &records, status);
    report.error = error;
    report.wall_time_s.total = clock.elapsed().as_secs_f64();
    report.cpu_s = records.processor_time();
    // The report of the run that reached the end tells more: its wall time, its machine.
    let is_told = was_at_end && report::is_of_the_end(&job.folder);
    let written = if is_told { Ok(()) } else { report.write(&job.folder) };
    // The record that could not be written is the error to tell, not the report after it.
    ended?;
    written?;
    let results = solver.results();
    let picture = draw(job, solver, &results)?;
    write_results(&job.folder, &results, solver.time())?;
    draw_diagrams(job, solver)?;
    Ok(Finished { report, folder: job.folder.clone(), picture, was_at_end })
}

/// Makes the folder, or takes up the saved state in it.
fn prepare(job: &Job<'_>, solver: &mut dyn Solver, hash: u64) -> Result<Start, RunError> {
    match job.mode {
        Mode::New => folder::create(&job.folder).map(|()| Start::New).map_err(RunError::from),
        Mode::Resume => {
            let saved = folder::resume(&job.folder, hash)?;
            solver.restore(&saved.state)?;
            Ok(Start::At(saved.time))
        }
    }
}

fn report(job: &Job<'_>, solver: &dyn Solver, records: &Records, status: Status) -> Report {
    let statistics = solver.statistics();
    let fastest = records.series().column("max_speed_m_per_s").filter(|speed| speed.is_finite()).fold(0.0, f64::max);
    let length = Length::of(job.case);
    let measures = readings(solver.measures(records.series()));
    let mut expectations = verdicts(&job.case.expect, &measures);
    let mut status = status;
    if status != Status::Done {
        expectations.iter_mut().for_each(|verdict| verdict.pass = None);
    } else if expectations.iter().any(|verdict| verdict.pass == Some(false)) {
        status = Status::ExpectationFailed;
    }
    Report {
        version: env!("CARGO_PKG_VERSION"),
        status,
        error: None,
        time_s: (solver.clock() == Clock::TIME).then(|| solver.time()),
        clock: Reached { clock: solver.clock(), value: solver.time() },
        steps: solver.steps(),
        measures,
        expectations,
        numbers: numbers::numbers(job.case, length, fastest),
        length_of_numbers: length,
        case: job.case.clone(),
        resolved_case: job.resolved.to_owned(),
        machine: Machine::present(),
        wall_time_s: wall_time(0.0, statistics.parts.iter().copied().chain(records.parts())),
        cpu_s: None,
        solver: SolverReport::from(&statistics),
    }
}

/// Draws the state at the end. A picture that cannot be drawn does not spoil a run; one that cannot be written does.
fn draw(job: &Job<'_>, solver: &dyn Solver, results: &Results<'_>) -> Result<Result<PathBuf, PictureError>, FileError> {
    let path: &Path = &job.folder.join("picture.png");
    let title = &job.case.title;
    let drawn = match results.mosaics.first() {
        Some(mosaic) => mosaic_picture(mosaic, title),
        None => picture(&solver.snapshot(), &solver.outline(), title),
    };
    match drawn {
        Ok(png) => atomic::write(path, &png).map(|()| Ok(path.to_path_buf())),
        Err(error) => Ok(Err(error)),
    }
}

/// Writes tables, layers, texts and further maps.
fn write_results(folder: &Path, results: &Results<'_>, time: f64) -> Result<(), FileError> {
    results.tables.iter().try_for_each(|one| table::write(folder, one))?;
    for layer in &results.layers {
        let path = folder.join(format!("{}.vtp", layer.name));
        let content = vtk::layer(layer, time)
            .map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
        atomic::write(&path, &content)?;
    }
    for document in &results.documents {
        atomic::write(&folder.join(document.name), document.text.as_bytes())?;
    }
    Ok(())
}

/// Draws the diagrams of the run; one that cannot be drawn is left out.
fn draw_diagrams(job: &Job<'_>, solver: &dyn Solver) -> Result<(), FileError> {
    for diagram in solver.diagrams() {
        if let Ok(Some(svg)) = diagram::svg(&diagram) {
            atomic::write(&job.folder.join(format!("diagram-{}.svg", diagram.name)), svg.as_bytes())?;
        }
    }
    Ok(())
}

#[cfg(test)]
#[path = "../../tests/support/files.rs"]
mod files;

#[cfg(test)]
mod tests {
    use super::super::toy::{Interrupter, ToySolver, case};
    use super::files::files;
    use super::*;
    use crate::run::simulation::Unwatched;

    fn job<'a>(case: &'a Case, folder: &Path, mode: Mode) -> Job<'a> {
        Job { case, resolved: "format = 1\n", folder: folder.to_path_buf(), mode }
    }

    fn run(case: &Case, folder: &Path, mode: Mode) -> Result<Finished, RunError> {
        let never = AtomicBool::new(false);
        execute(&job(case, folder, mode), &mut ToySolver::new(), &never, &mut Unwatched)
    }

    fn json(folder: &Path) -> serde_json::Value {
        serde_json::from_slice(&std::fs::read(folder.join("report.json")).unwrap()).unwrap()
    }

    #[test]
    fn a_run_leaves_every_file_of_the_output_contract() {
        let folder = tempfile::tempdir().unwrap();
        let finished = run(&case(), folder.path(), Mode::New).unwrap();
        assert_eq!(finished.report.status, Status::Done);
        let names: Vec<String> = files(folder.path()).keys().map(|path| path.display().to_string()).collect();
        for name in [
            "grid.pvd",
            "grid/grid-000005.vti",
            "interface.pvd",
            "interface/interface-000000.vtp",
            "particles.pvd",
            "particles/particles-000000.vtu",
            "particles/particles-000005.vtu",
            "picture.png",
            "restart/state.bin",
            "series.csv",
            "solid.vtp",
            "units.json",
        ] {
            assert!(names.iter().any(|found| found == name), "{name} is missing among {names:?}");
        }
        assert!(
            names.iter().all(|name| !name.contains("part.") && !name.ends_with(".part") && !name.contains("probe"))
        );
        let series = crate::io::series::read(&folder.path().join("series.csv")).unwrap();
        assert_eq!(series.rows.len(), 11);
        let report = json(folder.path());
        assert_eq!(report["status"], "done");
        assert_eq!(report["measures"]["radius-m"]["unit"], "m");
        assert!(report["measures"]["missing-angle-deg"]["value"].is_null());
        assert_eq!(report["expectations"][0]["pass"], true);
    }

    #[test]
    fn a_broken_and_resumed_run_leaves_the_same_bytes_as_an_unbroken_one() {
        let unbroken = tempfile::tempdir().unwrap();
        run(&case(), unbroken.path(), Mode::New).unwrap();
        for steps in [1, 7, 20, 41] {
            let folder = tempfile::tempdir().unwrap();
            let interrupt = AtomicBool::new(false);
            let mut after = Interrupter { steps, interrupt: &interrupt };
            let broken =
                execute(&job(&case(), folder.path(), Mode::New), &mut ToySolver::new(), &interrupt, &mut after)
                    .unwrap();
            assert_eq!(broken.report.status, Status::Interrupted);
            assert_eq!(json(folder.path())["expectations"][0]["pass"], serde_json::Value::Null);
            let resumed = run(&case(), folder.path(), Mode::Resume).unwrap();
            assert_eq!(resumed.report.status, Status::Done);
            assert!(files(folder.path()) == files(unbroken.path()), "the bytes differ after a stop at step {steps}");
        }
    }

    #[test]
    fn a_killed_run_resumes_from_its_last_saved_state_without_doubling_a_time() {
        let unbroken = tempfile::tempdir().unwrap();
        run(&case(), unbroken.path(), Mode::New).unwrap();
        let killed = tempfile::tempdir().unwrap();
        run(&case(), killed.path(), Mode::New).unwrap();
        // What a kill leaves: files that run ahead of the saved state, here by all that followed time zero.
        let early = tempfile::tempdir().unwrap();
        let interrupt = AtomicBool::new(true);
        execute(&job(&case(), early.path(), Mode::New), &mut ToySolver::new(), &interrupt, &mut Unwatched).unwrap();
        std::fs::copy(early.path().join("restart/state.bin"), killed.path().join("restart/state.bin")).unwrap();
        run(&case(), killed.path(), Mode::Resume).unwrap();
        assert!(files(killed.path()) == files(unbroken.path()));
    }

    #[test]
    fn a_run_killed_between_its_last_state_and_its_report_is_told_anew() {
        let folder = tempfile::tempdir().unwrap();
        let interrupt = AtomicBool::new(true);
        execute(&job(&case(), folder.path(), Mode::New), &mut ToySolver::new(), &interrupt, &mut Unwatched).unwrap();
        let old = std::fs::read(folder.path().join("report.json")).unwrap();
        run(&case(), folder.path(), Mode::Resume).unwrap();
        std::fs::write(folder.path().join("report.json"), old).unwrap();
        assert_eq!(json(folder.path())["status"], "interrupted");
        assert!(run(&case(), folder.path(), Mode::Resume).unwrap().was_at_end);
        assert_eq!(json(folder.path())["status"], "done");
        // The report of the run that did the work stays.
        let done = std::fs::read(folder.path().join("report.json")).unwrap();
        run(&case(), folder.path(), Mode::Resume).unwrap();
        assert!(std::fs::read(folder.path().join("report.json")).unwrap() == done);
    }

    #[test]
    fn a_solver_that_fails_leaves_its_last_good_state_and_a_report() {
        let folder = tempfile::tempdir().unwrap();
        let never = AtomicBool::new(false);
        let mut solver = ToySolver::new();
        solver.fails_after = Some(13);
        let finished = execute(&job(&case(), folder.path(), Mode::New), &mut solver, &never, &mut Unwatched).unwrap();
        assert_eq!(finished.report.status, Status::Failed);
        assert!(json(folder.path())["error"].as_str().unwrap().contains("(step 13), at (1.0000e0, 0.0000e0) m"));
        let saved = crate::io::restart::load(folder.path()).unwrap();
        assert_eq!((saved.step, saved.time.to_bits()), (13, solver.time().to_bits()));
        let pvd = std::fs::read_to_string(folder.path().join("particles.pvd")).unwrap();
        assert!(pvd.contains(&format!("timestep=\"{:?}\"", saved.time)), "{pvd}");
    }

    #[test]
    fn a_missed_expectation_is_told() {
        let mut missed = case();
        missed.expect[0].value = 2.0;
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(run(&missed, folder.path(), Mode::New).unwrap().report.status, Status::ExpectationFailed);
        missed.expect[0].measure = "no-such-measure".into();
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(run(&missed, folder.path(), Mode::New).unwrap().report.status, Status::ExpectationFailed);
    }

    #[test]
    fn a_folder_with_files_in_it_is_refused_with_three_ways_out() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("thesis.tex"), "").unwrap();
        let message = run(&case(), folder.path(), Mode::New).unwrap_err().to_string();
        assert!(["--out", "--resume", "delete"].iter().all(|way| message.contains(way)), "{message}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn resuming_nothing_or_another_case_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let message = run(&case(), folder.path(), Mode::Resume).unwrap_err().to_string();
        assert!(message.contains("no run to resume"), "{message}");
        run(&case(), folder.path(), Mode::New).unwrap();
        let mut other = case();
        other.end *= 2.0;
        let message = run(&other, folder.path(), Mode::Resume).unwrap_err().to_string();
        assert!(message.contains("another case"), "{message}");
    }

    /// Puts a file where the next grid files should go, as a full disk would come: in the middle of a run.
    struct Spoiler<'a>(&'a Path);

    impl Watcher for Spoiler<'_> {
        fn stepped(&mut self, progress: &crate::run::simulation::Progress) {
            if progress.step == 12 {
                std::fs::remove_dir_all(self.0.join("grid")).unwrap();
                std::fs::write(self.0.join("grid"), "").unwrap();
            }
        }
    }

    #[test]
    fn a_record_that_cannot_be_written_stops_the_run_with_a_report_that_says_so() {
        let folder = tempfile::tempdir().unwrap();
        let never = AtomicBool::new(false);
        let mut spoiler = Spoiler(folder.path());
        let case = case();
        let job = job(&case, folder.path(), Mode::New);
        let error = execute(&job, &mut ToySolver::new(), &never, &mut spoiler).unwrap_err().to_string();
        assert!(error.contains("grid") && error.contains("--out DIR"), "{error}");
        assert_eq!(json(folder.path())["status"], "failed");
        assert_eq!(json(folder.path())["error"], error);
        assert_eq!(crate::io::restart::load(folder.path()).unwrap().time, 0.0);
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_that_may_not_be_written_to_is_refused() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        std::fs::set_permissions(folder.path(), std::fs::Permissions::from_mode(0o555)).unwrap();
        let refused = run(&case(), &folder.path().join("out"), Mode::New);
        std::fs::set_permissions(folder.path(), std::fs::Permissions::from_mode(0o755)).unwrap();
        // The administrator may write anywhere; then there is nothing to refuse.
        if let Err(error) = refused {
            assert!(error.to_string().contains("permission denied; choose a folder that you may write to"), "{error}");
        }
    }

    #[test]
    fn a_folder_below_a_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("file"), "").unwrap();
        let message = run(&case(), &folder.path().join("file/out"), Mode::New).unwrap_err().to_string();
        assert!(message.contains("--out DIR"), "{message}");
    }
}
