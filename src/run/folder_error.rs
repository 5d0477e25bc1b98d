//! Why a folder cannot be used by a run.

use std::path::PathBuf;

use meniscus_output::FileError;

/// A folder that a run cannot use.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// There are files in it.
    #[error(
        "the output folder {} is not empty; choose another one with --out DIR, or delete it; `run`, `compare` and `study run` \
         continue what is in it with --resume", .0.display()
    )]
    NotEmpty(PathBuf),
    /// There is no saved state in it.
    #[error("there is no run to resume in {}: no {}; start it without --resume", folder.display(), state.display())]
    NothingToResume {
        /// The folder.
        folder: PathBuf,
        /// The missing file.
        state: PathBuf,
    },
    /// The run in it is of another case.
    #[error(
        "the run in {} is of another case, or its case file was changed (saved {saved:016x}, now {now:016x}); take the case \
         it was started with (once the run has ended, time.end may be later), or start a new run with another --out DIR", folder.display()
    )]
    OtherCase {
        /// The folder.
        folder: PathBuf,
        /// Hash of the case of the saved state.
        saved: u64,
        /// Hash of the present case.
        now: u64,
    },
    /// Another process works in it.
    #[error(
        "a run is in progress in {}{by}; wait for it or stop it, or choose another folder with --out DIR", folder.display()
    )]
    InUse {
        /// The folder.
        folder: PathBuf,
        /// Who, if known.
        by: String,
    },
    /// A file of the run in it does not match the saved state.
    #[error(
        "the run cannot be resumed: {error}; put the file back from a copy, or start the run again with another --out DIR"
    )]
    Damaged {
        /// The file and what is wrong with it.
        error: FileError,
    },
    /// It cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
}
