//! Statistics of the samples of a study for each measure: moments, quantiles, Sobol indices, and their convergence with the number of samples.

use std::collections::BTreeMap;

use crate::study::definition::{Input, Sampling, Study};
use crate::study::results::{RunResult, grouped, measures};
use crate::study::table::{Table, shown_measures};
use crate::study::verdict::digits;
use meniscus_geometry::analysis::samples::{deviation, mean, quantile, sobol_indices};

/// Probabilities of the quantiles in tables.
pub(crate) const SHARES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// The corresponding column heads.
pub(crate) const SHARE_HEADS: [&str; 5] = ["quantile-05", "quantile-25", "quantile-50", "quantile-75", "quantile-95"];

/// Divisors of the number of samples at which estimates are listed.
const PARTS: [usize; 4] = [8, 4, 2, 1];

/// Samples with the same values along the other axes.
pub(crate) struct Group<'r> {
    /// These values; empty if there are no other axes.
    pub(crate) name: String,
    /// Its runs, those of a sample together.
    pub(crate) results: Vec<&'r RunResult>,
}

/// The statistics as tables.
#[derive(Debug)]
pub(crate) struct Statistics {
    /// Moments and quantiles of each measure: `quantiles.csv`.
    pub(crate) quantiles: Table,
    /// Sobol indices: `indices.csv`; `None` if not requested.
    pub(crate) indices: Option<Table>,
    /// Estimates from parts of the samples: `convergence.csv`.
    pub(crate) convergence: Table,
}

/// How numbers are written, and how indices are.
#[derive(Clone, Copy)]
pub(crate) struct Style {
    number: fn(f64) -> String,
    index: fn(f64) -> String,
}

/// All digits, for programs.
pub(crate) const FULL: Style = Style { number: full, index: full };
/// For readers.
pub(crate) const SHORT: Style = Style { number: digits, index: |number| format!("{number:.3}") };

/// The groups of a study in the order of their first runs.
pub(crate) fn groups<'r>(study: &Study, results: &'r [RunResult]) -> Vec<Group<'r>> {
    let found = grouped(results.iter(), |result| result.run.name_of_group(study));
    found.into_iter().map(|(name, results)| Group { name, results }).collect()
}

impl<'r> Group<'r> {
    /// The independent draws of all inputs among the first samples.
    pub(crate) fn draws(&self, sampling: &Sampling, samples: usize) -> impl Iterator<Item = &'r RunResult> {
        let draws = sampling.draws();
        self.results.chunks(sampling.rows()).take(samples).flat_map(move |sample| sample.iter().take(draws).copied())
    }

    /// The ascending values of a measure in these draws, if it has one.
    pub(crate) fn values(&self, sampling: &Sampling, measure: &str, samples: usize) -> Vec<f64> {
        let mut values: Vec<f64> = self
            .draws(sampling, samples)
            .filter_map(|result| result.number(measure))
            .filter(|it| it.is_finite())
            // Adding zero turns minus zero into zero.
            .map(|number| number + 0.0)
            .collect();
        values.sort_by(f64::total_cmp);
        values
    }

    /// The indices of each input for a measure, from the first complete samples; `None` if nothing varies.
    fn indices(&self, sampling: &Sampling, measure: &str, samples: usize) -> Option<Vec<[f64; 2]>> {
        let rows = sampling.rows();
        let complete = self.results.chunks(rows).take(samples).filter_map(|sample| {
            let numbers = sample.iter().map(|result| result.number(measure).filter(|number| number.is_finite()));
            numbers.collect::<Option<Vec<f64>>>().filter(|numbers| numbers.len() == rows)
        });
        let complete: Vec<Vec<f64>> = complete.collect();
        let column = |row: usize| complete.iter().map(|numbers| numbers[row]).collect::<Vec<f64>>();
        let mixed: Vec<Vec<f64>> = (2..rows).map(column).collect();
        if complete.len() < 2 { None } else { sobol_indices(&column(0), &column(1), &mixed) }
    }
}

/// The statistics of the complete runs; `None` if nothing is sampled.
pub(crate) fn statistics(study: &Study, results: &[RunResult], style: Style) -> Option<Statistics> {
    let sampling = study.sampling.as_ref()?;
    let groups = groups(study, results);
    let names = shown_measures(study, results);
    let measured = Measured {
        sampling,
        several: groups.len() > 1,
        all: groups.iter().flat_map(|group| names.iter().map(move |name| (group, name))).collect(),
        style,
    };
    Some(Statistics {
        quantiles: measured.quantiles(&measures(results)),
        indices: sampling.indices.then(|| measured.indices()),
        convergence: measured.convergence(),
    })
}

/// All digits of a number.
pub(crate) fn full(number: f64) -> String {
    match number {
        _ if !number.is_finite() => String::new(),
        _ if number.fract() == 0.0 => format!("{number}"),
        _ => format!("{number:?}"),
    }
}

/// The heads of a table with a first column for the group if there are several.
fn heads(groups: bool, heads: &[&str]) -> Vec<String> {
    groups.then_some("values").into_iter().chain(heads.iter().copied()).map(str::to_owned).collect()
}

/// A row of such a table.
fn row(groups: bool, group: &str, cells: Vec<String>) -> Vec<String> {
    groups.then(|| group.to_owned()).into_iter().chain(cells).collect()
}

/// The measures of each group.
struct Measured<'a> {
    sampling: &'a Sampling,
    /// Whether there are several groups.
    several: bool,
    all: Vec<(&'a Group<'a>, &'a String)>,
    style: Style,
}

impl Measured<'_> {
    /// Moments and quantiles of each measure with at least two values.
    fn quantiles(&self, units: &BTreeMap<String, String>) -> Table {
        let columns = [&["measure", "unit", "samples", "mean", "standard-deviation"][..], &SHARE_HEADS].concat();
        let values = self.all.iter().map(|&(group, name)| {
            let values = group.values(self.sampling, name, self.sampling.count);
            (group, name, values)
        });
        let found: Vec<_> = values.filter(|(.., values)| values.len() > 1).collect();
        let groups = found.iter().any(|(group, ..)| !group.name.is_empty());
        let cells = |(group, name, values): &(&Group, &String, Vec<f64>)| {
            let unit = units.get(*name).cloned().unwrap_or_default();
            let mut cells = vec![(*name).clone(), unit, values.len().to_string()];
            let quantiles = SHARES.map(|probability| quantile(values, probability));
            cells.extend([mean(values), deviation(values)].into_iter().chain(quantiles).map(self.style.number));
            row(groups, &group.name, cells)
        };
        Table { heads: heads(groups, &columns), rows: found.iter().map(cells).collect() }
    }

    /// First-order and total indices of each measure that varies.
    fn indices(&self) -> Table {
        let mut rows = Vec::new();
        for (group, name) in &self.all {
            let Some(found) = group.indices(self.sampling, name, self.sampling.count) else { continue };
            rows.extend(self.sampling.inputs.iter().zip(found).map(|(input, indices)| {
                let [first, total] = indices.map(self.style.index);
                row(self.several, &group.name, vec![(*name).clone(), input.name.clone(), first, total])
            }));
        }
        Table { heads: heads(self.several, &["measure", "input", "first-order", "total"]), rows }
    }

    /// The estimates from an eighth, a quarter, half and all of the samples.
    fn convergence(&self) -> Table {
        let Self { sampling, several, style: Style { number, .. }, .. } = *self;
        let mut columns = ["measure", "samples", "mean", "quantile-05", "quantile-95"].map(str::to_owned).to_vec();
        if sampling.indices {
            let of = |input: &Input| ["first-order", "total"].map(|index| format!("{index}-{}", input.name));
            columns.extend(sampling.inputs.iter().flat_map(of));
        }
        let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
        let mut rows = Vec::new();
        for (group, name) in &self.all {
            for samples in PARTS.map(|part| sampling.count / part).into_iter().filter(|samples| *samples > 1) {
                let values = group.values(sampling, name, samples);
                if values.len() < 2 {
                    continue;
                }
                let mut cells = vec![(*name).clone(), samples.to_string()];
                cells.extend([mean(&values), quantile(&values, SHARES[0]), quantile(&values, SHARES[4])].map(number));
                if sampling.indices {
                    let found = group.indices(sampling, name, samples);
                    let none = || vec![[f64::NAN; 2]; sampling.inputs.len()];
                    cells.extend(found.unwrap_or_else(none).into_iter().flatten().map(number));
                }
                rows.push(row(several, &group.name, cells));
            }
        }
        Table { heads: heads(several, &columns), rows }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::mock::{complete, number, study};

    const INPUTS: &str = "[sampling]\ncount = 512\nindices = true\n\
        [[axis]]\nkey = 'a'\ndistribution = { uniform = { from = 1.0, to = 2.0 } }\n\
        [[axis]]\nkey = 'b'\ndistribution = { uniform = { from = 1.0, to = 3.0 } }\n";

    /// [SaltelliEtAl2010; Jansen1999]
    #[test]
    fn indices_of_a_product_are_those_in_closed_form() {
        let study = study(INPUTS);
        let results = complete(&study, |run| number(run, "a") * number(run, "b"));
        let found = statistics(&study, &results, FULL).unwrap();
        // For uniform factors: means 1.5 and 2, variances 1/12 and 1/3.
        let ([m, n], [v, w]) = ([1.5, 2.0], [1.0 / 12.0, 1.0 / 3.0]);
        let all = (v + m * m) * (w + n * n) - m * m * n * n;
        let expected = [[v * n * n / all, v * (w + n * n) / all], [w * m * m / all, w * (v + m * m) / all]];
        let rows = found.indices.unwrap().rows;
        assert_eq!(rows.len(), 2);
        for (row, expected) in rows.iter().zip(expected) {
            for (found, expected) in row[2..].iter().zip(expected) {
                let found: f64 = found.parse().unwrap();
                assert!((found - expected).abs() < 0.01, "{row:?}, expected {expected}");
            }
        }
        // Both independent samples count: 1024 draws.
        assert_eq!(found.quantiles.rows[0][..3], ["m", "deg", "1024"]);
        let mean: f64 = found.quantiles.rows[0][3].parse().unwrap();
        assert!((mean - m * n).abs() < 2e-3, "{mean}");
        let samples: Vec<&str> = found.convergence.rows.iter().map(|row| row[1].as_str()).collect();
        assert_eq!(samples, ["64", "128", "256", "512"]);
    }

    #[test]
    fn samples_without_a_value_are_left_out_and_other_axes_make_groups() {
        let text = "[sampling]\ncount = 8\n[[axis]]\nkey = 'c'\nvalues = [1, 2]\n\
            [[axis]]\nkey = 'a'\ndistribution = { uniform = { from = 1.0, to = 2.0 } }\n";
        let study = study(text);
        let results = complete(&study, |run| if run.index == 1 { f64::NAN } else { run.index as f64 });
        let found = statistics(&study, &results, FULL).unwrap();
        let cells: Vec<[&str; 3]> = found.quantiles.rows.iter().map(|row| [0, 1, 3].map(|k| row[k].as_str())).collect();
        assert_eq!(cells, [["c = 1", "m", "7"], ["c = 2", "m", "8"]]);
        assert!(found.indices.is_none());
    }
}
