//! Distributions of one uncertain value, by their quantiles (`statrs`).

use statrs::distribution::{ContinuousCDF, LogNormal, Normal, Triangular, Uniform};

use crate::study::raw::{RawDistribution, RawLognormal, RawNormal, RawTriangular, RawUniform};
use meniscus_core::input::Checker;

/// A distribution with a finite quantile at every probability between 0 and 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Distribution {
    /// A normal distribution, truncated at these two cumulative probabilities.
    Normal(Normal, [f64; 2]),
    Lognormal(LogNormal),
    Uniform(Uniform),
    Triangular(Triangular),
}

/// Smallest probability of a normal distribution between its truncation bounds.
const LEAST_LEFT: f64 = 1e-6;

impl Distribution {
    /// The distribution at the key path `at`; `None` if a mistake was found.
    pub(super) fn of(checker: &mut Checker, raw: &RawDistribution, at: &str) -> Option<Self> {
        let given = [
            ("normal", raw.normal.is_some()),
            ("lognormal", raw.lognormal.is_some()),
            ("uniform", raw.uniform.is_some()),
            ("triangular", raw.triangular.is_some()),
        ];
        let names: Vec<&str> = given.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
        match raw {
            _ if names.len() != 1 => {
                let found = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
                checker.refuse(
                    at,
                    format!("expected one of `normal`, `lognormal`, `uniform` and `triangular`, found {found}"),
                    "distribution = { normal = { mean = 40.0, deviation = 5.0 } }",
                );
                None
            }
            RawDistribution { normal: Some(raw), .. } => normal(checker, raw, &format!("{at}.normal")),
            RawDistribution { lognormal: Some(RawLognormal { median, geometric_deviation }), .. } => {
                LogNormal::new((*median)?.ln(), (*geometric_deviation)?.ln()).ok().map(Self::Lognormal)
            }
            RawDistribution { uniform: Some(RawUniform { from, to }), .. } => {
                let (from, to) = ends(checker, [*from, *to], &format!("{at}.uniform"), "to")?;
                Uniform::new(from, to).ok().map(Self::Uniform)
            }
            RawDistribution { triangular: Some(RawTriangular { from, mode, to }), .. } => {
                let at = format!("{at}.triangular");
                let (from, to) = ends(checker, [*from, *to], &at, "to")?;
                let mode = (*mode)?;
                if !(from..=to).contains(&mode) {
                    let message = format!("the mode {mode:?} does not lie between {from:?} and {to:?}");
                    checker.refuse(format!("{at}.mode"), message, "the most likely value is one of the range");
                    return None;
                }
                Triangular::new(from, to, mode).ok().map(Self::Triangular)
            }
            _ => None,
        }
    }

    /// The quantile at `probability`, between 0 and 1.
    pub(super) fn quantile(&self, probability: f64) -> f64 {
        match self {
            Self::Normal(normal, [low, high]) => normal.inverse_cdf(low + (high - low) * probability),
            Self::Lognormal(lognormal) => lognormal.inverse_cdf(probability),
            Self::Uniform(uniform) => uniform.inverse_cdf(probability),
            Self::Triangular(triangular) => triangular.inverse_cdf(probability),
        }
    }
}

/// Two bounds, the first one the smaller; `key` is the name of the second one.
fn ends(checker: &mut Checker, [from, to]: [Option<f64>; 2], at: &str, key: &str) -> Option<(f64, f64)> {
    let (from, to) = (from?, to?);
    if !(from.is_finite() && to.is_finite() && from < to) {
        let message = format!("expected a number above {from:?}, found {to:?}");
        checker.refuse(
            format!("{at}.{key}"),
            message,
            "give the smaller one first; an exact value needs no distribution",
        );
        return None;
    }
    Some((from, to))
}

fn normal(checker: &mut Checker, raw: &RawNormal, at: &str) -> Option<Distribution> {
    let (mean, deviation) = (raw.mean?, raw.deviation?);
    let normal = Normal::new(mean, deviation).ok()?;
    if raw.at_least.is_some() && raw.at_most.is_some() {
        ends(checker, [raw.at_least, raw.at_most], at, "at-most")?;
    }
    let share = |end: Option<f64>, none: f64| end.map_or(none, |end| normal.cdf(end));
    let shares = [share(raw.at_least, 0.0), share(raw.at_most, 1.0)];
    if !(shares[1] - shares[0] > LEAST_LEFT) {
        let key = if raw.at_least.is_some() { "at-least" } else { "at-most" };
        let message = format!("less than {LEAST_LEFT:e} of the distribution is left");
        checker.refuse(format!("{at}.{key}"), message, "move the ends nearer to the mean, or the mean between them");
        return None;
    }
    Some(Distribution::Normal(normal, shares))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean and standard deviation by the midpoint rule over probabilities.
    fn moments(distribution: &Distribution) -> [f64; 2] {
        const COUNT: u32 = 1 << 16;
        let values: Vec<f64> =
            (0..COUNT).map(|k| distribution.quantile((f64::from(k) + 0.5) / f64::from(COUNT))).collect();
        let mean = values.iter().sum::<f64>() / f64::from(COUNT);
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / f64::from(COUNT);
        [mean, variance.sqrt()]
    }

    fn read(text: &str) -> Result<Distribution, String> {
        let raw: RawDistribution = toml::from_str(text).unwrap();
        let mut checker = Checker::default();
        let raw = raw.in_range(&mut checker, "d");
        let found = Distribution::of(&mut checker, &raw, "d");
        found.filter(|_| checker.problems.is_empty()).ok_or_else(|| checker.problems[0].message.clone())
    }

    #[test]
    fn moments_are_those_of_the_formulas() {
        let close = |text: &str, expected: [f64; 2]| {
            let found = moments(&read(text).unwrap());
            let near = (0..2).all(|k| (found[k] - expected[k]).abs() < 1e-3 * expected[1]);
            assert!(near, "{text}: {found:?}, expected {expected:?}");
        };
        close("normal = { mean = 40.0, deviation = 5.0 }", [40.0, 5.0]);
        close("uniform = { from = 1.0, to = 4.0 }", [2.5, 3.0 / 12.0_f64.sqrt()]);
        // (a + b + c)/3 and the root of (a² + b² + c² - ab - ac - bc)/18.
        close("triangular = { from = 0.0, mode = 1.0, to = 5.0 }", [2.0, (21.0_f64 / 18.0).sqrt()]);
        // exp(s²/2) and that times the root of exp(s²) - 1.
        let s = 1.2_f64.ln();
        let mean = (0.5 * s * s).exp();
        close("lognormal = { median = 1.0, geometric-deviation = 1.2 }", [mean, mean * ((s * s).exp() - 1.0).sqrt()]);
        // Half of a normal distribution: the root of 2/pi, and that of 1 - 2/pi.
        let half = std::f64::consts::FRAC_2_PI;
        close("normal = { mean = 0.0, deviation = 1.0, at-least = 0.0 }", [half.sqrt(), (1.0 - half).sqrt()]);
    }

    #[test]
    fn what_is_no_distribution_is_told() {
        for (text, message) in [
            ("normal = { mean = 1.0, deviation = 0.0 }", "expected a standard deviation above 0, found 0.0"),
            ("uniform = { from = 2.0, to = 1.0 }", "expected a number above 2.0, found 1.0"),
            ("triangular = { from = 1.0, mode = 3.0, to = 2.0 }", "the mode 3.0 does not lie between 1.0 and 2.0"),
            ("normal = { mean = 1.0, deviation = 0.1, at-least = 3.0 }", "less than 1e-6 of the distribution is left"),
            ("", "expected one of `normal`, `lognormal`, `uniform` and `triangular`, found none"),
        ] {
            assert_eq!(read(text).unwrap_err(), message, "{text}");
        }
    }
}
