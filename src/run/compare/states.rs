//! The compared states of the direct simulation in a file, so that an interrupted comparison can be resumed.
//!
//! A line per state, as JSON: its time, the saturation, the pressure, and the cells of the invading phase, run-length encoded (alternating lengths without and
//! with it). The direct simulation itself is an ordinary run with a saved state; the states up to that one belong to it, and later ones left by a kill are
//! dropped.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::track::{Grid, Record};
use meniscus_output::FileError;
use meniscus_output::journal::{Journal, Mark};

/// Name of the file.
const STATES: &str = "direct-states.jsonl";

/// A line.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Line {
    time_s: f64,
    saturation: Option<f64>,
    pressure_pa: Option<f64>,
    runs: Vec<usize>,
}

/// The states so far, in the file and in memory.
#[derive(Debug)]
pub(crate) struct States {
    journal: Journal,
    /// All of them in order.
    pub(crate) records: Vec<Record>,
}

impl States {
    /// An empty list, in the folder of a new comparison.
    pub(crate) fn new(folder: &Path) -> Self {
        Self { journal: Journal::new(folder.join(STATES)), records: Vec::new() }
    }

    /// Those up to a time in s in the folder of a comparison on this grid.
    ///
    /// # Errors
    /// [`FileError`] where they cannot be read, or are not of this grid.
    pub(crate) fn up_to(time: f64, folder: &Path, grid: &Grid) -> Result<Self, FileError> {
        let path = folder.join(STATES);
        let bytes = std::fs::read(&path).map_err(FileError::read(&path))?;
        let mut records = Vec::new();
        let mut kept = 0;
        for line in bytes.split_inclusive(|&byte| byte == b'\n').filter(|line| line.ends_with(b"\n")) {
            let line_of_file: Line =
                serde_json::from_slice(line).map_err(|error| content(&path, &error.to_string()))?;
            if line_of_file.time_s > time {
                break;
            }
            kept += line.len();
            records.push(line_of_file.record(grid, &path)?);
        }
        let mark = Mark::after(&bytes[..kept]);
        Ok(Self { journal: Journal::resume(path, mark)?, records })
    }

    /// Adds a state, unless one of the same time exists already.
    pub(crate) fn add(&mut self, record: Record) -> Result<(), FileError> {
        if self.records.last().is_some_and(|last| record.time <= last.time) {
            return Ok(());
        }
        let line = Line::of(&record);
        let text = serde_json::to_string(&line).map_err(|error| content(&self.journal.path, &error.to_string()))?;
        self.journal.append((text + "\n").as_bytes())?;
        self.records.push(record);
        Ok(())
    }
}

impl Line {
    fn of(record: &Record) -> Self {
        let mut runs = Vec::new();
        let mut present = false;
        let mut length = 0;
        for &invaded in &record.invaded {
            if invaded != present {
                runs.push(std::mem::take(&mut length));
                present = invaded;
            }
            length += 1;
        }
        runs.push(length);
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        let [saturation, pressure_pa] = [record.saturation, record.pressure].map(finite);
        Self { time_s: record.time, saturation, pressure_pa, runs }
    }

    fn record(&self, grid: &Grid, path: &Path) -> Result<Record, FileError> {
        let cells = grid.cells.len();
        // The sum may be wrong, and no more than the number of cells may be allocated.
        let found = self.runs.iter().fold(0_usize, |sum, &run| sum.saturating_add(run));
        if found != cells {
            return Err(content(path, &format!("expected {cells} cells in each state, found {found}")));
        }
        let invaded = self.runs.iter().enumerate().flat_map(|(k, &run)| std::iter::repeat_n(k % 2 == 1, run)).collect();
        let value = |value: Option<f64>| value.unwrap_or(f64::NAN);
        Ok(Record { time: self.time_s, saturation: value(self.saturation), pressure: value(self.pressure_pa), invaded })
    }
}

fn content(path: &Path, what: &str) -> FileError {
    FileError::Content { path: PathBuf::from(path), what: what.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::math::{Bounds, Vec2};

    fn grid(cells: usize) -> Grid {
        let bounds = Bounds { min: Vec2::zeros(), max: Vec2::new(1.0, 1.0) };
        Grid { bounds, counts: [cells, 1], cells: (0..cells).map(|cell| (cell, 0)).collect() }
    }

    fn record(time: f64, saturation: f64, invaded: [bool; 4]) -> Record {
        Record { time, saturation, pressure: f64::NAN, invaded: invaded.to_vec() }
    }

    #[test]
    fn states_are_read_back_up_to_a_time_and_go_on_from_there() {
        let folder = tempfile::tempdir().unwrap();
        let all = [(0.0, [false, false, true, true]), (1.0, [true, false, true, false]), (2.0, [true; 4])];
        let all = all.map(|(time, invaded)| record(time, 0.25, invaded));
        let mut states = States::new(folder.path());
        for state in &all {
            states.add(state.clone()).unwrap();
            // A second record of one time is ignored.
            states.add(record(state.time, 0.5, [false; 4])).unwrap();
        }
        let content = |states: States| states.records.into_iter().map(|it| (it.saturation, it.invaded)).collect();
        let expected: Vec<_> = all.iter().map(|it| (it.saturation, it.invaded.clone())).collect();
        let read: Vec<(f64, Vec<bool>)> = content(States::up_to(9.0, folder.path(), &grid(4)).unwrap());
        assert_eq!(read, expected);
        // A killed run left a later state, and a truncated one.
        let path = folder.path().join(STATES);
        std::fs::write(&path, std::fs::read_to_string(&path).unwrap() + "{\"time_s\": 3").unwrap();
        let mut states = States::up_to(1.0, folder.path(), &grid(4)).unwrap();
        states.add(all[2].clone()).unwrap();
        drop(states);
        let read: Vec<(f64, Vec<bool>)> = content(States::up_to(9.0, folder.path(), &grid(4)).unwrap());
        assert_eq!(read, expected);
        let error = States::up_to(9.0, folder.path(), &grid(5)).unwrap_err().to_string();
        assert!(error.contains("expected 5 cells in each state, found 4"), "{error}");
    }
}
