//! The results in the folders of the runs of a study.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::folder::StudyFolder;
use super::run::{PlannedRun, Run};
use crate::run::compare::DIRECT_RUN;
use crate::run::report::{Motion, REPORT, Reading, Status};
use meniscus_output::restart;

/// Properties of a run besides its measures.
pub(crate) const RUN_NUMBERS: [&str; 5] = ["steps", "unknowns", "wall-time-s", "solver-time-s", "cpu-s"];

/// The report of a run, as far as studies need it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) struct RunReport {
    /// How the run ended.
    pub(crate) status: Status,
    /// What went wrong.
    pub(crate) error: Option<String>,
    /// Steps since time zero.
    pub(crate) steps: u64,
    /// Measures by name.
    pub(crate) measures: BTreeMap<String, Reading>,
    /// The case file with all defaults filled in.
    pub(crate) resolved_case: String,
    /// Wall time.
    pub(crate) wall_time_s: Total,
    /// Processor time in s of all processes of the run; `None` if not known.
    pub(crate) cpu_s: Option<f64>,
    /// Statistics of the solver.
    pub(crate) solver: Unknowns,
}

/// Wall time in s of the last process of the run.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct Total {
    /// From the start to the report.
    pub(crate) total: f64,
}

/// Statistics of the solver.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct Unknowns {
    /// Particles or nodes.
    pub(crate) unknowns: usize,
    /// Wall time in s without output; missing in older reports.
    #[serde(rename = "wall-time-s", default)]
    pub(crate) wall_time_s: Option<f64>,
}

/// The state of a run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum RunState {
    /// Nothing was done, or only with another case.
    New,
    /// It was started.
    Partial,
    /// It failed.
    Failed(Box<RunReport>),
    /// It reached its end.
    Complete(Box<RunReport>),
}

impl RunState {
    /// The state in one word, for tables.
    pub(crate) fn word(&self) -> &'static str {
        match self {
            Self::New => "to do",
            Self::Partial => "partial",
            Self::Failed(_) => "failed",
            Self::Complete(_) => "done",
        }
    }

    /// The report of a complete run.
    pub(crate) fn report(&self) -> Option<&RunReport> {
        match self {
            Self::Complete(report) => Some(report),
            _ => None,
        }
    }
}

/// The state of the run in a folder, if its case is the one given by `resolved`.
pub(crate) fn run_state(folder: &Path, resolved: &str) -> RunState {
    let report: Option<RunReport> =
        std::fs::read(folder.join(REPORT)).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    match report {
        Some(report) if report.resolved_case != resolved => RunState::New,
        Some(report) => match report.status {
            Status::Done | Status::ExpectationFailed => RunState::Complete(Box::new(report)),
            Status::Failed => RunState::Failed(Box::new(report)),
            Status::Interrupted => RunState::Partial,
        },
        None if [folder, &folder.join(DIRECT_RUN)].iter().any(|it| restart::path(it).exists()) => RunState::Partial,
        None => RunState::New,
    }
}

/// Whether nothing is left to do for a run in its folder. The picture is drawn after the report, so a kill may have prevented it; the files of a comparison are
/// written before its report.
pub(crate) fn is_complete(folder: &Path, planned: &PlannedRun) -> bool {
    let is_drawn = planned.network.is_some() || planned.case.is_curve_alone() || folder.join("picture.png").exists();
    is_drawn && run_state(folder, &planned.resolved).report().is_some()
}

/// A run with its state.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RunResult {
    /// The run.
    pub(crate) run: Run,
    /// Its state.
    pub(crate) state: RunState,
}

impl RunResult {
    /// A numeric parameter, a measure, or one of [`RUN_NUMBERS`] of a complete run.
    pub(crate) fn number(&self, name: &str) -> Option<f64> {
        if let Some(value) = self.run.value(name) {
            return super::values::number_of(value);
        }
        let report = self.state.report()?;
        match name {
            "steps" => Some(report.steps as f64),
            "unknowns" => Some(report.solver.unknowns as f64),
            "wall-time-s" => Some(report.wall_time_s.total),
            "solver-time-s" => report.solver.wall_time_s,
            "cpu-s" => report.cpu_s,
            measure => report.measures.get(measure)?.value,
        }
    }

    /// The uncertainty of a measure.
    pub(crate) fn uncertainty(&self, measure: &str) -> Option<f64> {
        self.state.report()?.measures.get(measure)?.uncertainty
    }
}

/// Fraction of a value below which its error is a rounding error.
const ROUNDING: f64 = 1.0e-11;

impl RunResult {
    /// How a measure still moved at the end of its run, if by more than its uncertainty.
    pub(crate) fn motion(&self, measure: &str) -> Option<&Motion> {
        self.state.report()?.measures.get(measure)?.not_at_rest.as_ref()
    }

    /// The rounding error of a measure: a fraction of its value, of its `reference` or, for a dimensionless number, of 1.
    pub(crate) fn rounding(&self, measure: &str, reference: f64) -> f64 {
        let reading = self.state.report().and_then(|report| report.measures.get(measure));
        let one = if reading.is_some_and(|reading| reading.unit.is_empty()) { 1.0 } else { 0.0 };
        ROUNDING * self.number(measure).unwrap_or(0.0).abs().max(reference.abs()).max(one)
    }
}

/// The results in groups of the same name, in the order of their first runs.
pub(crate) fn grouped<'r>(
    results: impl Iterator<Item = &'r RunResult>,
    name: impl Fn(&RunResult) -> String,
) -> Vec<(String, Vec<&'r RunResult>)> {
    let mut groups: Vec<(String, Vec<&RunResult>)> = Vec::new();
    let mut indices: BTreeMap<String, usize> = BTreeMap::new();
    for result in results {
        let name = name(result);
        let index = *indices.entry(name.clone()).or_insert(groups.len());
        if index == groups.len() {
            groups.push((name, Vec::new()));
        }
        groups[index].1.push(result);
    }
    groups
}

/// Number of complete runs in which one of the `measures` is not at rest.
pub(crate) fn moving(results: &[RunResult], measures: &[String]) -> usize {
    results.iter().filter(|result| measures.iter().any(|measure| result.motion(measure).is_some())).count()
}

/// All runs with their states.
pub(crate) fn results(runs: &[PlannedRun], folder: &StudyFolder) -> Vec<RunResult> {
    let result = |planned: &PlannedRun| RunResult {
        run: planned.run.clone(),
        state: run_state(&folder.run(&planned.run.name), &planned.resolved),
    };
    runs.iter().map(result).collect()
}

/// The measures of all complete runs with their units, by name.
pub(crate) fn measures(results: &[RunResult]) -> BTreeMap<String, String> {
    let reports = results.iter().filter_map(|result| result.state.report());
    reports.flat_map(|report| report.measures.iter().map(|(name, m)| (name.clone(), m.unit.clone()))).collect()
}
