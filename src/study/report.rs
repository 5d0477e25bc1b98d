//! The report of a study: tables, curves and the page, from what stands in its folder.

use std::path::PathBuf;

use super::curve::{CurveError, svg};
use super::definition::Study;
use super::folder::StudyFolder;
use super::page::{Content, page};
use super::results::{RunResult, results};
use super::runs::PlannedRun;
use super::table::{self, Table};
use super::verdict::{Judgment, judgments};
use crate::io::{FileError, atomic};

/// A report that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file.
    #[error(transparent)]
    File(#[from] FileError),
    /// A curve.
    #[error("a curve cannot be drawn: {0}")]
    Curve(#[from] CurveError),
}

/// A report as written.
#[derive(Debug)]
pub struct StudyReport {
    /// The runs and where they stand.
    pub results: Vec<RunResult>,
    /// The table for people.
    pub table: Table,
    /// The expectations.
    pub judgments: Vec<Judgment>,
    /// The page.
    pub page: PathBuf,
}

/// Writes `table.csv`, `table.md`, `curve-1.svg` and so on, and `report.html`.
///
/// # Errors
/// [`ReportError`].
pub fn report(study: &Study, runs: &[PlannedRun], folder: &StudyFolder) -> Result<StudyReport, ReportError> {
    let results = results(runs, folder);
    let judgments = judgments(study, &results);
    let table = table::short(study, &results);
    let path = |name: &str| folder.root().join(name);
    atomic::write(&path("table.csv"), &table::full(study, &results).csv()?)?;
    atomic::write(&path("table.md"), table.markdown().as_bytes())?;
    let mut curves = Vec::new();
    for (number, curve) in study.report.curves.iter().enumerate() {
        if let Some(text) = svg(curve, &results)? {
            atomic::write(&path(&format!("curve-{}.svg", number + 1)), text.as_bytes())?;
            curves.push(text);
        }
    }
    let content = Content { study, results: &results, table: &table, curves: &curves, judgments: &judgments };
    let place = path("report.html");
    atomic::write(&place, page(&content).as_bytes())?;
    Ok(StudyReport { results, table, judgments, page: place })
}
