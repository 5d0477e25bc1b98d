//! `meniscus study run`: all runs on this machine or on a cluster, or one of them in this process.

use std::io::Read;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::exit::{BAD_INPUT, DONE, Failure, INTERRUPTED, SOLVER_FAILED, USAGE};
use super::interrupt;
use super::opened_study::{Opened, cores, each, finish, open};
use super::output::{duration, say, tell};
use super::progress::ProgressDisplay;
use super::study_arguments::{Engine, StudyRunArguments};
use super::study_samples;
use super::threads::pool;
use crate::study::engine::{End, Event, Work, free_memory, work};
use crate::study::estimate::estimates;
use crate::study::execute::ExecuteError;
use crate::study::folder::Share;
use crate::study::numbered::{Numbered, NumberedError};
use crate::study::run::PlannedRun;
use crate::study::slurm::{Array, submit};

/// Bytes of a mebibyte.
const BYTES_PER_MEBIBYTE: u64 = 1 << 20;

/// Does the runs; the exit code is the status of the studies.
pub(crate) fn run(arguments: &StudyRunArguments) -> Result<u8, Failure> {
    if let Some(index) = arguments.index {
        let [study] = arguments.files.studies.as_slice() else {
            return Err(Failure::new(USAGE, "--index is the number of a run of one study; name that study alone"));
        };
        return one(arguments, study, index.get());
    }
    each(&open(&arguments.files.studies, arguments.files.out.as_deref())?, |opened| {
        let _claim = opened.folder.claim(Share::Alone).map_err(Failure::with(USAGE))?;
        if let Some(ensemble) = &opened.ensemble {
            return study_samples::run(arguments, opened, ensemble);
        }
        match arguments.execution.engine {
            Engine::Local => here(arguments, opened),
            Engine::Slurm => cluster(arguments, opened),
        }
    })
}

/// All runs on this machine.
fn here(arguments: &StudyRunArguments, opened: &Opened) -> Result<u8, Failure> {
    let cores = cores(&arguments.cores);
    let flag = interrupt::flag();
    tell(format_args!("{} -> {}", opened.study.title, opened.folder.root().display()));
    let kept = opened.folder.estimates();
    let estimates = estimates(&opened.runs, &opened.program, cores, &kept, true, &flag);
    let memory = arguments.memory.map(|mebibytes| mebibytes.saturating_mul(BYTES_PER_MEBIBYTE)).or_else(free_memory);
    let Opened { runs, folder, program, .. } = opened;
    let job = Work { runs, estimates: &estimates, folder, program, cores, memory, interrupt: &flag };
    let mut printer = ProgressPrinter { count: runs.len(), ended: 0 };
    let ends = work(&job, &mut |event| printer.tell(event)).map_err(Failure::with(USAGE))?;
    if flag.load(Ordering::Relaxed) {
        tell("interrupted; the same command continues");
        return Ok(INTERRUPTED);
    }
    let code = finish(opened)?;
    // A process that died left no report.
    let failed = ends.iter().filter(|end| matches!(end, End::Failed(_))).count();
    if failed > 0 {
        tell(format_args!("{failed} of {} runs failed; the same command tries them again", runs.len()));
        return Ok(SOLVER_FAILED);
    }
    Ok(if ends.contains(&End::Interrupted) { INTERRUPTED } else { code })
}

/// Prints the progress of the study.
struct ProgressPrinter {
    count: usize,
    ended: usize,
}

impl ProgressPrinter {
    fn tell(&mut self, event: &Event<'_>) {
        match event {
            Event::Started(run) => tell(format_args!("run {} of {}, {}: begun", run.index, self.count, run.name)),
            Event::Ended(run, end, time) => {
                self.ended += 1;
                let (ended, word) = (self.ended, word(end, *time));
                tell(format_args!("run {} of {}, {}: {word} ({ended} ended)", run.index, self.count, run.name));
            }
        }
    }
}

fn word(end: &End, time: Duration) -> String {
    match end {
        End::WasComplete => "was complete".to_owned(),
        End::Complete => format!("done in {}", duration(time.as_secs_f64())),
        End::Interrupted => "interrupted".to_owned(),
        End::Failed(why) => format!("FAILED: {why}"),
    }
}

/// The incomplete runs as a job array.
fn cluster(arguments: &StudyRunArguments, opened: &Opened) -> Result<u8, Failure> {
    let cores = cores(&arguments.cores);
    let kept = opened.folder.estimates();
    let never = AtomicBool::new(false);
    let results = crate::study::results::results(&opened.runs, &opened.folder);
    let open: Vec<&PlannedRun> = opened
        .runs
        .iter()
        .zip(&results)
        .filter(|(_, result)| result.state.report().is_none())
        .map(|(run, _)| run)
        .collect();
    if open.is_empty() {
        return finish(opened);
    }
    let owned: Vec<PlannedRun> = open.iter().map(|run| (*run).clone()).collect();
    let estimates = estimates(&owned, &opened.program, cores, &kept, true, &never);
    let array = Array {
        name: &opened.study.name,
        runs: &open,
        estimates: &estimates,
        folder: &opened.folder,
        program: &opened.program,
        threads: usize::from(arguments.cores.threads),
        jobs: arguments.cores.jobs.map(usize::from),
        options: &arguments.execution.sbatch,
    };
    let job = submit(&array).map_err(Failure::with(USAGE))?;
    say(format_args!("{} runs submitted as job array {job}", open.len()));
    say(
        "when they are done, `meniscus study report` writes the report, and the same command again submits what is left",
    );
    Ok(DONE)
}

/// One run in this process.
fn one(arguments: &StudyRunArguments, study: &Path, index: usize) -> Result<u8, Failure> {
    let out = arguments.files.out.as_deref();
    let run = Numbered::open(study, out, index, arguments.digest.as_deref()).map_err(|error| match error {
        NumberedError::Input(mistakes) => Failure::input(mistakes),
        NumberedError::Absent { .. } => Failure::new(USAGE, &error),
        NumberedError::Changed(_) => Failure::new(BAD_INPUT, &error),
    })?;
    let _claim = match arguments.worker {
        true => None,
        false => Some(run.claim().map_err(failure)?),
    };
    let flag = interrupt::flag();
    if arguments.worker {
        stop_with_parent(&flag);
    }
    let pool = pool(Some(arguments.cores.threads))?;
    tell(format_args!("run {index}: {} -> {}", run.name(), run.folder().display()));
    let mut display = ProgressDisplay::new();
    let ending = pool.install(|| run.run(&flag, &mut display));
    display.finish();
    match ending.map_err(failure)? {
        end @ (End::WasComplete | End::Complete) => {
            say(format_args!("run {index} {} complete", if end == End::Complete { "is" } else { "was" }));
            Ok(DONE)
        }
        End::Interrupted => Ok(INTERRUPTED),
        End::Failed(why) => Err(Failure::new(SOLVER_FAILED, &why)),
    }
}

fn failure(error: ExecuteError) -> Failure {
    match error {
        ExecuteError::Setup(mistakes) => Failure::input(mistakes),
        other => Failure::new(USAGE, &other),
    }
}

/// Sets the flag when the standard input closes: the parent process holds its other end.
fn stop_with_parent(flag: &Arc<AtomicBool>) {
    let flag = Arc::clone(flag);
    std::thread::spawn(move || {
        let mut rest = Vec::new();
        // However the read ends, the parent is gone.
        let _ = std::io::stdin().read_to_end(&mut rest);
        flag.store(true, Ordering::Relaxed);
    });
}
