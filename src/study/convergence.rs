//! Errors along a parameter, usually a spacing, in runs that are otherwise equal, and their observed orders.

use super::definition::{Choice, Column, Study, Target, Trend};
use super::results::{RunResult, grouped};
use super::values::{same, shown};
use meniscus_geometry::analysis::convergence::observed_order;

/// Last part of a key that is a spacing.
const SPACING: &str = "spacing";

/// The error of a measure along a parameter, in runs that are otherwise equal.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Convergence {
    /// The runs: the values of the other parameters.
    pub(crate) of: String,
    /// Name of the measure.
    pub(crate) measure: String,
    /// Name of the parameter.
    pub(crate) along: String,
    /// Error that counts as converged: the floor given in the study, and at least the rounding error of the measure.
    pub(crate) floor: f64,
    /// Parameter and error of each complete run, from the largest parameter to the smallest.
    pub(crate) points: Vec<(f64, f64)>,
    /// Whether all its runs are complete and measured.
    pub(crate) complete: bool,
    /// Whether all its runs reached their end; a missing measure then misses the expectation.
    pub(crate) ended: bool,
}

impl Convergence {
    /// The observed order of the errors above the floor; `None` for fewer than two of them.
    pub(crate) fn order(&self) -> Option<f64> {
        let above = self.points.iter().copied().filter(|(_, error)| *error > self.floor);
        let (parameters, errors): (Vec<f64>, Vec<f64>) = above.unzip();
        Some(observed_order(&parameters, &errors)).filter(|order| errors.len() > 1 && order.is_finite())
    }

    /// Whether the error decreases from each point to the next, as far as it is above the floor.
    pub(crate) fn decreases(&self) -> bool {
        self.points.windows(2).all(|pair| pair[1].1 < pair[0].1 || pair[1].1 <= self.floor)
    }

    /// Whether the error has fallen to the floor.
    pub(crate) fn is_at_floor(&self) -> bool {
        self.floor > 0.0 && self.points.last().is_some_and(|(_, error)| *error <= self.floor)
    }

    /// The observed order as text: `at its floor` if too few errors are above it, `none` if there is none.
    pub(crate) fn order_text(&self) -> String {
        match self.order() {
            Some(order) => format!("{order:.2}"),
            None if self.is_at_floor() => "at its floor".to_owned(),
            None => "none".to_owned(),
        }
    }
}

/// The results in named groups of equal parameters, except for `along` and those that vary with it.
pub(crate) fn groups<'a>(
    study: &Study,
    along: &str,
    results: impl Iterator<Item = &'a RunResult>,
) -> Vec<(String, Vec<&'a RunResult>)> {
    // Parameters of its axis that depend on it do not distinguish runs.
    let follows = |column: &Column, from: &Column| {
        let pairs = || from.values.iter().zip(&column.values);
        pairs().all(|(x, y)| pairs().all(|(other, z)| !same(x, other) || same(y, z)))
    };
    let together: Vec<&str> = study
        .axes
        .iter()
        .filter_map(|axis| Some((axis, axis.columns.iter().find(|column| column.name == along)?)))
        .flat_map(|(axis, from)| axis.columns.iter().filter(move |column| follows(column, from)))
        .map(|column| column.name.as_str())
        .collect();
    grouped(results, |result| {
        let others = result.run.parameters.iter().filter(|p| !together.contains(&p.name.as_str()));
        others.map(|p| format!("{}={}", p.name, shown(&p.value))).collect::<Vec<_>>().join(" ")
    })
}

/// The spacing that varies, if one does.
pub(crate) fn spacing(study: &Study) -> Option<&Column> {
    let is_spacing = |target: &Target| match target {
        Target::Keys(keys) => keys.iter().any(|key| key.rsplit('.').next() == Some(SPACING)),
        _ => false,
    };
    study.parameters().find(|column| is_spacing(&column.target) && column.values.len() > 1)
}

/// The errors of a trend, one list per combination of the other parameters.
pub(crate) fn convergences(study: &Study, trend: &Trend, results: &[RunResult]) -> Vec<Convergence> {
    let groups = groups(study, &trend.along, results.iter().filter(|result| result.run.is_in(&trend.only)));
    let convergence = |(of, results): (String, Vec<&RunResult>)| {
        let point = |result: &&RunResult| {
            let reference = result.run.quantity(&trend.reference)?;
            Some((result.number(&trend.along)?, (result.number(&trend.measure)? - reference).abs()))
        };
        let mut points: Vec<(f64, f64)> = results.iter().filter_map(point).collect();
        let rounding =
            |result: &&RunResult| result.rounding(&trend.measure, result.run.quantity(&trend.reference).unwrap_or(0.0));
        let rounding = results.iter().map(rounding).fold(0.0, f64::max);
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
        Convergence {
            of: if of.is_empty() { "all runs".to_owned() } else { of },
            measure: trend.measure.clone(),
            along: trend.along.clone(),
            floor: trend.floor.max(rounding),
            complete: points.len() == results.len(),
            ended: results.iter().all(|result| result.state.report().is_some()),
            points,
        }
    };
    groups.into_iter().map(convergence).collect()
}

/// The errors of all trends; and if a spacing varies, of every measure with an expected value.
pub(crate) fn all(study: &Study, results: &[RunResult]) -> Vec<Convergence> {
    let spacing = spacing(study);
    let mut trends = study.trends.clone();
    for expected in &study.expectations {
        let Some(column) = spacing else { break };
        if !trends.iter().any(|trend| trend.measure == expected.measure && trend.along == column.name) {
            trends.push(Trend {
                measure: expected.measure.clone(),
                reference: expected.value.clone(),
                along: column.name.clone(),
                order: None,
                floor: 0.0,
                only: Choice::default(),
            });
        }
    }
    let found = trends.iter().flat_map(|trend| convergences(study, trend, results));
    found.filter(|convergence| convergence.points.len() > 1).collect()
}

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, number, study};
    use super::super::verdict::{Verdict, judgments};
    use super::*;

    #[test]
    fn errors_that_fall_with_the_spacing_have_their_order_per_group() {
        let study = study(
            "[[axis]]\nname = 'angle'\nkey = 'a'\nvalues = [30, 60]\n\
             [[axis]]\npair = [{ key = 'dx', values = [0.1, 0.4, 0.2] }, { name = 'n', values = [4, 1, 2] }]\n\
             [[trend]]\nmeasure = 'm'\nreference = 'angle'\nalong = 'dx'\norder = 1.9\n",
        );
        // Errors of second order at 30 degrees, of first order at 60.
        let results = complete(&study, |run| match number(run, "dx") {
            dx if number(run, "angle") == 30.0 => 30.0 - dx * dx,
            dx => 60.0 + dx,
        });
        let found = convergences(&study, &study.trends[0], &results);
        assert_eq!(found.iter().map(|c| c.of.as_str()).collect::<Vec<_>>(), ["angle=30", "angle=60"]);
        assert_eq!(found[0].points.iter().map(|point| point.0).collect::<Vec<_>>(), [0.4, 0.2, 0.1]);
        for (convergence, order) in found.iter().zip([2.0, 1.0]) {
            // Rounding of 30 - 0.01 leaves twelve digits of the error.
            assert!((convergence.order().unwrap() - order).abs() < 1.0e-9 && convergence.decreases());
        }
        let verdicts: Vec<Verdict> = judgments(&study, &results).iter().map(|judgment| judgment.verdict).collect();
        assert_eq!(verdicts, [Verdict::Met, Verdict::Missed]);
    }

    #[test]
    fn an_error_that_is_rounding_has_no_order() {
        let study = study(
            "[[axis]]\nname = 'dx'\nkey = 'sph.spacing'\nvalues = [4, 2, 1]\n\
             [[trend]]\nmeasure = 'm'\nreference = 40.0\nalong = 'dx'\norder = 1.0\n",
        );
        for rounding in [[3.0e-14, 1.0e-13, 2.0e-14], [1.0e-10, 4.0e-11, 1.0e-11], [0.0; 3]] {
            let results = complete(&study, |run| 40.0 + rounding[run.index - 1]);
            let found = convergences(&study, &study.trends[0], &results).remove(0);
            assert_eq!((found.order(), found.order_text().as_str()), (None, "at its floor"), "{found:?}");
            // A measure that is exact up to rounding has converged.
            assert_eq!(judgments(&study, &results)[0].verdict, Verdict::Met);
        }
        // Two errors and a rounding error: the order is that of the two.
        let results = complete(&study, |run| 40.0 + [1.0e-2, 2.5e-3, 1.0e-13][run.index - 1]);
        let found = convergences(&study, &study.trends[0], &results).remove(0);
        assert!((found.order().unwrap() - 2.0).abs() < 1.0e-6, "{found:?}");
    }

    #[test]
    fn where_a_spacing_varies_every_expected_measure_has_its_order() {
        let study = study(
            "[[axis]]\nname = 'dx'\nkey = 'sph.spacing'\nvalues = [0.4, 0.2]\n\
             [[expect]]\nmeasure = 'm'\nvalue = 1.0\ntolerance = 0.01\nwhere = { dx = 0.2 }\n",
        );
        let results = complete(&study, |run| 1.0 + number(run, "dx").powi(3));
        let found = all(&study, &results);
        assert_eq!(found.len(), 1);
        // Rounding of 1.008 leaves fourteen digits of the error.
        assert!((found[0].order().unwrap() - 3.0).abs() < 1.0e-9, "{found:?}");
        assert_eq!(all(&study, &results[..1]), []);
    }
}
