//! The folder of a study: its layout, and access to it.
//!
//! `study.lock` marks a folder as that of a study. A process that does all runs has it exclusively, processes that do one run each share it; each run has its
//! own lock. The locks are those of the operating system, which releases them when a process ends, however it ends: none is ever left over.

use std::fs::{self, File, TryLockError};
use std::io::{Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::definition::Study;
use crate::run::claim::{holder, open};
use meniscus_output::{FileError, atomic};

/// Name of the lock.
const LOCK: &str = "study.lock";

/// Polling interval of a lock held by another process.
const POLLING_INTERVAL: Duration = Duration::from_millis(50);

/// Why a study folder cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// There are other files in it.
    #[error("the folder {} is not empty and contains no study; choose another one with --out DIR", .0.display())]
    Foreign(PathBuf),
    /// Another process works in it.
    #[error("the study in {} is being worked on by another process{by}; wait for it, or stop it", folder.display())]
    InUse {
        /// The folder.
        folder: PathBuf,
        /// Who, if known.
        by: String,
    },
    /// It cannot be locked.
    #[error("cannot lock {}: {source}; choose a folder on another disk with --out DIR", path.display())]
    Lock {
        /// The lock.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// It cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
}

/// The folder of a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct StudyFolder {
    root: PathBuf,
}

/// Exclusive or shared access to a folder or a run; it ends when this is dropped.
#[derive(Debug)]
pub struct Claim {
    _lock: File,
}

/// Mode of a lock.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Share {
    /// Exclusive.
    Alone,
    /// Shared.
    Together,
}

impl StudyFolder {
    /// The folder at a path; nothing is read or created.
    pub(crate) fn new(root: &Path) -> Self {
        Self { root: root.to_path_buf() }
    }

    /// The folder of a study: the given one, or `out/study-NAME`.
    pub(crate) fn of(study: &Study, out: Option<&Path>) -> Self {
        Self { root: out.map_or_else(|| Path::new("out").join(Self::name_of(study)), Path::to_path_buf) }
    }

    /// Name of the folder of a study.
    pub(crate) fn name_of(study: &Study) -> String {
        format!("study-{}", study.name)
    }

    /// The folder itself.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// The folder of a run.
    pub(crate) fn run(&self, name: &str) -> PathBuf {
        self.root.join("runs").join(name)
    }

    /// The log of a run.
    pub(crate) fn log(&self, name: &str) -> PathBuf {
        self.root.join("logs").join(format!("{name}.log"))
    }

    /// The estimated cost of runs.
    pub(crate) fn estimates(&self) -> PathBuf {
        self.root.join("estimates.json")
    }

    /// Creates the folder if it is missing, and acquires access to it.
    pub(crate) fn claim(&self, share: Share) -> Result<Claim, FolderError> {
        let path = self.root.join(LOCK);
        if !path.exists() {
            atomic::make_folder(&self.root)?;
            let mut entries = fs::read_dir(&self.root).map_err(FileError::read(&self.root))?;
            // Another process may have created the lock just now.
            if entries.next().is_some() && !path.exists() {
                return Err(FolderError::Foreign(self.root.clone()));
            }
        }
        let mut file = open(&path)?;
        if !try_lock(&file, share, &path)? {
            return Err(FolderError::InUse { folder: self.root.clone(), by: holder(&mut file) });
        }
        if share == Share::Alone {
            // For the message of others only.
            let _ = file.set_len(0).and_then(|()| file.rewind());
            let _ = writeln!(file, "process {}", std::process::id());
        }
        Ok(Claim { _lock: file })
    }

    /// Acquires access to a run; waits while another process has it, `None` if interrupted meanwhile.
    pub(crate) fn claim_run(&self, name: &str, interrupt: &AtomicBool) -> Result<Option<Claim>, FolderError> {
        let path = self.root.join("locks").join(name);
        atomic::make_folder(&self.root.join("locks"))?;
        let file = open(&path)?;
        while !try_lock(&file, Share::Alone, &path)? {
            if interrupt.load(Ordering::Relaxed) {
                return Ok(None);
            }
            std::thread::sleep(POLLING_INTERVAL);
        }
        Ok(Some(Claim { _lock: file }))
    }
}

fn try_lock(file: &File, share: Share, path: &Path) -> Result<bool, FolderError> {
    let locked = match share {
        Share::Alone => file.try_lock(),
        Share::Together => file.try_lock_shared(),
    };
    match locked {
        Ok(()) => Ok(true),
        Err(TryLockError::WouldBlock) => Ok(false),
        Err(TryLockError::Error(source)) => Err(FolderError::Lock { path: path.to_path_buf(), source }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_worked_in_by_one_process_or_by_many_that_share_it() {
        let root = tempfile::tempdir().unwrap();
        let folder = StudyFolder::new(&root.path().join("out"));
        let alone = folder.claim(Share::Alone).unwrap();
        let message = folder.claim(Share::Together).unwrap_err().to_string();
        assert!(message.contains(&format!("(process {})", std::process::id())), "{message}");
        drop(alone);
        let together = [folder.claim(Share::Together).unwrap(), folder.claim(Share::Together).unwrap()];
        assert!(matches!(folder.claim(Share::Alone), Err(FolderError::InUse { .. })));
        drop(together);
        folder.claim(Share::Alone).unwrap();
    }

    #[test]
    fn a_run_that_another_process_does_is_waited_for_until_an_interrupt() {
        let root = tempfile::tempdir().unwrap();
        let folder = StudyFolder::new(root.path());
        let held = folder.claim_run("a", &AtomicBool::new(false)).unwrap();
        assert!(held.is_some() && folder.claim_run("a", &AtomicBool::new(true)).unwrap().is_none());
        assert!(folder.claim_run("b", &AtomicBool::new(true)).unwrap().is_some());
    }
}
