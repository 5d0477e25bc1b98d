//! Exclusive access to the folder of a run: one process at a time.
//!
//! `restart/run.lock` is locked by the operating system, which releases the lock when a process ends, however it ends: no lock is ever left over. The content
//! of the file names the holder, for messages only.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};

use super::folder_error::FolderError;
use meniscus_output::{FileError, atomic};

/// Exclusive access to a folder; it ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Claim(File);

impl Drop for Claim {
    fn drop(&mut self) {
        // The folder is released; the content of the file is informative only, so an error does not matter.
        let _ = self.0.set_len(0);
    }
}

fn path(folder: &Path) -> PathBuf {
    folder.join("restart").join("run.lock")
}

/// Acquires exclusive access to `folder`.
///
/// # Errors
/// [`FolderError::InUse`] if another process has it, [`FolderError::File`].
pub(crate) fn claim(folder: &Path) -> Result<Claim, FolderError> {
    let path = path(folder);
    atomic::make_folder(&folder.join("restart"))?;
    let mut file = lock(folder, open(&path)?)?;
    let holder = format!("process {} on {}\n", std::process::id(), host());
    file.set_len(0).and_then(|()| file.rewind()).map_err(FileError::write(&path))?;
    file.write_all(holder.as_bytes()).map_err(FileError::write(&path))?;
    Ok(Claim(file))
}

/// Checks whether another process works in `folder`; nothing is created or changed there.
pub(crate) fn existing(folder: &Path) -> Result<(), FolderError> {
    match File::open(path(folder)) {
        Ok(file) => lock(folder, file).map(drop),
        Err(_) => Ok(()),
    }
}

/// Opens a file to lock, which is created if it is missing.
pub(crate) fn open(path: &Path) -> Result<File, FileError> {
    OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path).map_err(FileError::write(path))
}

/// The holder named in a locked file, in parentheses; empty if there is none.
pub(crate) fn holder(file: &mut File) -> String {
    let mut by = String::new();
    // For the message only: without it, the message is shorter.
    let _ = file.read_to_string(&mut by);
    if by.trim().is_empty() { String::new() } else { format!(" ({})", by.trim()) }
}

fn lock(folder: &Path, mut file: File) -> Result<File, FolderError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            Err(FolderError::InUse { folder: folder.to_path_buf(), by: holder(&mut file) })
        }
        // A file system without locks, as on some clusters: exclusive access cannot be enforced.
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// The name of this machine, if the system reports it.
fn host() -> String {
    let hostname = std::fs::read_to_string("/proc/sys/kernel/hostname").ok().map(|name| name.trim().to_owned());
    hostname.or_else(|| std::env::var("HOSTNAME").ok()).unwrap_or_else(|| "this machine".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_worked_in_by_one_process_which_is_named_and_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let held = claim(folder.path()).unwrap();
        for refused in [claim(folder.path()).map(drop), existing(folder.path())] {
            let message = refused.unwrap_err().to_string();
            assert!(message.contains(&format!("(process {} on ", std::process::id())), "{message}");
            assert!(message.contains("--out DIR"), "{message}");
        }
        drop(held);
        assert_eq!(std::fs::read(path(folder.path())).unwrap(), b"");
        drop(claim(folder.path()).unwrap());
    }
}
