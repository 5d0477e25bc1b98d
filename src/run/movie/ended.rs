//! What a run left in its report.

use std::path::Path;

use serde::Deserialize;

use super::failure::MovieFailure;
use crate::run::report::{REPORT, Status};
use crate::run::source::{Source, load_case_text};
use meniscus_output::FileError;

/// What the report of a run tells about it.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) struct Written {
    pub(super) version: String,
    pub(super) status: Status,
    pub(super) clock: Reached,
    pub(super) steps: u64,
    pub(super) resolved_case: String,
}

/// The end of a run.
#[derive(Debug, Deserialize)]
pub(super) struct Reached {
    pub(super) value: f64,
}

/// A run that has left a report.
pub(super) struct Ended {
    pub(super) written: Written,
    pub(super) source: Source,
}

/// The report and the case of a run; `None` if there is no report yet.
pub(super) fn ended(folder: &Path) -> Result<Option<Ended>, MovieFailure> {
    let path = folder.join(REPORT);
    if !path.exists() {
        return Ok(None);
    }
    let bytes = std::fs::read(&path).map_err(FileError::read(&path))?;
    let written: Written = serde_json::from_slice(&bytes).map_err(|error| FileError::Content {
        path: path.clone(),
        what: format!("{error}; continue the run with --resume, which writes it again"),
    })?;
    let source = load_case_text(REPORT, &written.resolved_case, &[])
        .map_err(|error| MovieFailure::Case { path, error: Box::new(error) })?;
    Ok(Some(Ended { written, source }))
}
