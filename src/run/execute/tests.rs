//! Runs of a mock solver: files, resuming, failures and folders.

use super::super::mock::{Interrupter, MockSolver, case};
use super::files::files;
use super::*;
use crate::case::SteadyStop;
use crate::run::simulation::Unwatched;

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
fn a_run_leaves_every_file_of_the_output_contract() {
    let folder = tempfile::tempdir().unwrap();
    let finished = run(&case(), folder.path(), Mode::New).unwrap();
    assert_eq!(finished.report.status, Status::Done);
    let names: Vec<String> = files(folder.path()).keys().map(|path| path.display().to_string()).collect();
    for name in [
        "grid.pvd",
        "grid/grid-000005.vtu",
        "interface.pvd",
        "interface/interface-000000.vtu",
        "particles.pvd",
        "particles/particles-000000.vtu",
        "particles/particles-000005.vtu",
        "picture.png",
        "restart/state.bin",
        "series.csv",
        "solid.vtu",
        "units.json",
    ] {
        assert!(names.iter().any(|found| found == name), "{name} is missing among {names:?}");
    }
    assert!(names.iter().all(|name| !name.contains("part.") && !name.ends_with(".part") && !name.contains("probe")));
    let series = std::fs::read_to_string(folder.path().join("series.csv")).unwrap();
    assert_eq!(series.lines().count(), 1 + 11);
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
            execute(&job(&case(), folder.path(), Mode::New), &mut MockSolver::new(), &interrupt, &mut after).unwrap();
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
    // After a kill, files may be ahead of the saved state, here by all that followed time zero.
    let early = tempfile::tempdir().unwrap();
    let interrupt = AtomicBool::new(true);
    execute(&job(&case(), early.path(), Mode::New), &mut MockSolver::new(), &interrupt, &mut Unwatched).unwrap();
    std::fs::copy(early.path().join("restart/state.bin"), killed.path().join("restart/state.bin")).unwrap();
    run(&case(), killed.path(), Mode::Resume).unwrap();
    assert!(files(killed.path()) == files(unbroken.path()));
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
    assert_eq!(crate::io::restart::load(folder.path()).unwrap().time, 0.24);
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
        assert_eq!(json(folder.path())["status"], "interrupted");
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
fn a_solver_that_fails_leaves_its_last_good_state_and_a_report() {
    let folder = tempfile::tempdir().unwrap();
    let never = AtomicBool::new(false);
    let mut solver = MockSolver::new();
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
    assert!(["--out", "--resume", "delete"].iter().all(|remedy| message.contains(remedy)), "{message}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
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

#[test]
fn resuming_nothing_or_another_case_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let message = run(&case(), folder.path(), Mode::Resume).unwrap_err().to_string();
    assert!(message.contains("no run to resume"), "{message}");
    run(&case(), folder.path(), Mode::New).unwrap();
    let mut other = case();
    other.end *= 0.5;
    let message = run(&other, folder.path(), Mode::Resume).unwrap_err().to_string();
    assert!(message.contains("another case"), "{message}");
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
