//! The folder of a run: new and empty, or that of a run to resume.

use std::path::{Path, PathBuf};

use super::claim::{self, Claim};
use super::folder_error::FolderError;
use meniscus_output::journal;
use meniscus_output::restart::{self, Saved};
use meniscus_output::{FileError, atomic, frames, series};

/// The default folder of a new run: `base`, or if that is in use `base-2`, `base-3`, ...
///
/// An earlier run is never touched.
pub(crate) fn next_free(base: &Path) -> PathBuf {
    numbered(base).find(|folder| is_free(folder)).unwrap_or_else(|| base.to_path_buf())
}

/// The last folder that [`next_free`] returned, to resume; `base` if there is none.
pub(crate) fn last_used(base: &Path) -> PathBuf {
    numbered(base).take_while(|folder| !is_free(folder)).last().unwrap_or_else(|| base.to_path_buf())
}

/// `base`, `base-2`, `base-3`, ...
fn numbered(base: &Path) -> impl Iterator<Item = PathBuf> {
    let name = base.file_name().unwrap_or_default().to_os_string();
    let next = move |number: u32| {
        let mut name = name.clone();
        name.push(format!("-{number}"));
        base.with_file_name(name)
    };
    std::iter::once(base.to_path_buf()).chain((2..).map(next))
}

/// Whether `folder` does not exist or is an empty folder.
fn is_free(folder: &Path) -> bool {
    match std::fs::read_dir(folder) {
        Ok(mut entries) => entries.next().is_none(),
        Err(_) => !folder.exists(),
    }
}

/// Creates the folder of a new run, with exclusive access.
///
/// # Errors
/// [`FolderError::InUse`] and [`FolderError::NotEmpty`] if there is something in it, [`FolderError::File`].
pub(crate) fn create(folder: &Path) -> Result<Claim, FolderError> {
    atomic::make_folder(folder)?;
    let mut entries = std::fs::read_dir(folder).map_err(FileError::read(folder))?;
    if entries.next().is_some() {
        // Who works in it matters more than that it is not empty.
        claim::existing(folder)?;
        return Err(FolderError::NotEmpty(folder.to_path_buf()));
    }
    claim::claim(folder)
}

/// Acquires exclusive access to `folder`, in which there is a saved state of `run`, the folder itself or one within it.
///
/// # Errors
/// [`FolderError::InUse`], [`FolderError::NothingToResume`], [`FolderError::File`].
pub(crate) fn reopen(folder: &Path, run: &Path) -> Result<Claim, FolderError> {
    claim::existing(folder)?;
    let state = restart::path(run);
    if !state.exists() {
        return Err(FolderError::NothingToResume { folder: folder.to_path_buf(), state });
    }
    claim::claim(folder)
}

/// The saved state of the run in `folder`, after a check that all files that belong to it exist unchanged, and exclusive access; incomplete files of a killed
/// run are removed.
///
/// # Errors
/// [`FolderError`] if there is none, if another process works in it, if it is damaged, or if it belongs to another case.
pub(crate) fn resume(folder: &Path, case_hash: u64) -> Result<(Saved, Claim), FolderError> {
    let claim = reopen(folder, folder)?;
    let saved = restart::load(folder)?;
    if saved.case_hash != case_hash {
        return Err(FolderError::OtherCase { folder: folder.to_path_buf(), saved: saved.case_hash, now: case_hash });
    }
    check(folder, &saved).map_err(|error| FolderError::Damaged { error })?;
    atomic::remove_leftovers(folder)?;
    Ok((saved, claim))
}

/// Checks the files that were written before the saved state and cannot be rebuilt from it.
fn check(folder: &Path, saved: &Saved) -> Result<(), FileError> {
    journal::read(&series::path(folder), saved.series)?;
    frames::check(folder, &frames::read(folder, saved.frames)?)
}
