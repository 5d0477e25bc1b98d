//! `meniscus study plan` and `report`, and what all study commands share.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::arguments::{CoresArguments, StudyCommand, StudyPlanArguments, StudyReportArguments};
use super::exit::{BUG, DONE, EXPECTATION_FAILED, Failure, INTERRUPTED, SOLVER_FAILED, USAGE};
use super::output::{duration, readable, say};
use super::study_run;
use crate::run::trial::Trial;
use crate::study::child::Program;
use crate::study::definition::{Study, Target};
use crate::study::engine::memory_of;
use crate::study::estimate::{Cores, Estimate, estimates};
use crate::study::folder::StudyFolder;
use crate::study::load::load;
use crate::study::report::{StudyReport, report};
use crate::study::results::{RunResult, Standing, results};
use crate::study::runs::{PlannedRun, plan, shown};
use crate::study::table::Table;
use crate::study::verdict::Verdict;

/// Bytes of a mebibyte.
const BYTES_PER_MEBIBYTE: f64 = 1_048_576.0;

/// Does what the command says.
pub fn study(command: &StudyCommand) -> Result<u8, Failure> {
    match command {
        StudyCommand::Plan(arguments) => tell_plan(arguments),
        StudyCommand::Run(arguments) => study_run::run(arguments),
        StudyCommand::Report(arguments) => write_report(arguments),
    }
}

/// A study with its checked runs and its folder.
pub struct Opened {
    /// The study.
    pub study: Study,
    /// Its runs.
    pub runs: Vec<PlannedRun>,
    /// Where the results go.
    pub folder: StudyFolder,
    /// This program with the study file.
    pub program: Program,
}

/// Loads study files and checks the cases of all their runs, so that nothing starts before all are right.
pub fn open(paths: &[PathBuf], out: Option<&Path>) -> Result<Vec<Opened>, Failure> {
    let mut all: Vec<Opened> = Vec::new();
    for path in paths {
        let study = load(path).map_err(Failure::input)?;
        let runs = plan(&study).map_err(Failure::input)?;
        let folder = match out {
            Some(out) if paths.len() > 1 => StudyFolder::new(&out.join(folder_name(&study))),
            _ => folder(&study, out),
        };
        if let Some(other) = all.iter().find(|other| other.folder.root() == folder.root()) {
            let (name, root) = (&other.study.name, folder.root().display());
            let message = format!("two studies of the name {name} would both write to {root}; name them one at a time");
            return Err(Failure::new(USAGE, &message));
        }
        all.push(Opened { study, runs, folder, program: program(path)? });
    }
    Ok(all)
}

fn folder_name(study: &Study) -> String {
    format!("study-{}", study.name)
}

/// The folder of a study: the one that was named, or `out/study-NAME`.
pub fn folder(study: &Study, out: Option<&Path>) -> StudyFolder {
    let named = out.map_or_else(|| Path::new("out").join(folder_name(study)), Path::to_path_buf);
    StudyFolder::new(&named)
}

/// Does something with one study after the other. One that failed does not keep the next from its turn, an interruption does; the exit code
/// is the gravest one.
pub fn each(all: &[Opened], mut one: impl FnMut(&Opened) -> Result<u8, Failure>) -> Result<u8, Failure> {
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
    let path = std::env::current_exe().map_err(|error| Failure::new(BUG, &error))?;
    Ok(Program { path, study: study.to_path_buf() })
}

/// Threads and runs at once, within the cores of this machine where nothing else was asked for.
pub fn cores(arguments: &CoresArguments) -> Cores {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = usize::from(arguments.threads);
    Cores { threads, jobs: arguments.jobs.map_or((all / threads).max(1), usize::from) }
}

fn tell_plan(arguments: &StudyPlanArguments) -> Result<u8, Failure> {
    let cores = cores(&arguments.cores);
    each(&open(&arguments.studies, arguments.out.as_deref())?, |opened| tell_one_plan(opened, cores))
}

fn tell_one_plan(opened: &Opened, cores: Cores) -> Result<u8, Failure> {
    let never = AtomicBool::new(false);
    let kept = opened.folder.estimates();
    let found = estimates(&opened.runs, &opened.program, cores, (&kept, false), &never);
    let results = results(&opened.runs, &opened.folder);
    say(&opened.study.title);
    for one in &opened.study.set {
        say(format_args!("  all runs    {}", one.text));
    }
    say(plan_table(&opened.study, &results, &found).markdown().trim_end());
    for (planned, estimate) in opened.runs.iter().zip(&found) {
        if let Err(error) = estimate {
            say(format_args!("  run {} ({}) cannot be estimated: {error}", planned.run.index, planned.run.name));
        }
    }
    say(totals(&results, &found, cores));
    Ok(DONE)
}

/// The JSON schema of a study file.
pub fn schema() -> String {
    format!("{:#}", crate::study::schema())
}

/// The runs with what they would take.
fn plan_table(study: &Study, results: &[RunResult], estimates: &[Estimate]) -> Table {
    let mut heads = vec!["run".to_owned()];
    // Numbers to compare with change nothing in a run.
    let changes: Vec<bool> = study.parameters().map(|column| column.target != Target::Nothing).collect();
    heads.extend(study.parameters().zip(&changes).filter(|(_, changes)| **changes).map(|(c, _)| c.name.clone()));
    heads.extend(["unknowns", "steps", "memory", "duration", "state"].map(str::to_owned));
    let row = |(result, estimate): (&RunResult, &Estimate)| {
        let mut row = vec![result.run.index.to_string()];
        let parameters = result.run.parameters.iter().zip(&changes).filter(|(_, changes)| **changes);
        row.extend(parameters.map(|(parameter, _)| shown(&parameter.value)));
        let told = |tell: &dyn Fn(&Trial) -> String| estimate.as_ref().map_or("?".to_owned(), tell);
        row.push(told(&|trial| trial.unknowns.to_string()));
        row.push(told(&|trial| readable(trial.steps)));
        let mebibytes = memory_of(Some(estimate)) as f64 / BYTES_PER_MEBIBYTE;
        row.push(told(&|_| format!("{mebibytes:.0} MiB")));
        row.push(told(&|trial| duration(trial.duration_s)));
        row.push(result.standing.word().to_owned());
        row
    };
    Table { heads, rows: results.iter().zip(estimates).map(row).collect() }
}

/// What is left to do, with the cores that are given to it.
fn totals(results: &[RunResult], estimates: &[Estimate], cores: Cores) -> String {
    let open = || results.iter().zip(estimates).filter(|(result, _)| result.standing.report().is_none());
    let seconds: Vec<f64> =
        open().filter_map(|(_, estimate)| estimate.as_ref().ok()).map(|trial| trial.duration_s).collect();
    // The sum of nothing is minus zero.
    let total = seconds.iter().sum::<f64>() + 0.0;
    // As many runs at once as there are jobs; none is shorter than the longest of them.
    let wall = (total / cores.jobs as f64).max(seconds.iter().copied().fold(0.0, f64::max)) + 0.0;
    let mut memory: Vec<u64> = open().map(|(_, estimate)| memory_of(Some(estimate))).collect();
    memory.sort_unstable_by(|a, b| b.cmp(a));
    let memory = memory.iter().take(cores.jobs).sum::<u64>() as f64 / BYTES_PER_MEBIBYTE;
    format!(
        "{} runs, {} to do: {} of work, about {} with {} at once on {} thread{} each, up to {memory:.0} MiB",
        results.len(),
        open().count(),
        duration(total),
        duration(wall),
        cores.jobs,
        cores.threads,
        if cores.threads == 1 { "" } else { "s" }
    )
}

fn write_report(arguments: &StudyReportArguments) -> Result<u8, Failure> {
    each(&open(&arguments.studies, arguments.out.as_deref())?, |opened| {
        if !opened.folder.root().exists() {
            let folder = opened.folder.root().display();
            let message =
                format!("there is no study in {folder}; start it with `meniscus study run`, or name --out DIR");
            return Err(Failure::new(USAGE, &message));
        }
        finish(opened)
    })
}

/// Writes the report, tells it, and says how the study stands by the exit code.
pub fn finish(opened: &Opened) -> Result<u8, Failure> {
    let written = report(&opened.study, &opened.runs, &opened.folder).map_err(|error| Failure::new(USAGE, &error))?;
    say(&opened.study.title);
    say(written.table.markdown().trim_end());
    tell_judgments(&written);
    for convergence in &written.convergences {
        let order = convergence.order().map_or("none".to_owned(), |order| format!("{order:.2}"));
        let (measure, along, of) = (&convergence.measure, &convergence.along, &convergence.of);
        say(format_args!("  order       {order} of {measure} along {along}, {of}"));
    }
    for note in &written.unknown {
        say(format_args!("  note        {note}"));
    }
    say(format_args!("  page        {}", written.page.display()));
    say(format_args!("  table       {}", opened.folder.root().join("table.csv").display()));
    let failed: Vec<&RunResult> =
        written.results.iter().filter(|result| matches!(result.standing, Standing::Failed(_))).collect();
    for result in &failed {
        if let Standing::Failed(report) = &result.standing {
            let why = report.error.as_deref().unwrap_or("the solver failed");
            say(format_args!("  FAILED      run {} ({}): {why}", result.run.index, result.run.name));
        }
    }
    let missed = written.judgments.iter().any(|judgment| judgment.verdict == Verdict::Missed);
    Ok(match (failed.is_empty(), missed) {
        (false, _) => SOLVER_FAILED,
        (true, true) => EXPECTATION_FAILED,
        (true, false) => DONE,
    })
}

fn tell_judgments(written: &StudyReport) {
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
