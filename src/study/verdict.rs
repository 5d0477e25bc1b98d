//! Whether the expectations of the study are met: measures within their tolerance, decreasing errors, orders.

use super::convergence::{Convergence, convergences};
use super::definition::{Expectation, Study, Trend};
use super::results::RunResult;
use super::values::shown;

/// The outcome of an expectation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// It is met.
    Met,
    /// It is missed.
    Missed,
    /// A required run is not complete.
    Open,
}

impl Verdict {
    /// The outcome in one word, for tables.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Met => "met",
            Self::Missed => "MISSED",
            Self::Open => "open",
        }
    }

    fn of(met: bool) -> Self {
        if met { Self::Met } else { Self::Missed }
    }
}

/// An expectation of the study and its outcome.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Judgment {
    /// The run or runs.
    pub(crate) of: String,
    /// Name of the measure.
    pub(crate) measure: String,
    /// The expected value.
    pub(crate) expected: String,
    /// The measured value.
    pub(crate) found: String,
    /// The verdict.
    pub(crate) verdict: Verdict,
}

/// All judgments of a study.
pub(crate) fn judgments(study: &Study, results: &[RunResult]) -> Vec<Judgment> {
    let single = study.expectations.iter().flat_map(|expected| {
        results.iter().filter(|result| result.run.is_in(&expected.only)).map(|result| judge(expected, result))
    });
    let trends = study.trends.iter().flat_map(|trend| {
        convergences(study, trend, results).into_iter().map(|convergence| judge_trend(trend, &convergence))
    });
    single.chain(trends).collect()
}

fn judge(expected: &Expectation, result: &RunResult) -> Judgment {
    let value = result.run.quantity(&expected.value);
    let tolerance = result.run.quantity(&expected.tolerance);
    let found = result.number(&expected.measure);
    let verdict = match (result.state.report(), found, value, tolerance) {
        (None, ..) => Verdict::Open,
        (_, Some(found), Some(value), Some(tolerance)) => Verdict::of((found - value).abs() <= tolerance),
        _ => Verdict::Missed,
    };
    // Numbers from the study file keep their digits.
    let number = |number: Option<f64>| number.map_or("?".to_owned(), |number| shown(&number.into()));
    Judgment {
        of: result.run.name.clone(),
        measure: expected.measure.clone(),
        expected: format!("{} ± {}", number(value), number(tolerance)),
        found: match (&verdict, found) {
            (Verdict::Open, _) => result.state.word().to_owned(),
            (_, Some(found)) => digits(found),
            (_, None) => "not measured".to_owned(),
        },
        verdict,
    }
}

fn judge_trend(trend: &Trend, convergence: &Convergence) -> Judgment {
    let order = convergence.order();
    let met = convergence.points.len() > 1
        && convergence.decreases()
        && trend.order.is_none_or(|least| order.map_or(convergence.is_at_floor(), |order| order >= least));
    let verdict = match (convergence.ended, convergence.complete) {
        (false, _) => Verdict::Open,
        (true, false) => Verdict::Missed,
        (true, true) => Verdict::of(met),
    };
    let errors: Vec<String> = convergence.points.iter().map(|(_, error)| digits(*error)).collect();
    let least = trend.order.map_or(String::new(), |least| format!(", order at least {least}"));
    let floor = if trend.floor > 0.0 { format!(", down to {}", shown(&trend.floor.into())) } else { String::new() };
    let observed = order.map_or(String::new(), |order| format!(", order {order:.2}"));
    let at_floor = if convergence.is_at_floor() { ", at its floor" } else { "" };
    Judgment {
        of: convergence.of.clone(),
        measure: trend.measure.clone(),
        expected: format!("error falls with {}{floor}{least}", trend.along),
        found: format!(
            "errors {}{observed}{at_floor}",
            if errors.is_empty() { "none".to_owned() } else { errors.join(", ") }
        ),
        verdict,
    }
}

/// A number with four significant digits; an integer as it is.
pub(crate) fn digits(number: f64) -> String {
    significant(number, 4)
}

/// A number with `digits` significant digits; an integer as it is.
pub(crate) fn significant(number: f64, digits: usize) -> String {
    /// Outside of this range, an exponent is shorter than zeros.
    const FIXED: std::ops::Range<f64> = 1.0e-3..1.0e5;
    let size = number.abs();
    let behind_first = digits.saturating_sub(1);
    if number.fract() == 0.0 && size < FIXED.end {
        format!("{number}")
    } else if FIXED.contains(&size) {
        let decimals = (behind_first as f64 - size.log10().floor()).max(0.0) as usize;
        format!("{number:.decimals$}")
    } else {
        format!("{number:.behind_first$e}")
    }
}

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, study};
    use super::*;

    #[test]
    fn an_expectation_of_a_run_that_is_not_complete_is_open_and_one_without_its_measure_is_missed() {
        let study = study(
            "[[axis]]\nkey = 'dx'\nvalues = [1, 2, 3]\n[[expect]]\nmeasure = 'm'\nvalue = 1.0\ntolerance = 0.5\n\
             [[trend]]\nmeasure = 'm'\nalong = 'dx'\n",
        );
        let mut results = complete(&study, |run| if run.index == 2 { f64::NAN } else { 1.25 });
        let verdicts = |results: &[RunResult]| judgments(&study, results).iter().map(|j| j.verdict).collect::<Vec<_>>();
        assert_eq!(verdicts(&results), [Verdict::Met, Verdict::Missed, Verdict::Met, Verdict::Missed]);
        results[0].state = super::super::results::RunState::Partial;
        assert_eq!(verdicts(&results), [Verdict::Open, Verdict::Missed, Verdict::Met, Verdict::Open]);
    }

    #[test]
    fn an_error_at_its_stated_floor_counts_as_converged_and_says_so() {
        let axis = "[[axis]]\nkey = 'dx'\nvalues = [4, 2, 1]\n[[trend]]\nmeasure = 'm'\nalong = 'dx'\n";
        let judged = |keys: &str, errors: [f64; 3]| {
            let study = study(&format!("{axis}{keys}"));
            let results = complete(&study, |run| errors[run.index - 1]);
            judgments(&study, &results).remove(0)
        };
        // Steps of first order, and then a floor due to other causes.
        let at_floor = judged("floor = 0.01\norder = 1.0\n", [0.05, 0.02, 0.005]);
        assert_eq!(at_floor.verdict, Verdict::Met);
        assert_eq!(at_floor.expected, "error falls with dx, down to 0.01, order at least 1");
        assert_eq!(at_floor.found, "errors 0.05000, 0.02000, 0.005000, order 1.32, at its floor");
        for (keys, errors, verdict) in [
            ("", [0.003, 0.005, 0.002], Verdict::Missed),
            ("floor = 0.01\n", [0.003, 0.005, 0.002], Verdict::Met),
            ("floor = 0.01\norder = 2.0\n", [0.003, 0.005, 0.002], Verdict::Met),
            // Above the floor the error must decrease, and with the required order.
            ("floor = 0.01\n", [0.003, 0.005, 0.02], Verdict::Missed),
            ("floor = 0.01\n", [0.02, 0.03, 0.005], Verdict::Missed),
            ("floor = 0.01\norder = 1.5\n", [0.05, 0.02, 0.005], Verdict::Missed),
        ] {
            let judged = judged(keys, errors);
            assert_eq!(judged.verdict, verdict, "{keys} {errors:?}: {}", judged.found);
        }
    }

    #[test]
    fn numbers_have_four_digits_and_whole_ones_are_left_as_they_are() {
        let found = [0.0, 20.0, 0.0061153, 41.23456, 12345.678, 2.0e-5, -0.5].map(digits);
        assert_eq!(found, ["0", "20", "0.006115", "41.23", "12346", "2.000e-5", "-0.5000"]);
        assert_eq!([0.7448, 12.34, 2.0e-5].map(|number| significant(number, 2)), ["0.74", "12", "2.0e-5"]);
    }
}
