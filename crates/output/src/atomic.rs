//! Atomic file writes: to a temporary file in the same folder, then a rename over the old one.
//!
//! If the program is killed, the old file or the new one remains. Data is not synced to the disk, so a power cut may still lose a file; what must survive that
//! carries a checksum (see [`super::restart`]).

use std::fmt::Display;
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// A file or folder that cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// A file cannot be written.
    #[error("cannot write {}: {}; {}", path.display(), cause(source), advice(source))]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A folder cannot be created.
    #[error("cannot make the folder {}: {}; {}", path.display(), cause(source), advice(source))]
    Folder {
        /// The folder.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A file cannot be read.
    #[error("cannot read {}: {}", path.display(), cause(source))]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: io::Error,
    },
    /// A file was read but has unexpected content.
    #[error("{} has unexpected content: {what}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and a remedy.
        what: String,
    },
    /// Data that a file format cannot hold.
    #[error("{} cannot hold the data: {what}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
}

impl FileError {
    /// A [`FileError::Write`], for `map_err`.
    pub fn write(path: &Path) -> impl Fn(io::Error) -> Self {
        move |source| Self::Write { path: path.to_path_buf(), source }
    }

    /// A [`FileError::Read`], for `map_err`.
    pub fn read(path: &Path) -> impl Fn(io::Error) -> Self {
        move |source| Self::Read { path: path.to_path_buf(), source }
    }

    /// A [`FileError::Content`], for `map_err`.
    pub(crate) fn content<E: Display>(path: &Path) -> impl Fn(E) -> Self {
        move |what| Self::Content { path: path.to_path_buf(), what: what.to_string() }
    }

    /// A [`FileError::Format`], for `map_err`.
    pub(crate) fn format<E: Display>(path: &Path) -> impl Fn(E) -> Self {
        move |what| Self::Format { path: path.to_path_buf(), what: what.to_string() }
    }
}

/// The cause as text.
fn cause(source: &io::Error) -> String {
    match source.kind() {
        ErrorKind::StorageFull | ErrorKind::WriteZero => "the disk is full".into(),
        ErrorKind::QuotaExceeded => "the disk quota is used up".into(),
        ErrorKind::FileTooLarge => "the file is larger than the system allows".into(),
        ErrorKind::ReadOnlyFilesystem => "the disk is read-only".into(),
        ErrorKind::PermissionDenied => "permission denied".into(),
        ErrorKind::NotFound => "no such file or folder".into(),
        ErrorKind::NotADirectory => "part of its path is a file, not a folder".into(),
        ErrorKind::AlreadyExists => "a file of that name exists".into(),
        ErrorKind::IsADirectory => "a folder of that name exists".into(),
        _ => source.to_string(),
    }
}

/// Advice for the user.
fn advice(source: &io::Error) -> &'static str {
    match source.kind() {
        ErrorKind::StorageFull | ErrorKind::WriteZero | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "free some space or choose another folder with --out, then continue with --resume"
        }
        ErrorKind::ReadOnlyFilesystem | ErrorKind::PermissionDenied => {
            "choose a folder that you may write to with --out DIR"
        }
        _ => "choose another folder with --out DIR",
    }
}

/// Creates a folder and its parents; no error if it exists.
pub fn make_folder(path: &Path) -> Result<(), FileError> {
    fs::create_dir_all(path).map_err(|source| FileError::Folder { path: path.to_path_buf(), source })
}

/// Writes `bytes` to `path`, replacing what was there; creates the folder if it is missing.
///
/// # Errors
/// [`FileError`]; then the old file, if any, is unchanged and nothing else is left behind.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    write_with(path, |file| file.write_all(bytes))
}

/// The same with what `content` writes.
///
/// # Errors
/// [`FileError`]; then the old file, if any, is unchanged and nothing else is left behind.
pub fn write_with(path: &Path, content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), FileError> {
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        make_folder(folder)?;
    }
    let temporary = temporary_name(path);
    let written = File::create(&temporary).and_then(|file| {
        let mut file = BufWriter::new(file);
        content(&mut file)?;
        file.flush()
    });
    let done = written.and_then(|()| fs::rename(&temporary, path));
    if done.is_err() {
        // Best effort: the first error is the one to report.
        let _ = fs::remove_file(&temporary);
    }
    done.map_err(FileError::write(path))
}

/// Removes the temporary files that a killed program left in `folder` and the folders in it.
///
/// # Errors
/// [`FileError`] if a folder cannot be read or a file cannot be removed.
pub fn remove_leftovers(folder: &Path) -> Result<(), FileError> {
    for entry in fs::read_dir(folder).map_err(FileError::read(folder))? {
        let path = entry.map_err(FileError::read(folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            remove_leftovers(&path)?;
        } else if name.starts_with('.') && name.ends_with(TEMPORARY) {
            fs::remove_file(&path).map_err(FileError::write(&path))?;
        }
    }
    Ok(())
}

/// Ending of the names of temporary files.
const TEMPORARY: &str = ".part";

/// A name in the same folder that no other process uses: hidden, with the process ID.
fn temporary_name(path: &Path) -> PathBuf {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    path.with_file_name(format!(".{name}.{}{TEMPORARY}", std::process::id()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_no_temporary_file_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("new/folder/data.txt");
        write(&path, b"old").unwrap();
        write(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
    }

    #[test]
    fn what_a_killed_program_leaves_behind_is_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("restart/state.bin");
        write(&path, b"state").unwrap();
        fs::write(temporary_name(&path), b"half a st").unwrap();
        remove_leftovers(folder.path()).unwrap();
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
        assert_eq!(fs::read(&path).unwrap(), b"state");
    }

    #[test]
    fn a_path_below_a_file_is_refused_with_a_way_out() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let message = write(&file.join("below/data"), b"x").unwrap_err().to_string();
        assert!(message.contains("cannot make the folder") && message.contains("--out"), "{message}");
    }

    #[test]
    fn a_failed_rename_keeps_what_was_there_and_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("taken");
        fs::create_dir(&path).unwrap();
        let message = write(&path, b"x").unwrap_err().to_string();
        assert!(message.contains("a folder of that name exists"), "{message}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn causes_are_called_by_their_names_with_a_way_out() {
        for (kind, words) in [
            (
                ErrorKind::StorageFull,
                "cannot write out/series.csv: the disk is full; free some space or choose another folder with --out, then continue with --resume",
            ),
            (ErrorKind::ReadOnlyFilesystem, "the disk is read-only; choose a folder"),
            (ErrorKind::PermissionDenied, "permission denied; choose a folder"),
        ] {
            let message = FileError::Write { path: "out/series.csv".into(), source: kind.into() }.to_string();
            assert!(message.contains(words), "{message}");
        }
    }
}
