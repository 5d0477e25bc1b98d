//! Runs of a mock solver: files, resuming, failures and folders.

use super::super::mock::{Interrupter, MockSolver, case};
use super::files::files;
use super::*;
use crate::run::simulation::Unwatched;
use meniscus_case::SteadyStop;

fn job<'a>(case: &'a Case, folder: &Path, mode: Mode) -> Job<'a> {
    Job { case, resolved: "format = 1\n", folder: folder.to_path_buf(), mode }
}

fn run(case: &Case, folder: &Path, mode: Mode) -> Result<Finished, RunError> {
    let never = AtomicBool::new(false);
    execute(&job(case, folder, mode), &mut MockSolver::new(), &never, &mut Unwatched)
}

fn json(folder: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(folder.join("report.json")).unwrap()).unwrap()
}

#[test]
fn a_run_killed_between_its_last_state_and_its_report_is_told_anew() {
    let folder = tempfile::tempdir().unwrap();
    let interrupt = AtomicBool::new(true);
    execute(&job(&case(), folder.path(), Mode::New), &mut MockSolver::new(), &interrupt, &mut Unwatched).unwrap();
    let old = std::fs::read(folder.path().join("report.json")).unwrap();
    run(&case(), folder.path(), Mode::Resume).unwrap();
    std::fs::write(folder.path().join("report.json"), old).unwrap();
    assert_eq!(json(folder.path())["status"], "interrupted");
    assert!(run(&case(), folder.path(), Mode::Resume).unwrap().was_at_end);
    assert_eq!(json(folder.path())["status"], "done");
    // The report of the run that did the work is kept.
    let done = std::fs::read(folder.path().join("report.json")).unwrap();
    run(&case(), folder.path(), Mode::Resume).unwrap();
    assert!(std::fs::read(folder.path().join("report.json")).unwrap() == done);
}

#[test]
fn series_and_measures_without_files_are_those_of_a_run_with_files() {
    let (case, folder) = (case(), tempfile::tempdir().unwrap());
    let written = run(&case, folder.path(), Mode::New).unwrap();
    let never = AtomicBool::new(false);
    let (report, series) = run_in_memory(&case, "", &mut MockSolver::new(), &never, &mut Unwatched).unwrap();
    assert!(series.rows.len() > 2);
    assert_eq!(format!("{series:?}"), format!("{:?}", written.series));
    assert_eq!(report.measures, written.report.measures);
    assert_eq!((report.status, report.steps), (written.report.status, written.report.steps));
}

/// A case that is steady at 0.24 s: the first record with five rows in each of three windows.
fn steady_case() -> Case {
    let mut case = case();
    case.steady = Some(SteadyStop::default());
    case.output.series_every = 0.01;
    case
}

#[test]
fn a_steady_run_ends_early_with_all_its_records() {
    let folder = tempfile::tempdir().unwrap();
    let finished = run(&steady_case(), folder.path(), Mode::New).unwrap();
    assert_eq!((finished.report.status, finished.report.clock.value), (Status::Done, 0.24));
    let report = json(folder.path());
    assert_eq!(report["measures"]["steady-at-s"]["value"], 0.24);
    assert_eq!(report["steady"]["at-s"], 0.24);
    assert_eq!(report["steady"]["quantities"][0]["column"], "max_speed_m_per_s");
    assert_eq!(meniscus_output::restart::load(folder.path()).unwrap().time, 0.24);
    assert!(std::fs::read_to_string(folder.path().join("particles.pvd")).unwrap().contains("timestep=\"0.24\""));
    // There is nothing left to do, and nothing is changed.
    let before = files(folder.path());
    assert!(run(&steady_case(), folder.path(), Mode::Resume).unwrap().was_at_end);
    assert!(files(folder.path()) == before);
}

#[test]
fn a_broken_and_resumed_run_is_steady_at_the_same_moment() {
    let unbroken = tempfile::tempdir().unwrap();
    run(&steady_case(), unbroken.path(), Mode::New).unwrap();
    for steps in [1, 12, 23] {
        let folder = tempfile::tempdir().unwrap();
        let (case, interrupt) = (steady_case(), AtomicBool::new(false));
        let mut after = Interrupter { steps, interrupt: &interrupt };
        execute(&job(&case, folder.path(), Mode::New), &mut MockSolver::new(), &interrupt, &mut after).unwrap();
        let told = json(folder.path());
        assert_eq!(
            (&told["status"], &told["expectations"][0]["pass"]),
            (&"interrupted".into(), &serde_json::Value::Null)
        );
        assert!(!run(&case, folder.path(), Mode::Resume).unwrap().was_at_end);
        assert!(files(folder.path()) == files(unbroken.path()), "the bytes differ after a stop at step {steps}");
        assert_eq!(json(folder.path())["steady"], json(unbroken.path())["steady"]);
    }
}

#[test]
fn a_run_that_only_says_when_it_is_steady_goes_on_to_its_end() {
    let mut case = steady_case();
    case.steady = Some(SteadyStop { stop: false, ..SteadyStop::default() });
    let folder = tempfile::tempdir().unwrap();
    let report = run(&case, folder.path(), Mode::New).unwrap().report;
    assert_eq!(report.clock.value, 1.0);
    assert_eq!(report.measures["steady-at-s"].value, Some(0.24));
}

#[test]
fn a_run_with_too_few_records_says_that_it_cannot_tell() {
    let mut case = steady_case();
    case.output.series_every = 0.1;
    let folder = tempfile::tempdir().unwrap();
    let report = run(&case, folder.path(), Mode::New).unwrap().report;
    assert_eq!((report.clock.value, report.measures["steady-at-s"].value), (1.0, None));
    assert!(report.measures["steady-at-s"].method.contains("too short"), "{:?}", report.measures["steady-at-s"]);
}

#[test]
fn a_finished_run_goes_on_to_a_later_end() {
    let (folder, unbroken) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    run(&case(), folder.path(), Mode::New).unwrap();
    let mut longer = case();
    longer.end *= 2.0;
    let finished = run(&longer, folder.path(), Mode::Resume).unwrap();
    assert!(!finished.was_at_end);
    run(&longer, unbroken.path(), Mode::New).unwrap();
    // The first end is a record of both.
    assert!(files(folder.path()) == files(unbroken.path()));
    assert_eq!(json(folder.path())["clock"]["value"], longer.end);
    // An earlier end, or another fluid, makes it another case.
    assert!(run(&case(), folder.path(), Mode::Resume).is_err());
}

/// Puts a file where the next grid files should go, to fail in the middle of a run, like a full disk.
struct Spoiler<'a>(&'a Path);

impl Watcher for Spoiler<'_> {
    fn stepped(&mut self, progress: &crate::run::simulation::Progress) {
        if progress.step == 12 {
            // The files of an earlier record may still be being written, and recreate the folder.
            while std::fs::write(self.0.join("grid"), "").is_err() {
                let _ = std::fs::remove_dir_all(self.0.join("grid"));
            }
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
    let error = execute(&job, &mut MockSolver::new(), &never, &mut spoiler).unwrap_err().to_string();
    assert!(error.contains("grid") && error.contains("--out DIR"), "{error}");
    assert_eq!(json(folder.path())["status"], "failed");
    assert_eq!(json(folder.path())["error"], error);
    assert_eq!(meniscus_output::restart::load(folder.path()).unwrap().time, 0.0);
}

#[cfg(unix)]
#[test]
fn a_folder_that_may_not_be_written_to_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    std::fs::set_permissions(folder.path(), std::fs::Permissions::from_mode(0o555)).unwrap();
    let refused = run(&case(), &folder.path().join("out"), Mode::New);
    std::fs::set_permissions(folder.path(), std::fs::Permissions::from_mode(0o755)).unwrap();
    // The administrator may write anywhere; then nothing is refused.
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
