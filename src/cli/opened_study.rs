//! Common to all study commands: a study with its runs and its folder, and printed summaries.

use std::path::{Path, PathBuf};

use super::exit::{BUG, DONE, EXPECTATION_FAILED, Failure, INTERRUPTED, SOLVER_FAILED, USAGE};
use super::output::say;
use super::study_arguments::CoresArguments;
use super::threads::{self, within_cores};
use crate::study::child::Program;
use crate::study::definition::Study;
use crate::study::ensemble::plan::{Ensemble, plan as plan_ensemble};
use crate::study::estimate::Cores;
use crate::study::folder::StudyFolder;
use crate::study::load::load;
use crate::study::report::{StudyReport, report};
use crate::study::results::{RunResult, RunState};
use crate::study::run::PlannedRun;
use crate::study::runs::plan;
use crate::study::verdict::Verdict;

/// Most failed runs that are listed.
const MOST_FAILURES: usize = 20;

/// A study with its checked runs and its folder.
pub(crate) struct Opened {
    /// The study.
    pub(crate) study: Study,
    /// Its checked runs; none if samples are run within this process.
    pub(crate) runs: Vec<PlannedRun>,
    /// Samples that are run within this process.
    pub(crate) ensemble: Option<Ensemble>,
    /// Folder of the results.
    pub(crate) folder: StudyFolder,
    /// This program with the study file.
    pub(crate) program: Program,
}

/// Loads study files and checks the cases of all their runs, so that nothing starts before all are valid.
pub(crate) fn open(paths: &[PathBuf], out: Option<&Path>) -> Result<Vec<Opened>, Failure> {
    let mut all: Vec<Opened> = Vec::new();
    for path in paths {
        let study = load(path).map_err(Failure::input)?;
        let ensemble = plan_ensemble(&study).map_err(Failure::input)?;
        let runs = if ensemble.is_none() { plan(&study).map_err(Failure::input)? } else { Vec::new() };
        let folder = match out {
            Some(out) if paths.len() > 1 => StudyFolder::new(&out.join(StudyFolder::name_of(&study))),
            _ => StudyFolder::of(&study, out),
        };
        if let Some(other) = all.iter().find(|other| other.folder.root() == folder.root()) {
            let (name, root) = (&other.study.name, folder.root().display());
            let message = format!("two studies named {name} would both write to {root}; name them one at a time");
            return Err(Failure::new(USAGE, &message));
        }
        all.push(Opened { study, runs, ensemble, folder, program: program(path)? });
    }
    Ok(all)
}

/// Processes studies one by one. A failure does not prevent the next study, an interruption does; the exit code is that of the most severe one.
pub(crate) fn each(all: &[Opened], mut one: impl FnMut(&Opened) -> Result<u8, Failure>) -> Result<u8, Failure> {
    let mut gravest = DONE;
    for opened in all {
        match one(opened)? {
            INTERRUPTED => return Ok(INTERRUPTED),
            SOLVER_FAILED => gravest = SOLVER_FAILED,
            EXPECTATION_FAILED if gravest == DONE => gravest = EXPECTATION_FAILED,
            _ => {}
        }
    }
    Ok(gravest)
}

fn program(study: &Path) -> Result<Program, Failure> {
    let path = std::env::current_exe().map_err(Failure::with(BUG))?;
    Ok(Program { path, study: study.to_path_buf() })
}

/// Threads and concurrent runs, within the cores of this machine.
pub(crate) fn cores(arguments: &CoresArguments) -> Cores {
    let threads = within_cores("--threads", usize::from(arguments.threads));
    let jobs = arguments.jobs.map(|jobs| within_cores("--jobs", usize::from(jobs)));
    Cores { threads, jobs: jobs.unwrap_or_else(|| (threads::cores() / threads).max(1)) }
}

/// Writes and prints the report; the exit code is the status of the study.
pub(crate) fn finish(opened: &Opened) -> Result<u8, Failure> {
    let written = report(&opened.study, &opened.runs, &opened.folder).map_err(Failure::with(USAGE))?;
    Ok(print_report(opened, &written))
}

/// Prints a report; the exit code is the status of the study.
pub(crate) fn print_report(opened: &Opened, written: &StudyReport) -> u8 {
    say(&opened.study.title);
    say(written.table.markdown().trim_end());
    print_judgments(written);
    for convergence in &written.convergences {
        let order = convergence.order_text();
        let (measure, along, of) = (&convergence.measure, &convergence.along, &convergence.of);
        say(format_args!("  order       {order} of {measure} along {along}, {of}"));
    }
    if written.moving > 0 {
        say(format_args!(
            "  not at rest {} of {} runs, marked in the table, hollow in curves",
            written.moving,
            written.results.len()
        ));
    }
    for note in &written.unknown {
        say(format_args!("  note        {note}"));
    }
    say(format_args!("  page        {}", written.page.display()));
    say(format_args!("  table       {}", written.csv.display()));
    let failed: Vec<&RunResult> =
        written.results.iter().filter(|result| matches!(result.state, RunState::Failed(_))).collect();
    for result in failed.iter().take(MOST_FAILURES) {
        if let RunState::Failed(report) = &result.state {
            let why = report.error.as_deref().unwrap_or("the solver failed");
            say(format_args!("  FAILED      run {} ({}): {why}", result.run.index, result.run.name));
        }
    }
    if failed.len() > MOST_FAILURES {
        say(format_args!("  FAILED      {} more runs", failed.len() - MOST_FAILURES));
    }
    let missed = written.judgments.iter().any(|judgment| judgment.verdict == Verdict::Missed);
    match (failed.is_empty(), missed) {
        (false, _) => SOLVER_FAILED,
        (true, true) => EXPECTATION_FAILED,
        (true, false) => DONE,
    }
}

fn print_judgments(written: &StudyReport) {
    let count = |verdict| written.judgments.iter().filter(|judgment| judgment.verdict == verdict).count();
    if written.judgments.is_empty() {
        return;
    }
    for judgment in written.judgments.iter().filter(|judgment| judgment.verdict == Verdict::Missed) {
        let (of, measure) = (&judgment.of, &judgment.measure);
        say(format_args!("  MISSED      {of}, {measure}: {}, found {}", judgment.expected, judgment.found));
    }
    let (met, missed, open) = (count(Verdict::Met), count(Verdict::Missed), count(Verdict::Open));
    say(format_args!("  expected    {met} met, {missed} missed, {open} open"));
}
