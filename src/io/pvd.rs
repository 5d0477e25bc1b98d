//! The `.pvd` file that joins VTK files to a time series for ParaView.
//!
//! Rewritten whole at each record, so that it is valid at any moment. A time is never doubled: a record at or before the
//! last one replaces what stands there. File numbers count the records, so a resumed run goes on where it stopped.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use super::atomic::{self, FileError};

/// One record: its time in s and its file, relative to the `.pvd`.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    time: f64,
    file: String,
}

/// A time series of VTK files: `NAME.pvd` beside the folder `NAME/` with `NAME-000000.EXT` and so on.
#[derive(Debug)]
pub struct Collection {
    folder: PathBuf,
    name: &'static str,
    extension: &'static str,
    entries: Vec<Entry>,
}

impl Collection {
    /// A new, empty series in `folder`.
    #[must_use]
    pub fn new(folder: &Path, name: &'static str, extension: &'static str) -> Self {
        Self { folder: folder.to_path_buf(), name, extension, entries: Vec::new() }
    }

    /// The series that stands in `folder`, up to and with `time` in s; empty where there is none.
    ///
    /// # Errors
    /// [`FileError`] where the `.pvd` is there but cannot be read.
    pub fn resume(folder: &Path, name: &'static str, extension: &'static str, time: f64) -> Result<Self, FileError> {
        let mut series = Self::new(folder, name, extension);
        let path = series.path();
        if path.exists() {
            let text = std::fs::read_to_string(&path).map_err(FileError::read(&path))?;
            series.entries = parse(&text).into_iter().filter(|entry| entry.time <= time).collect();
        }
        Ok(series)
    }

    /// The `.pvd` file.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        self.folder.join(format!("{}.pvd", self.name))
    }

    /// The time of the last record in s.
    #[must_use]
    pub fn last_time(&self) -> Option<f64> {
        self.entries.last().map(|entry| entry.time)
    }

    /// Writes the VTK file of `time` (s), then the `.pvd` that names it.
    ///
    /// # Errors
    /// [`FileError`].
    pub fn record(&mut self, time: f64, content: &[u8]) -> Result<(), FileError> {
        self.entries.retain(|entry| entry.time < time);
        let file = format!("{0}/{0}-{1:06}.{2}", self.name, self.entries.len(), self.extension);
        atomic::write(&self.folder.join(&file), content)?;
        self.entries.push(Entry { time, file });
        atomic::write(&self.path(), self.text().as_bytes())
    }

    fn text(&self) -> String {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n",
        );
        for Entry { time, file } in &self.entries {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "    <DataSet timestep=\"{time:?}\" part=\"0\" file=\"{file}\"/>");
        }
        text + "  </Collection>\n</VTKFile>\n"
    }
}

/// The entries of a `.pvd` that this program wrote; lines that are not entries are passed over.
fn parse(text: &str) -> Vec<Entry> {
    let attribute = |line: &str, name: &str| {
        let from = line.find(&format!("{name}=\""))? + name.len() + 2;
        let length = line[from..].find('"')?;
        Some(line[from..from + length].to_owned())
    };
    text.lines()
        .filter(|line| line.trim_start().starts_with("<DataSet "))
        .filter_map(|line| {
            Some(Entry { time: attribute(line, "timestep")?.parse().ok()?, file: attribute(line, "file")? })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resuming_drops_later_times_and_doubles_none() {
        let folder = tempfile::tempdir().unwrap();
        let mut series = Collection::new(folder.path(), "grid", "vti");
        for time in [0.0, 1.0e-7, 0.1 + 0.2] {
            series.record(time, b"x").unwrap();
        }
        let unbroken = std::fs::read(series.path()).unwrap();
        let mut series = Collection::resume(folder.path(), "grid", "vti", 1.0e-7).unwrap();
        assert_eq!(series.last_time(), Some(1.0e-7));
        series.record(1.0e-7, b"x").unwrap();
        series.record(0.1 + 0.2, b"x").unwrap();
        assert_eq!(std::fs::read(series.path()).unwrap(), unbroken);
        assert_eq!(std::fs::read_dir(folder.path().join("grid")).unwrap().count(), 3);
    }
}
