//! Results of the runs of subdomains, compared with the formula.

use super::fluids::Fluids;
use super::plan::{Kind, Planned, case_name};
use crate::study::results::{RunResult, RunState};
use meniscus_network::cycles::FluidPhase;

/// Relative difference between the entry pressures of both spacings above which neither is trusted.
const COARSE_PRESSURE: f64 = 0.05;
/// The same for conductances, which scale with the third power of the width.
const COARSE_FLOW: f64 = 0.15;
/// Relative drift of the area of a phase above which a run is not trusted.
const LEAKED: f64 = 0.01;

/// Outcome of the verification of a throat.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Status {
    /// Verified.
    Ok,
    /// The meniscus is still moving.
    NotAtRest,
    /// Both spacings differ, or a phase is not resolved.
    UnderResolved(String),
    /// A run failed.
    Failed(String),
    /// A run has not been done.
    Open,
    /// No subdomain.
    Impossible(String),
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ok => write!(f, "ok"),
            Self::NotAtRest => write!(f, "not at rest"),
            Self::UnderResolved(why) => write!(f, "under-resolved: {why}"),
            Self::Failed(why) => write!(f, "failed: {why}"),
            Self::Open => write!(f, "to do"),
            Self::Impossible(why) => write!(f, "cut-out impossible: {why}"),
        }
    }
}

/// A value of a direct run with its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Direct {
    /// Value at the finest spacing.
    pub(crate) value: f64,
    /// Difference from the next spacing plus the error bar of the run; `None` with a single spacing.
    pub(crate) error: Option<f64>,
}

/// A throat with the results by formula and by direct simulation.
#[derive(Debug)]
pub(crate) struct Row<'a> {
    /// The throat.
    pub(crate) planned: &'a Planned,
    /// Entry pressure by the formula in Pa, invading less defending phase.
    pub(crate) pressure_formula: f64,
    /// The same by direct simulation.
    pub(crate) pressure: Option<Direct>,
    /// Conductance of the subdomain by direct simulation in m².
    pub(crate) conductance: Option<Direct>,
    /// Outcome of the entry pressure.
    pub(crate) status: Status,
    /// Outcome of the conductance.
    pub(crate) flow_status: Status,
    /// Particles of the finest run.
    pub(crate) particles: Option<f64>,
    /// Wall time of all runs in s.
    pub(crate) wall_time: f64,
    /// Names of complete runs, for their pictures.
    pub(crate) runs: Vec<String>,
}

impl Row<'_> {
    /// Relative difference of the direct entry pressure from the formula.
    pub(crate) fn pressure_difference(&self) -> Option<f64> {
        Some(self.pressure?.value / self.pressure_formula - 1.0)
    }

    /// Relative difference of the direct conductance from the formula.
    pub(crate) fn conductance_difference(&self) -> Option<f64> {
        Some(self.conductance?.value / self.planned.conductance? - 1.0)
    }

    /// Whether the direct value replaces the formula: it differs by more than its own error.
    pub(crate) fn is_replaced(&self) -> bool {
        let Some(Direct { value, error: Some(error) }) = self.pressure else { return false };
        self.status == Status::Ok && (value - self.pressure_formula).abs() > error
    }
}

/// A finite number of a complete run.
fn number(run: &RunResult, name: &str) -> Option<f64> {
    run.number(name).filter(|value| value.is_finite())
}

/// The runs of a throat, from coarse to fine.
fn runs_of<'a>(number: usize, kind: Kind, spacings: &[u32], results: &'a [RunResult]) -> Vec<&'a RunResult> {
    let mut across: Vec<u32> = spacings.to_vec();
    across.sort_unstable();
    let run = |across| {
        let name = case_name(number, kind, across);
        results.iter().find(|result| result.run.case.file_stem().is_some_and(|stem| stem.to_string_lossy() == name))
    };
    across.into_iter().filter_map(run).collect()
}

/// Why runs have no value yet; `None` if all are complete.
fn unfinished(runs: &[&RunResult]) -> Option<Status> {
    let failed = runs.iter().find_map(|run| match &run.state {
        RunState::Failed(report) => Some(report.error.as_deref().unwrap_or_default()),
        _ => None,
    });
    if let Some(why) = failed {
        return Some(Status::Failed(why.lines().next().unwrap_or("the solver failed").to_owned()));
    }
    (runs.is_empty() || runs.iter().any(|run| run.state.report().is_none())).then_some(Status::Open)
}

/// The row of a throat; `spacings` in order.
pub(crate) fn row<'a>(planned: &'a Planned, fluids: &Fluids, spacings: &[u32], results: &[RunResult]) -> Row<'a> {
    let curvature = planned.subdomain.as_ref().map_or(f64::NAN, |subdomain| subdomain.meniscus.curvature);
    let runs = |kind: Kind| runs_of(planned.chosen.number, kind, spacings, results);
    let (entries, flows) = (runs(Kind::Entry), runs(Kind::Flow));
    let all = || entries.iter().chain(&flows).filter(|run| run.state.report().is_some());
    let mut row = Row {
        planned,
        pressure_formula: fluids.pressure(curvature),
        pressure: None,
        conductance: None,
        status: Status::Open,
        flow_status: Status::Open,
        particles: entries.last().and_then(|run| number(run, "unknowns")),
        wall_time: all().filter_map(|run| number(run, "wall-time-s")).sum::<f64>() + 0.0,
        runs: all().map(|run| run.run.name.clone()).collect(),
    };
    if let Err(why) = &planned.subdomain {
        (row.status, row.flow_status) = (Status::Impossible(why.to_string()), Status::Impossible(why.to_string()));
        return row;
    }
    let sign = if fluids.invading == FluidPhase::NonWetting { 1.0 } else { -1.0 };
    let pressures = |run: &RunResult| {
        let bar = run.uncertainty("entry-pressure-Pa").unwrap_or(0.0);
        number(run, "entry-pressure-Pa").map(|value| (sign * value, bar))
    };
    (row.pressure, row.status) = judged(&entries, COARSE_PRESSURE, &pressures);
    if row.status == Status::Ok {
        row.status = at_rest(&entries);
    }
    if planned.conductance.is_some() {
        let viscosity =
            planned.subdomain.as_ref().map_or(f64::NAN, |subdomain| fluids.of(subdomain.width)[0].viscosity);
        let conductance = |run: &RunResult| {
            let drop = number(run, "driving-pressure-drop-Pa")?;
            Some((viscosity * number(run, "asked-inflow-m2-per-s")? / drop, 0.0))
        };
        (row.conductance, row.flow_status) = judged(&flows, COARSE_FLOW, &conductance);
    } else {
        row.flow_status = Status::Impossible("no formula for the cut-out".to_owned());
    }
    row
}

/// The finest value with its error, from runs in order from coarse to fine; `coarse` is the largest relative difference allowed between two.
fn judged(
    runs: &[&RunResult],
    coarse: f64,
    value: &dyn Fn(&RunResult) -> Option<(f64, f64)>,
) -> (Option<Direct>, Status) {
    if let Some(status) = unfinished(runs) {
        return (None, status);
    }
    let values: Vec<Option<(f64, f64)>> = runs.iter().map(|run| value(run)).collect();
    let Some(&Some((finest, bar))) = values.last() else {
        return (None, Status::UnderResolved("a phase has no particle away from the interface".to_owned()));
    };
    let coarser = values.len().checked_sub(2).map(|before| values[before].map(|(value, _)| value));
    let error = coarser.flatten().map(|coarser| (finest - coarser).abs() + bar);
    let direct = Direct { value: finest, error };
    match coarser {
        Some(None) => (Some(direct), Status::UnderResolved("the coarser run has no value".to_owned())),
        Some(Some(coarser)) if (finest - coarser).abs() > coarse * finest.abs() => {
            let percent = 100.0 * (coarser / finest - 1.0).abs();
            (Some(direct), Status::UnderResolved(format!("both spacings differ by {percent:.1} %")))
        }
        _ => (Some(direct), Status::Ok),
    }
}

/// Whether the finest run has come to rest, with its areas conserved.
fn at_rest(entries: &[&RunResult]) -> Status {
    let Some(finest) = entries.last() else { return Status::Open };
    match number(finest, "area-drift") {
        Some(drift) if drift > LEAKED => {
            Status::UnderResolved(format!("the area of a phase drifted by {:.1} %", 100.0 * drift))
        }
        _ if number(finest, "steady-at-s").is_none() => Status::NotAtRest,
        _ => Status::Ok,
    }
}
