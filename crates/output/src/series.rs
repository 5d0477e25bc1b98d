//! `series.csv`: one row per record, appended. A resumed run truncates a row that a kill left incomplete.
//!
//! Numbers are printed with as many digits as are needed to read back the same value; a value that does not exist (NaN, infinite) is an empty field, which
//! pandas reads as NaN.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use super::atomic::FileError;
use super::journal::{self, Journal, Mark};
use meniscus_core::solver::Series;

/// Above this, integers are not exact in double precision and are printed with an exponent: 2^53.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// The time series in memory, and on disk if it has a file.
#[derive(Debug, Default)]
pub struct SeriesFile {
    journal: Option<Journal>,
    series: Series,
}

/// Name of the file.
const NAME: &str = "series.csv";

/// The file in the folder of a run.
pub fn path(folder: &Path) -> PathBuf {
    folder.join(NAME)
}

impl SeriesFile {
    /// A new, empty series in `folder`.
    pub fn new(folder: &Path) -> Self {
        Self { journal: Some(Journal::new(path(folder))), series: Series::default() }
    }

    /// The series in `folder` up to `mark`; the rest is truncated.
    ///
    /// # Errors
    /// [`FileError`] if the file has changed since the mark was made.
    pub fn resume(folder: &Path, mark: Mark) -> Result<Self, FileError> {
        let path = path(folder);
        let series = parse(&journal::read(&path, mark)?, &path)?;
        Ok(Self { journal: Some(Journal::resume(path, mark)?), series })
    }

    /// All rows so far.
    pub fn series(&self) -> &Series {
        &self.series
    }

    /// All rows, after the last one.
    pub fn into_series(self) -> Series {
        self.series
    }

    /// The extent of the file so far.
    pub fn mark(&self) -> Mark {
        self.journal.as_ref().map(|journal| journal.mark).unwrap_or_default()
    }

    fn path(&self) -> &Path {
        self.journal.as_ref().map_or(Path::new(NAME), |journal| &journal.path)
    }

    /// Adds a row, `time_s` first. A row at or before the last time replaces the later rows; minus zero becomes zero.
    ///
    /// # Errors
    /// [`FileError::Format`] if the columns differ from those of the previous rows, or another [`FileError`].
    pub fn record(&mut self, columns: &[&str], row: Vec<f64>) -> Result<(), FileError> {
        if self.series.columns.is_empty() {
            self.series.columns = columns.iter().map(|&name| name.to_owned()).collect();
        }
        if self.series.columns != columns || row.len() != columns.len() {
            let what =
                format!("it has the columns {}, the new row has {}", self.series.columns.join(","), columns.join(","));
            return Err(FileError::format(self.path())(what));
        }
        let time = row.first().copied().unwrap_or(f64::NAN);
        // As it reads back: an infinite value does not exist either.
        let row: Vec<f64> =
            row.into_iter().map(|value| if value.is_finite() { value + 0.0 } else { f64::NAN }).collect();
        let last = self.series.rows.last().and_then(|last| last.first());
        let is_next = last.is_some_and(|&last| last < time);
        if !is_next {
            self.series.rows.retain(|old| old.first().is_some_and(|&t| t < time));
        }
        self.series.rows.push(row);
        if self.journal.is_none() {
            return Ok(());
        }
        let new = self.series.rows.len() - 1;
        let text = if is_next { self.text(None, new) } else { self.text(Some(&self.series.columns), 0) }?;
        let Some(journal) = &mut self.journal else { return Ok(()) };
        if is_next { journal.append(&text) } else { journal.replace(&text) }
    }

    /// The rows from `from` on, below the names of the columns if given.
    fn text(&self, columns: Option<&[String]>, from: usize) -> Result<Vec<u8>, FileError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        columns.map_or(Ok(()), |columns| writer.write_record(columns)).map_err(FileError::format(self.path()))?;
        for row in &self.series.rows[from..] {
            writer.write_record(row.iter().copied().map(number)).map_err(FileError::format(self.path()))?;
        }
        writer.into_inner().map_err(FileError::format(self.path()))
    }
}

/// The shortest text that reads back as `value`; empty if it is not finite.
fn number(value: f64) -> String {
    let mut text = String::new();
    add_number(&mut text, value);
    text
}

/// Adds that text.
pub(super) fn add_number(text: &mut String, value: f64) {
    let added = if !value.is_finite() {
        Ok(())
    } else if value.fract() == 0.0 && value.abs() < LARGEST_WHOLE {
        write!(text, "{value}")
    } else {
        write!(text, "{value:?}")
    };
    // Writing to memory cannot fail.
    added.unwrap_or_default();
}

/// Reads a series back; empty fields become NaN.
fn parse(bytes: &[u8], path: &Path) -> Result<Series, FileError> {
    let mut reader = csv::Reader::from_reader(bytes);
    let columns = reader.headers().map_err(FileError::content(path))?.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(FileError::content(path))?;
        let row: Result<Vec<f64>, _> =
            record.iter().map(|field| if field.is_empty() { Ok(f64::NAN) } else { field.parse() }).collect();
        let what = || format!("expected numbers, found `{}`", record.iter().collect::<Vec<_>>().join(","));
        rows.push(row.map_err(|_| FileError::content(path)(what()))?);
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
    fn a_resumed_series_is_the_unbroken_one_and_minus_zero_is_written_as_zero() {
        let folder = tempfile::tempdir().unwrap();
        let row = |time: f64| vec![time, (time * 10.0).round(), f64::NAN, 2.5e-10, f64::INFINITY, -0.0];
        let columns = ["time_s", "step", "contact_angle_deg", "dt_s", "apex_m", "momentum_x_kg_per_m_s"];
        let mut file = SeriesFile::new(folder.path());
        file.record(&columns, row(0.0)).unwrap();
        file.record(&columns, row(0.1)).unwrap();
        let mark = file.mark();
        file.record(&columns, row(0.2)).unwrap();
        let unbroken = std::fs::read_to_string(folder.path().join("series.csv")).unwrap();
        assert_eq!(unbroken.lines().nth(1), Some("0,0,,2.5e-10,,0"));
        let mut file = SeriesFile::resume(folder.path(), mark).unwrap();
        assert_eq!(file.series().rows.len(), 2);
        file.record(&columns, row(0.1)).unwrap();
        file.record(&columns, row(0.2)).unwrap();
        assert_eq!(std::fs::read_to_string(folder.path().join("series.csv")).unwrap(), unbroken);
    }

    #[test]
    fn other_columns_than_before_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let mut file = SeriesFile::new(folder.path());
        file.record(&["time_s", "step"], vec![0.0, 0.0]).unwrap();
        assert!(file.record(&["time_s", "dt_s"], vec![1.0, 0.0]).is_err());
    }
}
