//! `meniscus study plan` and `report`.

use std::sync::atomic::AtomicBool;

use super::exit::{DONE, Failure, USAGE};
use super::opened_study::{Opened, cores, each, finish, open};
use super::output::{duration, readable, say};
use super::study_arguments::{StudyCommand, StudyFiles, StudyPlanArguments};
use super::{study_run, study_samples};
use crate::run::trial::Trial;
use crate::study::definition::{Study, Target};
use crate::study::engine::memory_of;
use crate::study::estimate::{Cores, Estimate, estimates};
use crate::study::results::{RunResult, results};
use crate::study::table::Table;
use crate::study::values::shown;

/// Bytes of a mebibyte.
const BYTES_PER_MEBIBYTE: f64 = 1_048_576.0;

/// Executes the command.
pub(crate) fn study(command: &StudyCommand) -> Result<u8, Failure> {
    match command {
        StudyCommand::Plan(arguments) => print_plans(arguments),
        StudyCommand::Run(arguments) => study_run::run(arguments),
        StudyCommand::Report(arguments) => write_report(arguments),
    }
}

fn print_plans(arguments: &StudyPlanArguments) -> Result<u8, Failure> {
    let cores = cores(&arguments.cores);
    each(&open(&arguments.files.studies, arguments.files.out.as_deref())?, |opened| print_plan(opened, cores))
}

fn print_plan(opened: &Opened, cores: Cores) -> Result<u8, Failure> {
    if let Some(ensemble) = &opened.ensemble {
        return Ok(study_samples::plan(opened, ensemble));
    }
    let never = AtomicBool::new(false);
    let kept = opened.folder.estimates();
    let found = estimates(&opened.runs, &opened.program, cores, &kept, false, &never);
    let results = results(&opened.runs, &opened.folder);
    say(&opened.study.title);
    if let Some(compare) = &opened.study.compare {
        say(format_args!("  network     {}, {} records", compare.network.display(), compare.records));
    }
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

/// The runs with their estimated cost.
fn plan_table(study: &Study, results: &[RunResult], estimates: &[Estimate]) -> Table {
    let mut heads = vec!["run".to_owned()];
    // Numbers given only for comparison change nothing in a run.
    let changes: Vec<bool> = study.parameters().map(|column| column.target != Target::Nothing).collect();
    heads.extend(study.parameters().zip(&changes).filter(|(_, changes)| **changes).map(|(c, _)| c.name.clone()));
    heads.extend(["unknowns", "steps", "memory", "duration", "state"].map(str::to_owned));
    let row = |(result, estimate): (&RunResult, &Estimate)| {
        let mut row = vec![result.run.index.to_string()];
        let parameters = result.run.parameters.iter().zip(&changes).filter(|(_, changes)| **changes);
        row.extend(parameters.map(|(parameter, _)| shown(&parameter.value)));
        let cell = |tell: &dyn Fn(&Trial) -> String| estimate.as_ref().map_or("?".to_owned(), tell);
        row.push(cell(&|trial| trial.unknowns.to_string()));
        row.push(cell(&|trial| readable(trial.steps)));
        let mebibytes = memory_of(Some(estimate)) as f64 / BYTES_PER_MEBIBYTE;
        row.push(cell(&|_| format!("{mebibytes:.0} MiB")));
        let bound = |trial: &Trial| if trial.is_upper_bound { "less than " } else { "" };
        row.push(cell(&|trial| format!("{}{}", bound(trial), duration(trial.duration_s))));
        row.push(result.state.word().to_owned());
        row
    };
    Table { heads, rows: results.iter().zip(estimates).map(row).collect() }
}

/// The remaining work, with the given cores.
fn totals(results: &[RunResult], estimates: &[Estimate], cores: Cores) -> String {
    let open = || results.iter().zip(estimates).filter(|(result, _)| result.state.report().is_none());
    let seconds: Vec<f64> =
        open().filter_map(|(_, estimate)| estimate.as_ref().ok()).map(|trial| trial.duration_s).collect();
    // An empty sum is minus zero.
    let total = seconds.iter().sum::<f64>() + 0.0;
    // Concurrent runs: the number of jobs; the wall time is at least that of the longest run.
    let wall = (total / cores.jobs as f64).max(seconds.iter().copied().fold(0.0, f64::max)) + 0.0;
    let mut memory: Vec<u64> = open().map(|(_, estimate)| memory_of(Some(estimate))).collect();
    memory.sort_unstable_by(|a, b| b.cmp(a));
    let memory = memory.iter().take(cores.jobs).sum::<u64>() as f64 / BYTES_PER_MEBIBYTE;
    let is_bound = open().any(|(_, estimate)| estimate.as_ref().is_ok_and(|trial| trial.is_upper_bound));
    let [less_than, about] = if is_bound { ["less than ", "less than"] } else { ["", "about"] };
    format!(
        "{} runs, {} to do: {less_than}{} of work, {about} {} with {} at once on {} thread{} each, up to {memory:.0} MiB",
        results.len(),
        open().count(),
        duration(total),
        duration(wall),
        cores.jobs,
        cores.threads,
        if cores.threads == 1 { "" } else { "s" }
    )
}

fn write_report(files: &StudyFiles) -> Result<u8, Failure> {
    each(&open(&files.studies, files.out.as_deref())?, |opened| {
        if !opened.folder.root().exists() {
            let folder = opened.folder.root().display();
            let message =
                format!("there is no study in {folder}; start it with `meniscus study run`, or name --out DIR");
            return Err(Failure::new(USAGE, &message));
        }
        match &opened.ensemble {
            Some(ensemble) => study_samples::report(opened, ensemble),
            None => finish(opened),
        }
    })
}
