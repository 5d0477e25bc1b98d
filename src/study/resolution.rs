//! Uncertainty of measures due to the spacing, from runs that are otherwise equal.

use std::collections::BTreeMap;

use super::convergence::{groups, spacing};
use super::definition::Study;
use super::results::{RUN_NUMBERS, RunResult, measures};
use crate::run::report::STEADY_AT;
use meniscus_geometry::analysis::convergence::discretization_uncertainties;

/// Suffixes of measures that are errors or counts themselves: their dependence on the spacing is not an uncertainty.
const ERRORS_AND_COUNTS: [&str; 7] =
    ["-error", "-drift", "-share", "-scatter-ratio", "-distance-ratio", "-pieces", "-blobs"];

/// Full names of such measures.
const OTHERS: [&str; 2] = [STEADY_AT, "parasitic-capillary-number"];

/// Standard uncertainties of the measures of runs due to the spacing.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Resolution {
    /// By measure and number of the run, in the unit of the measure.
    uncertainties: BTreeMap<String, BTreeMap<usize, f64>>,
}

impl Resolution {
    /// The uncertainties of all measures available at three or more spacings of a group.
    pub(crate) fn of(study: &Study, results: &[RunResult]) -> Self {
        let Some(column) = spacing(study) else { return Self::default() };
        let groups = groups(study, &column.name, results.iter());
        let of_measure = |name: &str| {
            let of_group = |runs: &Vec<&RunResult>| {
                let point = |run: &&RunResult| Some((run.number(&column.name)?, run.number(name)?, run.run.index));
                let mut points: Vec<(f64, f64, usize)> = runs.iter().filter_map(point).collect();
                points.sort_by(|a, b| b.0.total_cmp(&a.0));
                let are_apart = points.windows(2).all(|pair| pair[1].0 < pair[0].0);
                let (spacings, values): (Vec<f64>, Vec<f64>) = points.iter().map(|point| (point.0, point.1)).unzip();
                let found = discretization_uncertainties(&spacings, &values).filter(|_| are_apart).unwrap_or_default();
                points.into_iter().map(|point| point.2).zip(found).collect::<Vec<_>>()
            };
            groups
                .iter()
                .flat_map(|(_, runs)| of_group(runs))
                .filter(|(_, uncertainty)| uncertainty.is_finite())
                .collect()
        };
        let is_value = |name: &String| {
            let whole = RUN_NUMBERS.iter().chain(&OTHERS).any(|other| other == name);
            !whole && !ERRORS_AND_COUNTS.iter().any(|end| name.ends_with(end))
        };
        let names = measures(results).into_keys().filter(is_value);
        Self { uncertainties: names.map(|name| (name.clone(), of_measure(&name))).collect() }
    }

    /// Whether any run has one of this measure.
    pub(crate) fn has(&self, measure: &str) -> bool {
        self.uncertainties.get(measure).is_some_and(|runs| runs.values().any(|uncertainty| *uncertainty > 0.0))
    }

    /// The uncertainty of a measure of a run.
    pub(crate) fn uncertainty(&self, result: &RunResult, measure: &str) -> Option<f64> {
        self.uncertainties.get(measure)?.get(&result.run.index).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, number, study};
    use super::*;

    #[test]
    fn three_spacings_tell_an_uncertainty_for_each_group_of_runs() {
        let study = study(
            "[[axis]]\nname = 'angle'\nkey = 'a'\nvalues = [30, 60]\n\
             [[axis]]\nname = 'dx'\nkey = 'sph.spacing'\nvalues = [0.1, 0.4, 0.2]\n",
        );
        let results = complete(&study, |run| match number(run, "dx") {
            dx if number(run, "angle") == 30.0 => 30.0 - dx,
            dx => 60.0 + dx.powi(2),
        });
        let resolution = Resolution::of(&study, &results);
        for result in &results {
            let dx = number(&result.run, "dx");
            let error = if result.run.index <= 3 { dx } else { dx.powi(2) };
            let found = resolution.uncertainty(result, "m").unwrap();
            assert!((found / error - 0.625).abs() < 1e-9, "{found} and {error}");
        }
        assert!(resolution.has("m") && !resolution.has("steps"));
    }

    #[test]
    fn runs_of_another_kind_at_one_of_the_spacings_are_left_out() {
        let study = study(
            "[[axis]]\npair = [{ name = 'omega', key = 'a', values = [1, 1, 1, 10] }, \
             { name = 'dx', key = 'sph.spacing', values = [0.4, 0.2, 0.1, 0.4] }, { name = 'n', values = [1, 2, 4, 1] }]\n",
        );
        let results = complete(&study, |run| 1.0 + number(run, "dx"));
        let resolution = Resolution::of(&study, &results);
        let found = results.iter().map(|result| resolution.uncertainty(result, "m"));
        assert_eq!(found.map(|uncertainty| uncertainty.is_some()).collect::<Vec<_>>(), [true, true, true, false]);
    }

    #[test]
    fn two_spacings_or_none_tell_nothing() {
        for values in ["name = 'dx'\nkey = 'sph.spacing'\nvalues = [0.1, 0.4]", "key = 'a'\nvalues = [1, 2, 3]"] {
            let study = study(&format!("[[axis]]\n{values}\n"));
            let results = complete(&study, |run| run.index as f64);
            assert!(!Resolution::of(&study, &results).has("m"));
        }
    }
}
