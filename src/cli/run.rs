//! `meniscus run`.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::Args;

use super::exit::{BUG, DONE, EXPECTATION_FAILED, Failure, INTERRUPTED, SOLVER_FAILED, USAGE};
use super::output::{say, tell};
use super::progress::ProgressDisplay;
use super::summary::summary;
use super::threads::pool;
use super::{interrupt, source};
use crate::run::execute::{Finished, Job, Mode, RunError, execute};
use crate::run::report::Status;
use crate::run::source::Source;
use crate::run::{folder, setup};
use meniscus_case::Case;
use meniscus_core::solver::{Series, Solver};

/// `run`.
#[derive(Debug, Default, Args)]
pub(crate) struct RunArguments {
    /// Case file; the built-in case if not given
    pub(crate) case: Option<PathBuf>,
    /// Output folder, new or empty; if not given: out/NAME, NAME being that of the case file, or if an earlier run is in it out/NAME-2, out/NAME-3, ...
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Change a value of the case, as in --set sph.wetting.young.contact-angle-deg=60
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) overrides: Vec<String>,
    /// Number of threads; all cores if not given. The results do not depend on it
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
    /// Continue the run in the output folder; without --out in the last one of out/NAME, out/NAME-2, ...
    #[arg(long)]
    pub(crate) resume: bool,
}

/// Runs a case; returns the exit code.
pub(crate) fn run(arguments: &RunArguments) -> Result<u8, Failure> {
    let source = source::load_case(arguments.case.as_deref(), &arguments.overrides)?;
    let mode = if arguments.resume { Mode::Resume } else { Mode::New };
    let folder = new_folder(arguments.out.as_deref(), &source.name, mode);
    finish(&source, folder, mode, arguments.threads)
}

/// The output folder: the given one, or one named after the case.
pub(super) fn new_folder(given: Option<&Path>, name: &str, mode: Mode) -> PathBuf {
    given.map_or_else(
        || {
            let base = Path::new("out").join(name);
            if mode == Mode::Resume { folder::last_used(&base) } else { folder::next_free(&base) }
        },
        Path::to_path_buf,
    )
}

/// Runs a loaded case to its end and prints the results.
pub(super) fn finish(
    source: &Source,
    folder: PathBuf,
    mode: Mode,
    threads: Option<NonZeroUsize>,
) -> Result<u8, Failure> {
    let job = Job { case: &source.case, resolved: &source.resolved, folder, mode };
    let finished = pool(threads)?.install(|| -> Result<Finished, Failure> {
        let mut solver = built(source, mode)?;
        tell(format_args!("{} -> {}", job.case.title, job.folder.display()));
        if mode == Mode::New {
            print_warnings(&source.case, solver.as_ref());
        }
        let flag = interrupt::flag();
        let mut display = ProgressDisplay::new();
        let finished = execute(&job, solver.as_mut(), &flag, &mut display);
        display.finish();
        finished.map_err(|error| failure(&error))
    })?;
    if finished.was_at_end {
        tell(format_args!("the run in {} is already at its end; nothing was left to do", finished.folder.display()));
    }
    say(summary(&finished).trim_end());
    ending(&finished)
}

/// The solver of a case; the progress of a long packing of particles is shown, and a resumed run skips the packing.
pub(super) fn built(source: &Source, mode: Mode) -> Result<Box<dyn Solver>, Failure> {
    let mut display = ProgressDisplay::new();
    let solver = match mode {
        Mode::New => setup::build_watched(&source.case, &mut |fraction| display.packed(fraction)),
        Mode::Resume => setup::build_to_resume(&source.case),
    };
    display.finish();
    solver.map_err(|error| source.refused(&error).into())
}

/// Prints warnings that a reader should have before a long run rather than after it.
fn print_warnings(case: &Case, solver: &dyn Solver) {
    for warning in setup::warnings(case, solver, &Series::default()) {
        tell(format_args!("  WARNING     {warning}"));
    }
}

pub(super) fn failure(error: &RunError) -> Failure {
    let code = match error {
        RunError::Folder(_) | RunError::File(_) | RunError::State(_) => USAGE,
        RunError::Case(_) => BUG,
    };
    Failure::new(code, error)
}

pub(super) fn ending(finished: &Finished) -> Result<u8, Failure> {
    match finished.report.status {
        Status::Done => Ok(DONE),
        Status::Interrupted => Ok(INTERRUPTED),
        Status::ExpectationFailed => Ok(EXPECTATION_FAILED),
        Status::Failed => {
            Err(Failure::new(SOLVER_FAILED, finished.report.error.as_deref().unwrap_or("the solver failed")))
        }
    }
}
