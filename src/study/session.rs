//! A study whose runs are done elsewhere, by the workers of a Python program say: its runs and their results.

use std::path::Path;

use serde_json::{Value, json};

use super::definition::Study;
use super::folder::StudyFolder;
use super::load::load;
use super::report::{ReportError, report};
use super::run::PlannedRun;
use super::runs::plan;
use meniscus_core::input::InputError;

/// A study with its checked runs and its folder.
#[derive(Debug)]
pub struct Session {
    study: Study,
    runs: Vec<PlannedRun>,
    folder: StudyFolder,
}

impl Session {
    /// Loads a study file and checks the cases of all its runs. `out` is the folder of the study, `out/study-NAME` if `None`.
    ///
    /// # Errors
    /// All mistakes with their locations.
    pub fn open(path: &Path, out: Option<&Path>) -> Result<Self, InputError> {
        let study = load(path)?;
        let runs = plan(&study)?;
        let folder = StudyFolder::of(&study, out);
        Ok(Self { study, runs, folder })
    }

    /// `title` and `folder` of the study, and of each of its `runs` the `index`, `name` and `digest`.
    pub fn plan(&self) -> Value {
        let run = |run: &PlannedRun| json!({ "index": run.run.index, "name": run.run.name, "digest": run.digest() });
        json!({
            "title": self.study.title,
            "folder": self.folder.root(),
            "runs": self.runs.iter().map(run).collect::<Vec<_>>(),
        })
    }

    /// Writes table, curves and page from the results of the runs, and returns for each run its `name`, `folder`, `status`, `parameters` and `measures`.
    ///
    /// # Errors
    /// [`ReportError`].
    pub fn report(&self) -> Result<Value, ReportError> {
        let written = report(&self.study, &self.runs, &self.folder)?;
        let rows = written.results.iter().map(|result| {
            let parameters = result.run.parameters.iter().map(|one| (one.name.clone(), json!(one.value)));
            json!({
                "index": result.run.index,
                "name": result.run.name,
                "folder": self.folder.run(&result.run.name),
                "status": result.state.word(),
                "parameters": parameters.collect::<serde_json::Map<_, _>>(),
                "measures": result.state.report().map(|report| &report.measures),
            })
        });
        Ok(Value::Array(rows.collect()))
    }
}
