//! The report of a study: tables, curves, maps and the page, from the content of its folder.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::convergence::{self, Convergence};
use super::curve::{shades_axis, svg};
use super::definition::Study;
use super::ensemble::bands::{Figures, distribution};
use super::ensemble::statistics::{FULL, SHORT, groups, statistics};
use super::folder::StudyFolder;
use super::map;
use super::measured;
use super::page::{Content, page};
use super::page_of_samples::Uncertainty;
use super::resolution::Resolution;
use super::results::{RUN_NUMBERS, RunResult, RunState, measures, moving, results};
use super::run::PlannedRun;
use super::table::{self, Table};
use super::values::number_of;
use super::verdict::{Judgment, judgments};
use super::wording::Wording;
use crate::run::compare::CURVES;
use crate::run::pressure_curves::{self, Overlaid};
use meniscus_core::input::nearest;
use meniscus_output::diagram::DiagramError;
use meniscus_output::{FileError, atomic, network_page};

/// Why a report cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A file error.
    #[error(transparent)]
    File(#[from] FileError),
    /// A diagram.
    #[error(transparent)]
    Diagram(#[from] DiagramError),
}

/// A report as written.
#[derive(Debug)]
pub(crate) struct StudyReport {
    /// The runs and their states.
    pub(crate) results: Vec<RunResult>,
    /// The table for readers; with samples, their quantiles.
    pub(crate) table: Table,
    /// The table for programs.
    pub(crate) csv: PathBuf,
    /// The expectations.
    pub(crate) judgments: Vec<Judgment>,
    /// Errors along spacings, with their orders.
    pub(crate) convergences: Vec<Convergence>,
    /// Number of complete runs with a shown measure that is not at rest.
    pub(crate) moving: usize,
    /// Names in the study file that are neither a parameter nor a measure of its runs, with a remedy.
    pub(crate) unknown: Vec<String>,
    /// The page.
    pub(crate) page: PathBuf,
}

/// The diagrams in the folder of a complete run, by name.
fn diagrams_of(folder: &Path, state: &RunState) -> Vec<String> {
    let files = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = files.filter_map(|file| file.file_name().into_string().ok());
    let mut found: Vec<String> = names.filter(|name| name.starts_with("diagram-") && name.ends_with(".svg")).collect();
    found.retain(|_| state.report().is_some());
    found.sort();
    found
}

/// Of which runs that are complete there is a file.
fn with_file(results: &[RunResult], folder: &StudyFolder, name: &str) -> Vec<bool> {
    let has = |it: &RunResult| it.state.report().is_some() && folder.run(&it.run.name).join(name).is_file();
    results.iter().map(has).collect()
}

/// The curves of each complete comparison; those without a pressure have none.
fn comparisons<'r>(study: &Study, results: &'r [RunResult], folder: &StudyFolder) -> Vec<(&'r RunResult, String)> {
    let complete = results.iter().filter(|result| study.compare.is_some() && result.state.report().is_some());
    let curves = |result: &RunResult| std::fs::read_to_string(folder.run(&result.run.name).join(CURVES));
    complete.map(|result| (result, curves(result).unwrap_or_default())).collect()
}

/// The capillary pressure curves of all complete runs, each named by the values in which runs differ; `None` if fewer than two have one.
fn pressures(
    study: &Study,
    results: &[RunResult],
    folder: &StudyFolder,
    wording: &Wording,
) -> Result<Option<String>, ReportError> {
    let varies = |name: &str| results.iter().any(|result| result.run.value(name) != results[0].run.value(name));
    // One column identifies the value of an axis.
    let is_first = |name: &str| study.axes.iter().any(|axis| axis.columns.first().is_some_and(|one| one.name == name));
    let complete = results.iter().filter(|result| study.compare.is_none() && result.state.report().is_some());
    let names: Vec<String> =
        study.parameters().map(|column| column.name.clone()).filter(|name| is_first(name) && varies(name)).collect();
    let run = |result: &RunResult| Overlaid {
        name: result.run.plain_values(&names),
        number: names.first().and_then(|name| result.run.value(name)).and_then(number_of).filter(|_| names.len() == 1),
        folder: folder.run(&result.run.name),
    };
    let runs: Vec<Overlaid> = complete.map(run).collect();
    let shades =
        |numbers: &[f64]| shades_axis(&names.first().map(|name| wording.label(name)).unwrap_or_default(), numbers);
    Ok(if runs.len() > 1 { pressure_curves::overlay(&runs, wording.labels(&names), &shades)? } else { None })
}

/// Writes `table.csv`, `table.md`, `expectations.csv`, `curve-1.svg`, `map-1.svg` and so on, and `report.html`.
pub(crate) fn report(study: &Study, runs: &[PlannedRun], folder: &StudyFolder) -> Result<StudyReport, ReportError> {
    report_of(study, results(runs, folder), folder, &[])
}

/// Writes the tables of samples and returns their part of the page; `None` if nothing is sampled.
fn uncertainty<'f>(
    study: &Study,
    results: &[RunResult],
    folder: &StudyFolder,
    figures: &'f [Figures],
) -> Result<Option<Uncertainty<'f>>, ReportError> {
    let of = |style| statistics(study, results, style);
    let (Some(sampling), Some(full), Some(statistics)) = (&study.sampling, of(FULL), of(SHORT)) else {
        return Ok(None);
    };
    let path = |name: &str| folder.root().join(name);
    atomic::write(&path("quantiles.csv"), &full.quantiles.csv()?)?;
    atomic::write(&path("convergence.csv"), &full.convergence.csv()?)?;
    if let Some(indices) = &full.indices {
        atomic::write(&path("indices.csv"), &indices.csv()?)?;
    }
    let distribution = distribution(sampling, &groups(study, results), folder.root())?;
    Ok(Some(Uncertainty { statistics, distribution, figures }))
}

/// The same for runs with known states and `figures` of an ensemble; with samples, `samples.csv` replaces `table.csv`, with tables of statistics.
pub(crate) fn report_of(
    study: &Study,
    results: Vec<RunResult>,
    folder: &StudyFolder,
    figures: &[Figures],
) -> Result<StudyReport, ReportError> {
    let judgments = judgments(study, &results);
    let convergences = convergence::all(study, &results);
    let resolution = Resolution::of(study, &results);
    let wording = Wording::of(study, &results);
    let uncertainty = uncertainty(study, &results, folder, figures)?;
    let table = match &uncertainty {
        Some(uncertainty) => uncertainty.statistics.quantiles.clone(),
        None => table::short(study, &results, &resolution, &wording),
    };
    let path = |name: &str| folder.root().join(name);
    let csv = path(if uncertainty.is_some() { "samples.csv" } else { "table.csv" });
    atomic::write(&csv, &table::full(study, &results, &resolution).csv()?)?;
    atomic::write(&path("table.md"), table.markdown().as_bytes())?;
    atomic::write(&path("expectations.csv"), &expectations(&judgments).csv()?)?;
    let mut curves = Vec::new();
    for (number, curve) in study.report.curves.iter().enumerate() {
        if let Some(text) = svg(curve, &results, &wording)? {
            atomic::write(&path(&format!("curve-{}.svg", number + 1)), text.as_bytes())?;
            curves.push(text);
        }
    }
    let mut maps = Vec::new();
    for plan in map::plans(study) {
        maps.extend(map::svgs(&plan, study, &results, &wording)?);
    }
    for (number, text) in maps.iter().enumerate() {
        atomic::write(&path(&format!("map-{}.svg", number + 1)), text.as_bytes())?;
    }
    let diagrams: Vec<Vec<String>> =
        results.iter().map(|result| diagrams_of(&folder.run(&result.run.name), &result.state)).collect();
    let [pages, pictures] = [network_page::NAME, "picture.png"].map(|name| with_file(&results, folder, name));
    let comparisons = comparisons(study, &results, folder);
    let pressures = pressures(study, &results, folder, &wording)?;
    if let Some(text) = &pressures {
        atomic::write(&path(&format!("{}.svg", pressure_curves::NAME)), text.as_bytes())?;
    }
    let content = Content {
        comparisons: &comparisons,
        pressures: pressures.as_deref(),
        diagrams: &diagrams,
        pages: &pages,
        pictures: &pictures,
        study,
        results: &results,
        table: &table,
        curves: &curves,
        maps: &maps,
        wording: &wording,
        judgments: &judgments,
        convergences: &convergences,
        uncertainty: uncertainty.as_ref(),
    };
    let page_path = path("report.html");
    atomic::write(&page_path, page(&content).as_bytes())?;
    let unknown = unknown(study, &results);
    let moving = moving(&results, &table::shown_measures(study, &results));
    Ok(StudyReport { moving, results, table, csv, judgments, convergences, unknown, page: page_path })
}

/// The table of judgments for other programs.
fn expectations(judgments: &[Judgment]) -> Table {
    Table::of(
        judgments,
        &[
            ("run", &|judgment: &Judgment| judgment.of.clone()),
            ("measure", &|judgment| judgment.measure.clone()),
            ("expected", &|judgment| judgment.expected.clone()),
            ("found", &|judgment| judgment.found.clone()),
            ("verdict", &|judgment| judgment.verdict.word().to_lowercase()),
        ],
    )
}

/// Names that no run has; the measures of a run are known once it is complete.
fn unknown(study: &Study, results: &[RunResult]) -> Vec<String> {
    let there = measures(results);
    if there.is_empty() {
        return Vec::new();
    }
    let known: BTreeSet<&str> = there.keys().map(String::as_str).chain(RUN_NUMBERS).collect();
    let names: BTreeSet<&str> = measured::names(study).collect();
    let is_parameter = |name: &str| study.parameters().any(|column| column.name == name);
    let lost = names.into_iter().filter(|name| !known.contains(name) && !is_parameter(name));
    let message = |name: &str| match nearest(name, known.iter().copied()) {
        Some(near) => format!("no run has the measure `{name}`; did you mean `{near}`?"),
        None => format!("no run has the measure `{name}`"),
    };
    lost.map(message).collect()
}

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, study};
    use super::super::results::RunState;
    use super::*;

    #[test]
    fn a_misspelled_measure_is_told_when_the_measures_are_known() {
        let study = study(
            "[[axis]]\nkey = 'spacing'\nvalues = [1, 2]\n[[trend]]\nmeasure = 'velocity-eror'\nalong = 'spacing'\n\
             [[report.curve]]\nx = 'spacing'\ny = 'm'\n[[report.curve]]\nx = 'wall-time-s'\ny = 'far-from-all'\n",
        );
        let mut results = complete(&study, |_| 1.0);
        assert_eq!(unknown(&study, &[]), Vec::<String>::new());
        let RunState::Complete(report) = &mut results[0].state else { panic!("complete") };
        report.measures.insert("velocity-error".into(), report.measures["m"].clone());
        assert_eq!(
            unknown(&study, &results),
            [
                "no run has the measure `far-from-all`",
                "no run has the measure `velocity-eror`; did you mean `velocity-error`?"
            ]
        );
    }
}
