//! The `.pvd` file that collects VTK files into a time series for ParaView.
//!
//! Rewritten as a whole at each record, so that it is valid at any moment. Times are unique: a record at or before the last one replaces the later entries.
//! File numbers count the records, so a resumed run continues where it stopped; it rebuilds the file from the list of written files ([`super::frames`]).

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::atomic::{self, FileError};
use super::frames::{FrameList, Written};

/// A time series of VTK files: `NAME.pvd` next to the folder `NAME/` with `NAME-000000.vtu` and so on.
#[derive(Debug)]
pub struct Collection {
    folder: PathBuf,
    name: String,
    /// Times in s, ascending, each with the line of the `.pvd` that gives it with its file.
    entries: Vec<(f64, String)>,
}

impl Collection {
    /// The series in `folder` with the files `written` before; files of other series are ignored.
    pub fn new(folder: &Path, name: &str, written: &[Written]) -> Self {
        let mut collection = Self { folder: folder.to_path_buf(), name: name.to_owned(), entries: Vec::new() };
        for frame in written.iter().filter(|frame| series_of(frame) == name) {
            collection.cut(frame.time);
            collection.push(frame.time, &frame.file);
        }
        collection
    }

    /// Drops all entries at or after `time`.
    fn cut(&mut self, time: f64) {
        self.entries.truncate(self.entries.partition_point(|(earlier, _)| *earlier < time));
    }

    fn push(&mut self, time: f64, file: &str) {
        self.entries.push((time, format!("    <DataSet timestep=\"{time:?}\" part=\"0\" file=\"{file}\"/>\n")));
    }

    /// The `.pvd` file.
    pub fn path(&self) -> PathBuf {
        self.folder.join(format!("{}.pvd", self.name))
    }

    /// Writes the VTK file of `time` (s), lists it in `frames`, then writes the `.pvd` that includes it.
    pub fn record(&mut self, time: f64, content: &[u8], frames: &mut FrameList) -> Result<(), FileError> {
        self.cut(time);
        let file = format!("{0}/{0}-{1:06}.vtu", self.name, self.entries.len());
        frames.write(time, &file, content)?;
        self.push(time, &file);
        self.write()
    }

    fn write(&self) -> Result<(), FileError> {
        let lines = self.entries.iter().map(|(_, line)| line.as_str());
        let text: String = std::iter::once(HEAD).chain(lines).chain([TAIL]).collect();
        atomic::write(&self.path(), text.as_bytes())
    }
}

const HEAD: &str = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>\n";
const TAIL: &str = "  </Collection>\n</VTKFile>\n";

/// The files of a `.pvd` by their times in s, in its order.
///
/// # Errors
/// [`FileError`] if it cannot be read or is not one.
pub fn read(path: &Path) -> Result<Vec<(f64, PathBuf)>, FileError> {
    let text = std::fs::read_to_string(path).map_err(FileError::read(path))?;
    let refused = FileError::content(path);
    let document =
        roxmltree::Document::parse(&text).map_err(|error| refused(format!("{error}; run the case again")))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let sets = document.descendants().filter(|node| node.has_tag_name("DataSet"));
    let entry = |set: roxmltree::Node<'_, '_>| {
        Some((set.attribute("timestep")?.parse().ok()?, folder.join(set.attribute("file")?)))
    };
    let entries: Option<Vec<_>> = sets.map(entry).collect();
    entries.ok_or_else(|| refused("an entry has no time or no file; run the case again".to_owned()))
}

/// The series of a file: the folder that contains it.
fn series_of(frame: &Written) -> &str {
    frame.file.split_once('/').map_or("", |(series, _)| series)
}

/// Rebuilds the `.pvd` files from the files `written`, regardless of existing ones.
pub fn rebuild(folder: &Path, written: &[Written]) -> Result<(), FileError> {
    let names: BTreeSet<&str> = written.iter().map(series_of).collect();
    names.into_iter().try_for_each(|name| Collection::new(folder, name, written).write())
}

#[cfg(test)]
mod tests {
    use super::super::frames;
    use super::*;

    #[test]
    fn resuming_drops_later_times_doubles_none_and_needs_no_pvd() {
        let folder = tempfile::tempdir().unwrap();
        let (mut series, mut list) = (Collection::new(folder.path(), "grid", &[]), FrameList::new(folder.path()));
        series.record(0.0, b"x", &mut list).unwrap();
        series.record(1.0e-7, b"x", &mut list).unwrap();
        let mark = list.mark();
        series.record(0.1 + 0.2, b"x", &mut list).unwrap();
        let unbroken = std::fs::read(series.path()).unwrap();
        std::fs::write(series.path(), "damaged").unwrap();
        let written = frames::read(folder.path(), mark).unwrap();
        rebuild(folder.path(), &written).unwrap();
        assert_eq!(std::fs::read_to_string(series.path()).unwrap().matches("<DataSet ").count(), 2);
        let (mut series, mut list) =
            (Collection::new(folder.path(), "grid", &written), FrameList::resume(folder.path(), mark).unwrap());
        series.record(1.0e-7, b"x", &mut list).unwrap();
        series.record(0.1 + 0.2, b"x", &mut list).unwrap();
        assert_eq!(std::fs::read(series.path()).unwrap(), unbroken);
        assert_eq!(std::fs::read_dir(folder.path().join("grid")).unwrap().count(), 3);
        let times = [0.0, 1.0e-7, 0.1 + 0.2].into_iter().enumerate();
        let expected: Vec<_> =
            times.map(|(k, time)| (time, folder.path().join(format!("grid/grid-00000{k}.vtu")))).collect();
        assert_eq!(read(&series.path()).unwrap(), expected);
        std::fs::write(series.path(), "damaged").unwrap();
        assert!(read(&series.path()).unwrap_err().to_string().contains("grid.pvd"));
    }
}
