//! One run of a study: started, resumed, or left alone if it is complete.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::comparison::{self, PlannedNetwork};
use super::engine::End;
use super::folder::{FolderError, StudyFolder};
use super::results::{is_complete, run_state};
use super::run::PlannedRun;
use crate::run::compare::{self, DIRECT_RUN, Task};
use crate::run::execute::{Job, Mode, RunError, execute};
use crate::run::folder_error::FolderError as RunFolderError;
use crate::run::report::{REPORT, Report, Status};
use crate::run::setup::{self, SetupError};
use crate::run::simulation::Watcher;
use meniscus_core::input::InputError;
use meniscus_output::{FileError, restart};

/// Why a run cannot be done.
#[derive(Debug, thiserror::Error)]
pub enum ExecuteError {
    /// The study folder.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// No solver, with the locations in the case file.
    #[error(transparent)]
    Setup(#[from] InputError),
    /// The run.
    #[error(transparent)]
    Run(#[from] RunError),
}

/// Does a run. A saved state of the same case is resumed; the files of another case are removed.
///
/// # Errors
/// [`ExecuteError`]; a failing solver is not an error here.
pub(crate) fn run(
    planned: &PlannedRun,
    folder: &StudyFolder,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<End, ExecuteError> {
    let Some(_claim) = folder.claim_run(&planned.run.name, interrupt)? else { return Ok(End::Interrupted) };
    let path = folder.run(&planned.run.name);
    if is_complete(&path, planned) {
        return Ok(End::WasComplete);
    }
    if run_state(&path, &planned.resolved).report().is_none() {
        let report = path.join(REPORT);
        gone(&report, std::fs::remove_file(&report))?;
    }
    if saved_state(&path, planned).exists() {
        match attempt(planned, &path, Mode::Resume, interrupt, watcher) {
            Err(ExecuteError::Run(RunError::Folder(error @ RunFolderError::InUse { .. }))) => {
                return Err(ExecuteError::Run(RunError::Folder(error)));
            }
            // A state of another case or version of the program, or a damaged one: the run starts anew.
            Err(ExecuteError::Run(RunError::State(_) | RunError::Folder(_))) => {}
            other => return other,
        }
    }
    gone(&path, std::fs::remove_dir_all(&path))?;
    attempt(planned, &path, Mode::New, interrupt, watcher)
}

fn attempt(
    planned: &PlannedRun,
    path: &Path,
    mode: Mode,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<End, ExecuteError> {
    if let Some(network) = &planned.network {
        return compared(planned, network, path, mode, interrupt, watcher);
    }
    let built = match mode {
        Mode::New => setup::build(&planned.case),
        Mode::Resume => setup::build_to_resume(&planned.case),
    };
    let mut solver = built.map_err(|error| refused(planned, &error))?;
    let job = Job { case: &planned.case, resolved: &planned.resolved, folder: path.to_path_buf(), mode };
    let finished = execute(&job, solver.as_mut(), interrupt, watcher)?;
    Ok(ending(&finished.report))
}

/// The saved state of a run; that of a comparison is that of its direct simulation.
fn saved_state(path: &Path, planned: &PlannedRun) -> PathBuf {
    match planned.network {
        Some(_) => restart::path(&path.join(DIRECT_RUN)),
        None => restart::path(path),
    }
}

/// Compares the case of a run with a network.
fn compared(
    planned: &PlannedRun,
    network: &PlannedNetwork,
    folder: &Path,
    mode: Mode,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<End, ExecuteError> {
    let task = Task { pair: network.with(&planned.case), resolved: &network.of_direct, folder, mode };
    match compare::execute(&task, &planned.resolved, interrupt, watcher) {
        Ok(report) => Ok(ending(&report)),
        Err(compare::ExecuteError::Run(error)) => Err(error.into()),
        Err(compare::ExecuteError::Cases(error)) => {
            let placed = comparison::refuse(&error, &network.document, &planned.document).err();
            Err(placed.unwrap_or(InputError { mistakes: Vec::new() }).into())
        }
    }
}

/// Why no solver can be made for a case, with the locations in its file.
fn refused(planned: &PlannedRun, error: &SetupError) -> ExecuteError {
    planned.document.refuse(error.problems()).err().unwrap_or(InputError { mistakes: Vec::new() }).into()
}

fn ending(report: &Report) -> End {
    match report.status {
        Status::Done | Status::ExpectationFailed => End::Complete,
        Status::Interrupted => End::Interrupted,
        Status::Failed => End::Failed(report.error.clone().unwrap_or_else(|| "the solver failed".to_owned())),
    }
}

/// The result of a removal; the file or folder may not exist.
fn gone(path: &Path, removed: std::io::Result<()>) -> Result<(), FolderError> {
    match removed {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(FileError::write(path)(error).into()),
        _ => Ok(()),
    }
}
