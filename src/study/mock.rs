//! A study without a case and results without runs, for tests.

use super::definition::Study;
use super::load::load;
use super::results::{RunReport, RunResult, RunState, Total, Unknowns};
use super::run::Run;
use super::runs::runs;
use super::values::number_of;
use crate::run::report::{Motion, Reading, Status};

/// A study with these axes, expectations and curves.
pub(crate) fn study(text: &str) -> Study {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mock.toml");
    std::fs::write(&path, format!("format = 1\ntitle = \"Mock\"\ncase = \"none.toml\"\n{text}")).unwrap();
    load(&path).unwrap_or_else(|error| panic!("{}", error.render()))
}

/// Gives the measure `m` of a complete run a rate of change in degrees per s.
pub(crate) fn set_moving(result: &mut RunResult, rate: f64) {
    let RunState::Complete(report) = &mut result.state else { panic!("complete") };
    report.measures.get_mut("m").unwrap().not_at_rest = Some(Motion { rate, unit: "deg/s".into() });
}

/// The number of a parameter in a run.
pub(crate) fn number(run: &Run, name: &str) -> f64 {
    run.value(name).and_then(number_of).unwrap()
}

/// Complete runs with the measure `m` in degrees given by `value`, with an uncertainty of 0.1; NaN is not measured.
pub(crate) fn complete(study: &Study, value: impl Fn(&Run) -> f64) -> Vec<RunResult> {
    let result = |run: Run| {
        let value = Some(value(&run)).filter(|value| value.is_finite());
        let reading =
            Reading { value, unit: "deg".into(), uncertainty: Some(0.1), method: String::new(), not_at_rest: None };
        let report = RunReport {
            status: Status::Done,
            error: None,
            steps: 10,
            measures: [("m".to_owned(), reading)].into(),
            resolved_case: String::new(),
            wall_time_s: Total { total: 1.5 },
            cpu_s: None,
            solver: Unknowns { unknowns: 100, wall_time_s: Some(1.25) },
        };
        RunResult { run, state: RunState::Complete(Box::new(report)) }
    };
    runs(study).into_iter().map(result).collect()
}
