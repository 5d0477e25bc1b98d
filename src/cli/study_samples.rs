//! `meniscus study` for samples run within this process.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};

use super::exit::{DONE, Failure, INTERRUPTED, USAGE};
use super::interrupt;
use super::opened_study::{Opened, cores, print_report};
use super::output::{say, tell};
use super::study_arguments::{CoresArguments, Engine as EngineKind, StudyRunArguments};
use super::threads::pool;
use crate::study::definition::Study;
use crate::study::ensemble::bands::write;
use crate::study::ensemble::engine::{Engine, EnsembleError};
use crate::study::ensemble::plan::Ensemble;
use crate::study::report::report_of;
use crate::study::table::Table;
use crate::study::values::{number_of, shown};

/// Runs the missing samples, and writes the report.
pub(crate) fn run(arguments: &StudyRunArguments, opened: &Opened, ensemble: &Ensemble) -> Result<u8, Failure> {
    if arguments.execution.engine == EngineKind::Slurm {
        let message = "samples of networks run within one process; for a job array set processes = true in [sampling]";
        return Err(Failure::new(USAGE, message));
    }
    let flag = interrupt::flag();
    tell(format_args!("{} -> {}", opened.study.title, opened.folder.root().display()));
    work(&arguments.cores, opened, ensemble, Some(&flag))
}

/// Writes the report of the finished samples.
pub(crate) fn report(opened: &Opened, ensemble: &Ensemble) -> Result<u8, Failure> {
    let cores = CoresArguments { threads: NonZeroUsize::MIN, jobs: None };
    work(&cores, opened, ensemble, None)
}

fn work(
    arguments: &CoresArguments,
    opened: &Opened,
    ensemble: &Ensemble,
    run: Option<&AtomicBool>,
) -> Result<u8, Failure> {
    let cores = cores(arguments);
    let Opened { study, folder, .. } = opened;
    let of_samples = |error: EnsembleError| Failure::new(USAGE, &error);
    pool(NonZeroUsize::new(cores.threads * cores.jobs))?.install(|| {
        let mut engine = Engine::new(study, ensemble, folder);
        let all = ensemble.samples.len();
        let maps = engine.maps().map_err(of_samples)?;
        if let Some(flag) = run {
            tell(format_args!("{all} samples, {} to do", all - engine.count()));
            let mut teller = |done: usize| tell(format_args!("{done} of {all} samples done"));
            engine.run(&maps, folder, flag, &mut teller).map_err(of_samples)?;
        }
        let figures = write(&engine, &maps, folder.root()).map_err(Failure::with(USAGE))?;
        let written = report_of(study, engine.results(), folder, &figures);
        let written = written.map_err(Failure::with(USAGE))?;
        if run.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            tell(format_args!("interrupted after {} of {all} samples; the same command continues", engine.count()));
            return Ok(INTERRUPTED);
        }
        Ok(print_report(opened, &written))
    })
}

/// Prints what is sampled and how many samples are done.
pub(crate) fn plan(opened: &Opened, ensemble: &Ensemble) -> u8 {
    let engine = Engine::new(&opened.study, ensemble, &opened.folder);
    say(&opened.study.title);
    for one in &opened.study.set {
        say(format_args!("  all runs    {}", one.text));
    }
    say(inputs(&opened.study).markdown().trim_end());
    let (all, done) = (ensemble.samples.len(), engine.count());
    say(format_args!("{all} samples, {} to do, within one process", all - done));
    DONE
}

/// The parameters with their smallest and largest values.
fn inputs(study: &Study) -> Table {
    let heads = ["parameter", "values", "from", "to"].map(str::to_owned).to_vec();
    let row = |column: &crate::study::definition::Column| {
        let mut numbers: Vec<f64> = column.values.iter().filter_map(number_of).collect();
        numbers.sort_by(f64::total_cmp);
        let end = |number: Option<&f64>| number.map_or("–".to_owned(), |number| shown(&(*number).into()));
        vec![column.name.clone(), column.values.len().to_string(), end(numbers.first()), end(numbers.last())]
    };
    Table { heads, rows: study.parameters().map(row).collect() }
}
