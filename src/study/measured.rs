//! Whether the runs of a study have the measures that it names: in expectations and trends, curves, maps and the table.
//!
//! All runs must have a measure that is expected of them; for the report, one run is sufficient.

use super::definition::{Choice, Study};
use super::results::RUN_NUMBERS;
use super::run::PlannedRun;
use meniscus_case::measures::{offers, offers_of_comparison, unmeasured};
use meniscus_core::input::Problem;

/// Names of measures that the runs do not have, each with its location in the study file.
pub(super) fn problems(study: &Study, planned: &[PlannedRun]) -> Vec<Problem> {
    let names = Names { study, planned };
    let expected = study.expectations.iter().enumerate();
    let expected = expected.map(|(k, one)| names.of_each(format!("expect[{k}].measure"), &one.measure, &one.only));
    let trends = study.trends.iter().enumerate();
    let trends = trends.map(|(k, one)| names.of_each(format!("trend[{k}].measure"), &one.measure, &one.only));
    let curves = study.report.curves.iter().enumerate().flat_map(|(k, curve)| {
        [("x", &curve.x), ("y", &curve.y)].map(|(key, name)| names.of_some(format!("report.curve[{k}].{key}"), name))
    });
    let maps = study.report.maps.iter().enumerate();
    let maps = maps.map(|(k, map)| names.of_some(format!("report.map[{k}].measure"), &map.measure));
    let table = study.report.measures.iter().flatten().enumerate();
    let table = table.map(|(k, name)| names.of_some(format!("report.measures[{k}]"), name));
    expected.chain(trends).chain(curves).chain(maps).chain(table).flatten().collect()
}

/// What a study names of its measures.
pub(super) fn names(study: &Study) -> impl Iterator<Item = &str> {
    let table = study.report.measures.iter().flatten();
    let expected = study.expectations.iter().map(|one| &one.measure);
    let trends = study.trends.iter().map(|one| &one.measure);
    let curves = study.report.curves.iter().flat_map(|curve| [&curve.x, &curve.y]);
    let maps = study.report.maps.iter().map(|map| &map.measure);
    table.chain(expected).chain(trends).chain(curves).chain(maps).map(String::as_str)
}

struct Names<'a> {
    study: &'a Study,
    planned: &'a [PlannedRun],
}

impl Names<'_> {
    /// What is wrong with the name in one run; parameters and numbers of the run are not measures of its case.
    fn wrong(&self, name: &str, planned: &PlannedRun) -> Option<(String, String)> {
        let is_known = RUN_NUMBERS.contains(&name) || self.study.parameters().any(|column| column.name == name);
        let case = &planned.case;
        let offers = || match &planned.network {
            Some(_) => offers_of_comparison(),
            None => offers(&case.model, Some(&case.geometry), case.steady.is_some()),
        };
        if is_known { None } else { unmeasured(name, &offers()) }
    }

    /// The problem of a measure that one of the selected runs does not have.
    fn of_each(&self, path: String, name: &str, only: &Choice) -> Option<Problem> {
        let chosen: Vec<&PlannedRun> = self.planned.iter().filter(|planned| planned.run.is_in(only)).collect();
        let (run, (message, help)) = chosen.iter().find_map(|planned| Some((planned, self.wrong(name, planned)?)))?;
        if chosen.iter().all(|planned| self.wrong(name, planned).is_some()) {
            return Some(Problem::new(path, message, help));
        }
        let message = format!("{message}, that of run {} ({})", run.run.index, run.run.name);
        Some(Problem::new(path, message, format!("{help}; or choose runs with `where`")))
    }

    /// The problem of a measure that no run has.
    fn of_some(&self, path: String, name: &str) -> Option<Problem> {
        let mut wrong = None;
        for planned in self.planned {
            wrong = Some(self.wrong(name, planned)?);
        }
        wrong.map(|(message, help)| Problem::new(path, message, help))
    }
}
