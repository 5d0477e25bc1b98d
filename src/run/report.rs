//! `report.json`: how a run ended and its results. A value that does not exist (NaN) is `null`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::drift::Drift;
use super::numbers::{Length, Number};
use super::steady::Steadiness;
use meniscus_case::{Case, Expectation};
use meniscus_core::solver::{Clock, Measure, PartTime, Quantity, Series, Statistics, Watched};
use meniscus_output::{FileError, atomic};

/// Name of the file.
pub(crate) const REPORT: &str = "report.json";

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// It reached the end, and all expectations are met.
    Done,
    /// It was stopped by the user and can be resumed.
    Interrupted,
    /// The solver failed, or a file could not be written.
    Failed,
    /// It reached the end, but a measure does not meet its expectation.
    ExpectationFailed,
}

/// The machine of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Machine {
    /// Number of cores that the system offers.
    pub cores: usize,
    /// Number of threads that the run used.
    pub threads: usize,
    /// Operating system and processor.
    pub os: String,
}

impl Machine {
    /// This machine and the present thread pool.
    pub(crate) fn present() -> Self {
        Self {
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            threads: rayon::current_num_threads(),
            os: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
        }
    }
}

/// A measure without its name, which is the key in the report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Reading {
    /// Value in `unit`; `None` if it could not be measured.
    pub value: Option<f64>,
    /// Unit, empty if dimensionless.
    pub unit: String,
    /// One standard uncertainty in `unit`, if known.
    pub uncertainty: Option<f64>,
    /// How it was measured.
    pub method: String,
    /// How it still moves, if by more than the uncertainty of its value at one time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub not_at_rest: Option<Motion>,
}

/// The motion of a measure at the end of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Its rate over the last fifth of the run.
    pub rate: f64,
    /// Unit of the rate.
    pub unit: String,
}

/// An expectation and its outcome.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Name of the measure.
    pub measure: String,
    /// Expected value in the measure's unit.
    pub value: f64,
    /// Largest accepted deviation, same unit.
    pub tolerance: f64,
    /// Measured value; `None` if it could not be measured.
    pub measured: Option<f64>,
    /// Whether it is within the tolerance; `None` if the run did not reach its end.
    pub pass: Option<bool>,
}

/// Wall time in s, of this process.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WallTime {
    /// From the start to the report.
    pub total: f64,
    /// By part, of the solver and of the output.
    pub parts: BTreeMap<&'static str, f64>,
}

/// Progress of a run on its clock.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Reached {
    /// The clock.
    #[serde(flatten)]
    pub clock: Clock,
    /// Its value, in the unit of the clock.
    pub value: f64,
}

/// The report of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub struct Report {
    /// Version of the program
    pub version: &'static str,
    /// How the run ended: `done`, `interrupted`, `failed` or `expectation-failed`
    pub status: Status,
    /// Error message, or `null`
    pub error: Option<String>,
    /// End of the run in s; `null` if its clock is not a time
    pub time_s: Option<f64>,
    /// Clock of the run: `name`, `symbol`, `unit` and final `value`
    pub clock: Reached,
    /// Number of steps since time zero
    pub steps: u64,
    /// With `[time.steady]`: `at-s` (`null` if never), `window-s`, and `quantities` with `column`, `mean`, `change`, `tolerance`
    pub steady: Option<Steadiness>,
    /// Measures by name: `value` or `null`, `unit`, `uncertainty`, `method`; `not-at-rest` with `rate` and `unit` for one that still changes
    pub measures: BTreeMap<String, Reading>,
    /// Expectations of the case: `measure`, `value`, `tolerance`, `measured`, `pass` (`null` before the end)
    pub expectations: Vec<Verdict>,
    /// Dimensionless numbers at the largest recorded speed, and of the inflow: `symbol`, `value`, `asked` where the case prescribes it, `formula`
    pub numbers: Vec<Number>,
    /// Characteristic length of the dimensionless numbers: `value` in m, `name`
    pub length_of_numbers: Length,
    /// Depth of the chip, or that all is per meter of depth; `null` for films
    pub depth: Option<String>,
    /// The case with every value, in SI units and radians
    pub case: Case,
    /// The complete case file, with all defaults, as TOML
    pub resolved_case: String,
    /// Machine: `cores`, `threads`, `os`
    pub machine: Machine,
    /// Wall time of the last process in s: `total`, and `parts` by name
    pub wall_time_s: WallTime,
    /// Processor time in s of all threads of all processes of the run, except for steps that a kill undid; `null` if it is not known
    pub cpu_s: Option<f64>,
    /// Limits that affect the measures
    pub warnings: Vec<String>,
    /// Solver in the last process: `unknowns`, `steps`, `wall-time-s` without output, further `counts`
    pub solver: SolverReport,
}

/// Statistics of the solver.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SolverReport {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Steps done by this process.
    pub steps: u64,
    /// Wall time of the solver's own parts in s, without output.
    #[serde(rename = "wall-time-s")]
    pub wall_time_s: f64,
    /// Further counters by name.
    pub counts: BTreeMap<&'static str, f64>,
}

impl From<&Statistics> for SolverReport {
    fn from(statistics: &Statistics) -> Self {
        Self {
            unknowns: statistics.unknowns,
            steps: statistics.steps,
            wall_time_s: statistics.parts.iter().map(|part| part.seconds).sum(),
            counts: statistics.counts.iter().copied().collect(),
        }
    }
}

/// Wall time by part, as in the report.
pub(crate) fn wall_time(total: f64, parts: impl Iterator<Item = PartTime>) -> WallTime {
    WallTime { total, parts: parts.map(|part| (part.part, part.seconds)).collect() }
}

/// Measures by name. The uncertainty of those that are also in the `series`, as one of the `watched` quantities or through a column that they follow, includes
/// their remaining drift.
pub(crate) fn readings(measures: Vec<Measure>, series: &Series, watched: &[Watched]) -> BTreeMap<String, Reading> {
    // Adding zero turns minus zero into zero.
    let finite = |value: f64| value.is_finite().then_some(value + 0.0);
    let has_one_angle = watched.iter().any(|one| one.kind.has_one_angle());
    measures
        .into_iter()
        .map(|m| {
            let at_one_time = m.uncertainty.and_then(finite);
            let column = m.name.replace('-', "_");
            let of_it = watched.iter().find(|one| one.column == column);
            let kind = of_it.map(|one| one.kind);
            let drift = match (of_it, m.moves_with) {
                (Some(one), _) => Drift::of_watched(series, *one, m.value),
                (None, Some(with)) => {
                    let drift = Drift::of(series, with.column).map(|drift| drift.times(with.factor));
                    let way = with.at_rest.filter(|_| has_one_angle).map_or(0.0, |at_rest| at_rest - m.value);
                    drift.map(|drift| drift.over(series, with.column, way / with.factor, way, m.value))
                }
                (None, None) => None,
            };
            let drift = drift.map(|drift| drift.beside(at_one_time.unwrap_or(f64::INFINITY)));
            let known = at_one_time.or(kind.and_then(Quantity::small));
            let of_motion = drift.map(|drift| at_one_time.unwrap_or(0.0).hypot(drift.left).hypot(drift.by_flow));
            let uncertainty = of_motion.and_then(finite).or(at_one_time);
            let moves = drift.filter(|drift| known.is_some_and(|known| drift.left > known));
            let not_at_rest = moves.map(|drift| Motion { rate: drift.rate, unit: format!("{}/s", m.unit) });
            (m.name, Reading { value: finite(m.value), unit: m.unit, uncertainty, method: m.method, not_at_rest })
        })
        .collect()
}

/// The measure of the time at which a run became steady.
pub const STEADY_AT: &str = "steady-at-s";

/// The time at which the run became steady, as a measure with its name.
pub(crate) fn steady_reading(steady: &Steadiness) -> (String, Reading) {
    let method = match (steady.at_s, steady.quantities.is_empty()) {
        (Some(_), _) => format!("first record that ends three windows of {:.3e} s without a change", steady.window_s),
        (None, true) => "the run was too short to decide: a window has too few records".to_owned(),
        (None, false) => format!("not steady by the end: {}", steady.unsettled()),
    };
    (
        STEADY_AT.to_owned(),
        Reading { value: steady.at_s, unit: "s".into(), uncertainty: None, method, not_at_rest: None },
    )
}

/// Each expectation with its measured value; a missing or NaN measure does not meet it.
pub(crate) fn verdicts(expectations: &[Expectation], readings: &BTreeMap<String, Reading>) -> Vec<Verdict> {
    expectations
        .iter()
        .map(|expected| {
            let measured = readings.get(&expected.measure).and_then(|reading| reading.value);
            let within = |value: f64| (value - expected.value).abs() <= expected.tolerance;
            Verdict {
                measure: expected.measure.clone(),
                value: expected.value,
                tolerance: expected.tolerance,
                measured,
                pass: Some(measured.is_some_and(within)),
            }
        })
        .collect()
}

/// Whether a folder has the report of a run that reached its end.
pub(crate) fn is_final(folder: &Path) -> bool {
    #[derive(Deserialize)]
    struct Ending {
        status: Status,
    }
    let ending = std::fs::read(folder.join(REPORT)).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    ending.is_some_and(|ending: Ending| matches!(ending.status, Status::Done | Status::ExpectationFailed))
}

impl Report {
    /// Writes `report.json` in `folder`.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), FileError> {
        let path = folder.join(REPORT);
        let text = serde_json::to_string_pretty(self)
            .map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
        atomic::write(&path, (text + "\n").as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_moves_with_the_column_of_its_length() {
        let rows = (0..=100).map(|i| f64::from(i) / 100.0).map(|t| vec![t, 2.0 - t]).collect();
        let series = Series { columns: vec!["time_s".into(), "base_m".into()], rows };
        let ratio = Measure {
            name: "base-ratio".into(),
            value: 4.0,
            unit: String::new(),
            uncertainty: Some(0.01),
            method: String::new(),
            moves_with: None,
        };
        let found = |measure: &Measure| readings(vec![measure.clone()], &series, &[]).remove("base-ratio").unwrap();
        assert_eq!(found(&ratio).not_at_rest, None);
        let moving = found(&ratio.clone().moving_with("base_m", 4.0));
        let motion = moving.not_at_rest.unwrap();
        assert!((motion.rate + 4.0).abs() < 1e-9 && moving.uncertainty.unwrap() > 1.0, "{motion:?}");
        assert_eq!(found(&ratio.clone().moving_with("no_such_column", 4.0)).uncertainty, Some(0.01));
        // Spreading is a power law: the whole way is left to a drop whose lines can rest at one angle only.
        let kind =
            |at_rest| Quantity::Angle { energy: "", length: "", tension: 1.0, at_rest: Some(at_rest), pins: false };
        let of = |at_rest: [f64; 2], end: f64| {
            let watched = [Watched { column: "contact_angle_deg", kind: kind(at_rest) }];
            let ratio = ratio.clone().moving_with("base_m", 4.0).resting_at(end);
            readings(vec![ratio], &series, &watched).remove("base-ratio").unwrap().uncertainty.unwrap()
        };
        assert!(of([60.0; 2], -50.0) > 54.0 && of([50.0, 60.0], -50.0) < 20.0, "{}", of([60.0; 2], -50.0));
        assert!(of([60.0; 2], 4.05) < 20.0, "a drop near its end");
    }
}
