//! Studies: their runs one by one, and their table.

use std::path::PathBuf;

use meniscus::study::End;
use meniscus::study::execute::ExecuteError;
use meniscus::study::numbered::{Numbered, NumberedError};
use meniscus::study::session::Session;
use pyo3::prelude::*;

use crate::call::{self, Call, Observer, call};
use crate::refused::Refused;

/// Title, folder and runs of a study as JSON.
#[pyfunction]
pub(crate) fn study_plan(py: Python<'_>, path: PathBuf, out: Option<PathBuf>) -> PyResult<String> {
    let how = Call { threads: Some(1), progress: None, token: None };
    let found =
        call(py, how, |_| -> Result<String, Refused> { Ok(Session::open(&path, out.as_deref())?.plan().to_string()) })?;
    found.map_err(|refused| refused.into_error(py))
}

/// Does one run of a study: returns its status, and why it failed if it did.
#[pyfunction]
pub(crate) fn study_run(
    py: Python<'_>,
    path: PathBuf,
    out: Option<PathBuf>,
    run: (usize, String),
    threads: Option<usize>,
    token: String,
) -> PyResult<(&'static str, String)> {
    let how = Call { threads, progress: None, token: Some(token) };
    let found = call(py, how, |work| -> Result<End, Refused> {
        let run = Numbered::open(&path, out.as_deref(), run.0, Some(&run.1)).map_err(|error| match error {
            NumberedError::Input(mistakes) => mistakes.into(),
            other => Refused::Folder(other.to_string()),
        })?;
        let _claim = run.claim().map_err(not_done)?;
        run.run(work.interrupt, &mut Observer::new(work, false)).map_err(not_done)
    })?;
    Ok(match found.map_err(|refused| refused.into_error(py))? {
        End::WasComplete | End::Complete => ("done", String::new()),
        End::Interrupted => ("interrupted", String::new()),
        End::Failed(why) => ("failed", why),
    })
}

fn not_done(error: ExecuteError) -> Refused {
    match error {
        ExecuteError::Setup(mistakes) => mistakes.into(),
        other => Refused::Folder(other.to_string()),
    }
}

/// Writes the table and the page of a study, and returns a summary of all runs, as JSON.
#[pyfunction]
pub(crate) fn study_report(py: Python<'_>, path: PathBuf, out: Option<PathBuf>) -> PyResult<String> {
    let how = Call { threads: Some(1), progress: None, token: None };
    let found = call(py, how, |_| -> Result<String, Refused> {
        let report = Session::open(&path, out.as_deref())?.report();
        Ok(report.map_err(|error| Refused::Folder(error.to_string()))?.to_string())
    })?;
    found.map_err(|refused| refused.into_error(py))
}

/// Requests the runs that were started with a token to stop.
#[pyfunction]
pub(crate) fn stop(token: &str) {
    call::stop(token);
}
