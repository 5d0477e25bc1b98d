//! `restart/frames.csv`: every VTK file of a time series that was written, with its time, length and checksum.
//!
//! A row is appended for each file, before the `.pvd` names the file. A resumed run reads from it which files there must be.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::atomic::{self, FileError};
use super::checksum::fnv1a;
use super::journal::{self, Journal, Mark};

/// A file that was written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Written {
    /// Time in s.
    pub time: f64,
    /// The file, relative to the folder of the run.
    pub file: String,
    /// Its length.
    pub bytes: usize,
    /// Its checksum.
    pub checksum: u64,
}

/// The list on disk and in memory.
#[derive(Debug)]
pub struct FrameList {
    folder: PathBuf,
    journal: Journal,
}

/// The file in the folder of a run.
pub(crate) fn path(folder: &Path) -> PathBuf {
    folder.join("restart").join("frames.csv")
}

impl FrameList {
    /// A new, empty list.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_path_buf(), journal: Journal::new(path(folder)) }
    }

    /// Continues after `mark`, after [`read`].
    pub fn resume(folder: &Path, mark: Mark) -> Result<Self, FileError> {
        Ok(Self { folder: folder.to_path_buf(), journal: Journal::resume(path(folder), mark)? })
    }

    /// The mark of the list so far.
    pub fn mark(&self) -> Mark {
        self.journal.mark
    }

    /// Writes a file and records it.
    pub(crate) fn write(&mut self, time: f64, file: &str, content: &[u8]) -> Result<(), FileError> {
        atomic::write(&self.folder.join(file), content)?;
        let mut writer = csv::WriterBuilder::new().has_headers(self.mark().bytes == 0).from_writer(Vec::<u8>::new());
        let written = Written { time, file: file.to_owned(), bytes: content.len(), checksum: fnv1a(content) };
        writer.serialize(written).map_err(FileError::format(&self.journal.path))?;
        let line = writer.into_inner().map_err(FileError::format(&self.journal.path))?;
        self.journal.append(&line)
    }
}

/// The files that were written before `mark`, in order; a file that was written again is listed twice.
///
/// # Errors
/// [`FileError`] if the list has changed since the mark was made.
pub fn read(folder: &Path, mark: Mark) -> Result<Vec<Written>, FileError> {
    let path = path(folder);
    let text = journal::read(&path, mark)?;
    let rows: Result<Vec<Written>, _> = csv::Reader::from_reader(text.as_slice()).deserialize().collect();
    rows.map_err(FileError::content(&path))
}

/// Checks that all files of a list exist with the content that was written.
///
/// # Errors
/// [`FileError`] of the first that does not.
pub fn check(folder: &Path, frames: &[Written]) -> Result<(), FileError> {
    for (index, frame) in frames.iter().enumerate() {
        // Only the last content of a file can exist.
        if frames[index + 1..].iter().take(AGAIN).any(|later| later.file == frame.file) {
            continue;
        }
        let path = folder.join(&frame.file);
        let found = std::fs::read(&path).map_err(FileError::read(&path))?;
        if (found.len(), fnv1a(&found)) != (frame.bytes, frame.checksum) {
            let what = if found.len() == frame.bytes {
                "its content is not what the run wrote".to_owned()
            } else {
                format!("expected {} bytes, found {}", frame.bytes, found.len())
            };
            return Err(FileError::content(&path)(what));
        }
    }
    Ok(())
}

/// Largest distance in the list between two entries of the same file: files of one record.
const AGAIN: usize = 32;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_missing_or_changed_is_found_and_one_written_again_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let mut list = FrameList::new(folder.path());
        for (time, file, content) in [(0.0, "a/a-0", "zero"), (0.5, "a/a-1", "one"), (0.5, "a/a-1", "again")] {
            list.write(time, file, content.as_bytes()).unwrap();
        }
        let frames = read(folder.path(), list.mark()).unwrap();
        assert_eq!((frames.len(), frames[1].time, frames[2].bytes), (3, 0.5, 5));
        check(folder.path(), &frames).unwrap();
        for (content, words) in [("zer", "expected 4 bytes, found 3"), ("zerO", "not what the run wrote")] {
            std::fs::write(folder.path().join("a/a-0"), content).unwrap();
            let message = check(folder.path(), &frames).unwrap_err().to_string();
            assert!(message.contains("a-0") && message.contains(words), "{message}");
        }
        std::fs::remove_file(folder.path().join("a/a-0")).unwrap();
        assert!(check(folder.path(), &frames).is_err());
    }
}
