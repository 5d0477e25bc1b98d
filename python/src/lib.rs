//! The native part of the Python package `meniscus`: runs, checks and studies by the library, as on the command line but without printing.
//!
//! [`call`](mod@call) handles threads, signals and progress, [`given`] reads the input of a call, [`fields`] collects the output of a solver, and [`data`]
//! hands it over. Types, names and help are in the Python part: `python/meniscus`.

mod call;
mod data;
mod fields;
mod given;
mod refused;
mod study;

use std::path::PathBuf;
use std::time::Instant;

use meniscus::run::checked;
use meniscus::run::execute::{Finished, Job, Mode, RunError, execute, run_in_memory};
use meniscus::run::report::Report;
use meniscus::run::setup;
use meniscus::run::source::Source;
use meniscus::{Series, Solver};
use mimalloc::MiMalloc;
use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;

use crate::call::{Call, Observer, Work, call};
use crate::data::Data;
use crate::given::Given;
use crate::refused::Refused;

/// Keeps the large arrays of a step, as the program does.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// Where the files of a run are written.
struct Output {
    folder: PathBuf,
    mode: Mode,
}

/// Runs a case; see `meniscus.run`.
#[pyfunction]
fn run(
    py: Python<'_>,
    given: Given,
    out: Option<(PathBuf, bool)>,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
    keep_frames: bool,
) -> PyResult<Bound<'_, PyAny>> {
    let output = out.map(|(folder, resume)| Output { folder, mode: if resume { Mode::Resume } else { Mode::New } });
    let how = Call { threads, progress, token: None };
    let found = call(py, how, |work| run_given(work, &given, output, keep_frames))?;
    found.map_err(|refused| refused.into_error(py))?.into_python(py)
}

fn run_given(work: &Work<'_>, given: &Given, output: Option<Output>, keep_frames: bool) -> Result<Data, Refused> {
    let source = given.source()?;
    let is_resumed = output.as_ref().is_some_and(|output| output.mode == Mode::Resume);
    let mut solver = built(work, &source, is_resumed)?;
    let mut observer = Observer::new(work, keep_frames);
    let Source { case, resolved, .. } = &source;
    let (report, series): (Report, Series) = match &output {
        Some(Output { folder, mode }) => {
            let job = Job { case, resolved, folder: folder.clone(), mode: *mode };
            let finished = execute(&job, solver.as_mut(), work.interrupt, &mut observer);
            let Finished { report, series, .. } = finished.map_err(|error| not_run(&error))?;
            (report, series)
        }
        None => run_in_memory(case, resolved, solver.as_mut(), work.interrupt, &mut observer)
            .map_err(|error| Refused::Folder(error.to_string()))?,
    };
    let report = serde_json::to_string(&report).map_err(|error| Refused::Solver(error.to_string()))?;
    let folder = output.map_or(Data::Absent, |output| Data::text(&output.folder.to_string_lossy()));
    Ok(Data::group([
        ("report", Data::Text(report)),
        ("series", fields::series(&series)),
        ("end", fields::all(solver.as_ref())),
        ("frames", Data::List(observer.into_frames())),
        ("notes", Data::List(source.notes.into_iter().map(Data::Text).collect())),
        ("folder", folder),
    ]))
}

/// The solver of a case, unless the call was stopped meanwhile.
fn built(work: &Work<'_>, source: &Source, is_resumed: bool) -> Result<Box<dyn Solver>, Refused> {
    let mut packed = |_: f64| work.tell(0.0, || "particles are packed to walls and interfaces".to_owned());
    let solver = match is_resumed {
        false => setup::build_watched(&source.case, &mut packed),
        true => setup::build_to_resume(&source.case),
    };
    let solver = solver.map_err(|error| source.refused(&error))?;
    if work.is_stopped() { Err(Refused::Stopped) } else { Ok(solver) }
}

fn not_run(error: &RunError) -> Refused {
    match error {
        RunError::Folder(_) | RunError::File(_) | RunError::State(_) => Refused::Folder(error.to_string()),
        RunError::Case(_) => Refused::Solver(error.to_string()),
    }
}

/// The estimated cost of a run, as JSON; see `meniscus.check`.
#[pyfunction]
fn check(py: Python<'_>, given: Given, threads: Option<usize>, progress: Option<Py<PyAny>>) -> PyResult<String> {
    let how = Call { threads, progress, token: None };
    let found = call(py, how, |work| -> Result<String, Refused> {
        let clock = Instant::now();
        let source = given.source()?;
        let mut solver = built(work, &source, false)?;
        let built_s = clock.elapsed().as_secs_f64();
        let tried = &mut |fraction| work.tell(fraction, || "first steps are tried".to_owned());
        let checked = checked::check(&source.case, solver.as_mut(), built_s, tried);
        let checked = checked.map_err(|error| Refused::Solver(error.to_string()))?;
        checked.json().map_err(|error| Refused::Solver(error.to_string()))
    })?;
    found.map_err(|refused| refused.into_error(py))
}

/// The native part of the package.
#[pymodule(gil_used = false)]
fn _meniscus(module: &Bound<'_, PyModule>) -> PyResult<()> {
    if !meniscus::cli::processor::is_sufficient() {
        return Err(PyImportError::new_err(meniscus::cli::processor::INSUFFICIENT));
    }
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(run, module)?)?;
    module.add_function(wrap_pyfunction!(check, module)?)?;
    module.add_function(wrap_pyfunction!(study::study_plan, module)?)?;
    module.add_function(wrap_pyfunction!(study::study_run, module)?)?;
    module.add_function(wrap_pyfunction!(study::study_report, module)?)?;
    module.add_function(wrap_pyfunction!(study::stop, module)?)?;
    Ok(())
}
