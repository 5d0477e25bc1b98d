//! One run of a study by its number, in this process: for a job of a cluster, a worker and the Python package.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::engine::End;
use super::execute::{self, ExecuteError};
use super::folder::{Claim, Share, StudyFolder};
use super::load::load;
use super::run::PlannedRun;
use super::runs::runs;
use crate::run::simulation::Watcher;
use meniscus_core::input::InputError;

/// A run with its checked case and the folder of its study.
#[derive(Debug)]
pub struct Numbered {
    planned: PlannedRun,
    folder: StudyFolder,
}

/// Why a run cannot be done.
#[derive(Debug, thiserror::Error)]
pub enum NumberedError {
    /// Mistakes of the study or of a case.
    #[error(transparent)]
    Input(#[from] InputError),
    /// There is no run with this number.
    #[error("the study has {count} runs, there is no run {index}")]
    Absent {
        /// Number of runs.
        count: usize,
        /// The requested number.
        index: usize,
    },
    /// The case of the run is not the requested one.
    #[error("the study or a case was changed while the study ran: run {0} is now a different one")]
    Changed(usize),
}

impl Numbered {
    /// The run with number `index`, from 1, of the study file at `path`; its case must have `digest`, if given. `out` is the folder of the study.
    ///
    /// # Errors
    /// [`NumberedError`].
    pub fn open(path: &Path, out: Option<&Path>, index: usize, digest: Option<&str>) -> Result<Self, NumberedError> {
        let study = load(path)?;
        let all = runs(&study);
        let absent = NumberedError::Absent { count: all.len(), index };
        let run = index.checked_sub(1).and_then(|position| all.get(position)).ok_or(absent)?;
        let planned = run.plan(&study)?;
        if digest.is_some_and(|digest| digest != planned.digest()) {
            return Err(NumberedError::Changed(index));
        }
        Ok(Self { planned, folder: StudyFolder::of(&study, out) })
    }

    /// Name of the run.
    pub fn name(&self) -> &str {
        &self.planned.run.name
    }

    /// Its folder.
    pub fn folder(&self) -> PathBuf {
        self.folder.run(self.name())
    }

    /// Acquires shared access to the study, for processes that do one run each.
    ///
    /// # Errors
    /// The folder cannot be used, or a process that does all runs has it.
    pub fn claim(&self) -> Result<Claim, ExecuteError> {
        Ok(self.folder.claim(Share::Together)?)
    }

    /// Does the run. A saved state of the same case is resumed.
    ///
    /// # Errors
    /// [`ExecuteError`]; a failing solver is not an error here.
    pub fn run(&self, interrupt: &AtomicBool, watcher: &mut dyn Watcher) -> Result<End, ExecuteError> {
        execute::run(&self.planned, &self.folder, interrupt, watcher)
    }
}
