//! Append-only files: `series.csv` and the list of written frames.
//!
//! A kill may leave a truncated entry at the end, or entries that are later than the saved state. So a saved state records with a [`Mark`] how much of the file
//! belongs to it: a resumed run checks that this much is unchanged, and truncates the rest.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::atomic::{self, FileError};
use meniscus_core::math::{FNV1A_BASIS, fnv1a};

/// The extent of a file: its length in bytes and their checksum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mark {
    /// In bytes.
    pub bytes: u64,
    /// Of all of them.
    pub checksum: u64,
}

impl Default for Mark {
    fn default() -> Self {
        Self { bytes: 0, checksum: FNV1A_BASIS }
    }
}

impl Mark {
    /// The mark after `bytes`.
    pub fn after(bytes: &[u8]) -> Self {
        let mut mark = Self::default();
        mark.pass(bytes);
        mark
    }

    fn pass(&mut self, bytes: &[u8]) {
        self.bytes += bytes.len() as u64;
        self.checksum = fnv1a(self.checksum, bytes.iter().copied());
    }
}

/// An append-only file.
#[derive(Debug)]
pub struct Journal {
    pub path: PathBuf,
    /// `None` until the first entry.
    file: Option<File>,
    /// The extent so far.
    pub(crate) mark: Mark,
}

impl Journal {
    /// A new one; the file is created with its first entry.
    pub fn new(path: PathBuf) -> Self {
        Self { path, file: None, mark: Mark::default() }
    }

    /// Continues after `mark`, once [`read`] has found all before it unchanged: the rest is truncated.
    pub fn resume(path: PathBuf, mark: Mark) -> Result<Self, FileError> {
        let mut journal = Self::new(path);
        if mark.bytes > 0 {
            let file = journal.open().and_then(|file| file.set_len(mark.bytes).map(|()| file));
            journal.file = Some(file.map_err(FileError::write(&journal.path))?);
            journal.mark = mark;
        }
        Ok(journal)
    }

    /// Appends bytes.
    ///
    /// # Errors
    /// [`FileError::Write`]; then the file is as before, as far as the system allows.
    pub fn append(&mut self, piece: &[u8]) -> Result<(), FileError> {
        let Some(file) = &mut self.file else { return self.replace(piece) };
        if let Err(source) = file.write_all(piece) {
            // Best effort: the first error is the one to report.
            let _ = file.set_len(self.mark.bytes);
            return Err(FileError::write(&self.path)(source));
        }
        self.mark.pass(piece);
        Ok(())
    }

    /// Replaces the whole content.
    pub(crate) fn replace(&mut self, content: &[u8]) -> Result<(), FileError> {
        atomic::write(&self.path, content)?;
        self.file = Some(self.open().map_err(FileError::write(&self.path))?);
        self.mark = Mark::after(content);
        Ok(())
    }

    fn open(&self) -> std::io::Result<File> {
        OpenOptions::new().append(true).open(&self.path)
    }
}

/// The content of the file up to `mark`.
///
/// # Errors
/// [`FileError::Read`], or [`FileError::Content`] if it has changed since the mark was made.
pub fn read(path: &Path, mark: Mark) -> Result<Vec<u8>, FileError> {
    if mark.bytes == 0 {
        return Ok(Vec::new());
    }
    let content = FileError::content(path);
    let mut bytes = std::fs::read(path).map_err(FileError::read(path))?;
    let wanted = usize::try_from(mark.bytes).unwrap_or(usize::MAX);
    if bytes.len() < wanted {
        return Err(content(format!("expected {wanted} bytes or more, found {}", bytes.len())));
    }
    bytes.truncate(wanted);
    if Mark::after(&bytes) != mark {
        return Err(content(format!("its first {wanted} bytes are not those that the run wrote")));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_resumed_journal_lacks_what_came_after_the_mark_and_what_was_cut_short() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let mut journal = Journal::new(path.clone());
        journal.append(b"a,b\n").unwrap();
        journal.append(b"1,2\n").unwrap();
        let mark = journal.mark;
        journal.append(b"3,4\n").unwrap();
        journal.append(b"5,").unwrap();
        assert_eq!(read(&path, mark).unwrap(), b"a,b\n1,2\n");
        let mut journal = Journal::resume(path.clone(), mark).unwrap();
        journal.append(b"3,4\n").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"a,b\n1,2\n3,4\n");
        assert_eq!(journal.mark, Mark::after(b"a,b\n1,2\n3,4\n"));
    }

    #[test]
    fn a_file_that_is_missing_shorter_or_changed_is_refused_by_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        let mark = Mark::after(b"1,2\n3,4\n");
        for (content, words) in [
            (None, "no such file"),
            (Some("1,2\n"), "expected 8 bytes or more, found 4"),
            (Some("1,2\n3,5\n"), "are not those"),
        ] {
            content.inspect(|content| std::fs::write(&path, content).unwrap());
            let message = read(&path, mark).unwrap_err().to_string();
            assert!(message.contains(words) && message.contains("series.csv"), "{message}");
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_told_at_the_piece_that_did_not_fit() {
        let mut journal = Journal::new("/dev/full".into());
        journal.file = Some(journal.open().unwrap());
        let message = journal.append(b"1,2\n").unwrap_err().to_string();
        assert!(message.contains("the disk is full") && journal.mark == Mark::default(), "{message}");
    }
}
