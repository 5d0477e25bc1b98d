//! `series.csv`: one row per record, rewritten whole each time, so that it is valid at any moment.
//!
//! Numbers are printed with as many digits as are needed to read back the same value; a value that does not exist (NaN) is
//! an empty field, which pandas reads as NaN.

use std::path::{Path, PathBuf};

use super::atomic::{self, FileError};
use crate::solver::Series;

/// Above this, whole numbers of a double are no longer exact and are printed with an exponent: 2^53.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// The time series on disk and in memory.
#[derive(Debug)]
pub struct SeriesFile {
    path: PathBuf,
    series: Series,
}

impl SeriesFile {
    /// A new, empty series in `folder`.
    #[must_use]
    pub fn new(folder: &Path) -> Self {
        Self { path: folder.join("series.csv"), series: Series::default() }
    }

    /// The series that stands in `folder`, up to and with `time` in s; empty where there is none.
    ///
    /// # Errors
    /// [`FileError`] where the file is there but cannot be read.
    pub fn resume(folder: &Path, time: f64) -> Result<Self, FileError> {
        let mut file = Self::new(folder);
        if file.path.exists() {
            file.series = read(&file.path)?;
            file.series.rows.retain(|row| row.first().is_some_and(|&t| t <= time));
        }
        Ok(file)
    }

    /// All rows so far.
    #[must_use]
    pub fn series(&self) -> &Series {
        &self.series
    }

    /// Adds a row, `time_s` first, and writes the file. A row at or before the last time replaces what stands there; minus
    /// zero becomes zero.
    ///
    /// # Errors
    /// [`FileError::Format`] where the columns differ from those of the rows before, or another [`FileError`].
    pub fn record(&mut self, columns: &[&str], row: Vec<f64>) -> Result<(), FileError> {
        if self.series.columns.is_empty() {
            self.series.columns = columns.iter().map(|&name| name.to_owned()).collect();
        }
        if self.series.columns != columns || row.len() != columns.len() {
            let what =
                format!("it has the columns {}, the new row has {}", self.series.columns.join(","), columns.join(","));
            return Err(FileError::Format { path: self.path.clone(), what });
        }
        let time = row.first().copied().unwrap_or(f64::NAN);
        self.series.rows.retain(|old| old.first().is_some_and(|&t| t < time));
        self.series.rows.push(row.into_iter().map(|value| value + 0.0).collect());
        atomic::write(&self.path, &self.text()?)
    }

    fn text(&self) -> Result<Vec<u8>, FileError> {
        let format = |what: String| FileError::Format { path: self.path.clone(), what };
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.series.columns).map_err(|error| format(error.to_string()))?;
        for row in &self.series.rows {
            writer.write_record(row.iter().copied().map(number)).map_err(|error| format(error.to_string()))?;
        }
        writer.into_inner().map_err(|error| format(error.to_string()))
    }
}

/// The shortest text that reads back as `value`; empty for NaN.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        String::new()
    } else if value.fract() == 0.0 && value.abs() < LARGEST_WHOLE {
        format!("{value}")
    } else {
        format!("{value:?}")
    }
}

/// Reads a series back; empty fields become NaN.
///
/// # Errors
/// [`FileError::Read`] or [`FileError::Content`].
pub fn read(path: &Path) -> Result<Series, FileError> {
    let content = |what: String| FileError::Content { path: path.to_path_buf(), what };
    let bytes = std::fs::read(path).map_err(FileError::read(path))?;
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let columns = reader.headers().map_err(|error| content(error.to_string()))?.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| content(error.to_string()))?;
        let row: Result<Vec<f64>, _> =
            record.iter().map(|field| if field.is_empty() { Ok(f64::NAN) } else { field.parse() }).collect();
        rows.push(row.map_err(|_| {
            content(format!("expected numbers, found `{}`", record.iter().collect::<Vec<_>>().join(",")))
        })?);
    }
    Ok(Series { columns, rows })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_finite_number_reads_back_with_the_same_bits(value in any::<f64>()) {
            prop_assume!(value.is_finite());
            prop_assert_eq!(number(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
    }

    #[test]
    fn a_resumed_series_is_the_unbroken_one() {
        let folder = tempfile::tempdir().unwrap();
        let row = |time: f64| vec![time, (time * 10.0).round(), f64::NAN, 2.5e-10];
        let columns = ["time_s", "step", "contact_angle_deg", "dt_s"];
        let mut file = SeriesFile::new(folder.path());
        for time in [0.0, 0.1, 0.2] {
            file.record(&columns, row(time)).unwrap();
        }
        let unbroken = std::fs::read_to_string(folder.path().join("series.csv")).unwrap();
        assert_eq!(unbroken.lines().nth(1), Some("0,0,,2.5e-10"));
        let mut file = SeriesFile::resume(folder.path(), 0.1).unwrap();
        assert_eq!(file.series().rows.len(), 2);
        file.record(&columns, row(0.1)).unwrap();
        file.record(&columns, row(0.2)).unwrap();
        assert_eq!(std::fs::read_to_string(folder.path().join("series.csv")).unwrap(), unbroken);
    }

    #[test]
    fn minus_zero_is_written_as_zero() {
        let folder = tempfile::tempdir().unwrap();
        let mut file = SeriesFile::new(folder.path());
        file.record(&["time_s", "momentum_x_kg_per_m_s"], vec![0.0, -0.0]).unwrap();
        assert!(std::fs::read_to_string(folder.path().join("series.csv")).unwrap().ends_with("\n0,0\n"));
    }

    #[test]
    fn other_columns_than_before_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let mut file = SeriesFile::new(folder.path());
        file.record(&["time_s", "step"], vec![0.0, 0.0]).unwrap();
        assert!(file.record(&["time_s", "dt_s"], vec![1.0, 0.0]).is_err());
    }
}
