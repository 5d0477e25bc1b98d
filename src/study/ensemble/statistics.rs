//! Statistics of the samples of a study for each measure: moments, quantiles, Sobol indices, and their convergence with the number of samples.

use crate::analysis::samples::{deviation, mean, quantile, sobol_indices};
use crate::study::definition::{Input, Sampling, Study};
use crate::study::results::{RunResult, measures};
use crate::study::table::{Table, shown_measures};
use crate::study::verdict::digits;

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

/// Moments and quantiles of a measure.
struct Summary {
    group: String,
    measure: String,
    unit: String,
    count: usize,
    mean: f64,
    deviation: f64,
    quantiles: [f64; 5],
}

/// The statistics as tables: with all digits for programs, with four for readers.
#[derive(Debug)]
pub(crate) struct Statistics {
    /// `quantiles.csv`.
    pub(crate) quantiles: Table,
    /// `indices.csv`; `None` if not requested.
    pub(crate) indices: Option<Table>,
    /// `convergence.csv`.
    pub(crate) convergence: Table,
    /// The same for readers.
    pub(crate) short_convergence: Table,
    /// Quantiles for readers.
    pub(crate) short: Table,
    /// Indices for readers.
    pub(crate) short_indices: Option<Table>,
}

/// The groups of a study in the order of their first runs.
pub(crate) fn groups<'r>(study: &Study, results: &'r [RunResult]) -> Vec<Group<'r>> {
    let mut groups: Vec<Group> = Vec::new();
    for result in results {
        let name = result.run.name_of_group(study);
        match groups.iter_mut().find(|group| group.name == name) {
            Some(group) => group.results.push(result),
            None => groups.push(Group { name, results: vec![result] }),
        }
    }
    groups
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
pub(crate) fn statistics(study: &Study, results: &[RunResult]) -> Option<Statistics> {
    let sampling = study.sampling.as_ref()?;
    let groups = groups(study, results);
    let names = shown_measures(study, results);
    let units = measures(results);
    let mut summaries = Vec::new();
    for (group, measure) in groups.iter().flat_map(|group| names.iter().map(move |name| (group, name))) {
        let values = group.values(sampling, measure, sampling.count);
        if values.len() < 2 {
            continue;
        }
        summaries.push(Summary {
            group: group.name.clone(),
            measure: measure.clone(),
            unit: units.get(measure).cloned().unwrap_or_default(),
            count: values.len(),
            mean: mean(&values),
            deviation: deviation(&values),
            quantiles: SHARES.map(|probability| quantile(&values, probability)),
        });
    }
    let indices = sampling.indices.then(|| indices(sampling, &groups, &names, full));
    let short_indices = sampling.indices.then(|| indices_for_people(sampling, &groups, &names));
    Some(Statistics {
        quantiles: table(&summaries, full),
        short: table(&summaries, digits),
        indices,
        short_indices,
        convergence: convergence(sampling, &groups, &names, full),
        short_convergence: convergence(sampling, &groups, &names, digits),
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

fn indices_for_people(sampling: &Sampling, groups: &[Group], names: &[String]) -> Table {
    indices(sampling, groups, names, |number| format!("{number:.3}"))
}

/// The heads of a table with a first column for the group if there are several.
fn heads(groups: bool, heads: &[&str]) -> Vec<String> {
    groups.then_some("values").into_iter().chain(heads.iter().copied()).map(str::to_owned).collect()
}

/// A row of such a table.
fn row(groups: bool, group: &str, cells: Vec<String>) -> Vec<String> {
    groups.then(|| group.to_owned()).into_iter().chain(cells).collect()
}

fn table(summaries: &[Summary], number: fn(f64) -> String) -> Table {
    let groups = summaries.iter().any(|summary| !summary.group.is_empty());
    let columns = [&["measure", "unit", "samples", "mean", "standard-deviation"][..], &SHARE_HEADS].concat();
    let cells = |summary: &Summary| {
        let mut cells = vec![summary.measure.clone(), summary.unit.clone(), summary.count.to_string()];
        cells.extend([summary.mean, summary.deviation].into_iter().chain(summary.quantiles).map(number));
        row(groups, &summary.group, cells)
    };
    Table { heads: heads(groups, &columns), rows: summaries.iter().map(cells).collect() }
}

/// First-order and total indices of each measure that varies.
fn indices(sampling: &Sampling, groups: &[Group], names: &[String], number: fn(f64) -> String) -> Table {
    let several = groups.len() > 1;
    let mut rows = Vec::new();
    for (group, measure) in groups.iter().flat_map(|group| names.iter().map(move |name| (group, name))) {
        let Some(found) = group.indices(sampling, measure, sampling.count) else { continue };
        rows.extend(sampling.inputs.iter().zip(found).map(|(input, [first, total])| {
            row(several, &group.name, vec![measure.clone(), input.name.clone(), number(first), number(total)])
        }));
    }
    Table { heads: heads(several, &["measure", "input", "first-order", "total"]), rows }
}

/// The estimates from an eighth, a quarter, half and all of the samples.
fn convergence(sampling: &Sampling, groups: &[Group], names: &[String], number: fn(f64) -> String) -> Table {
    let several = groups.len() > 1;
    let mut columns = vec!["measure".to_owned(), "samples".to_owned()];
    columns.extend(["mean", "quantile-05", "quantile-95"].map(str::to_owned));
    if sampling.indices {
        let of = |input: &Input| ["first-order", "total"].map(|index| format!("{index}-{}", input.name));
        columns.extend(sampling.inputs.iter().flat_map(of));
    }
    let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
    let mut rows = Vec::new();
    for (group, measure) in groups.iter().flat_map(|group| names.iter().map(move |name| (group, name))) {
        for samples in PARTS.map(|part| sampling.count / part).into_iter().filter(|samples| *samples > 1) {
            let values = group.values(sampling, measure, samples);
            if values.len() < 2 {
                continue;
            }
            let mut cells = vec![measure.clone(), samples.to_string()];
            cells.extend([mean(&values), quantile(&values, SHARES[0]), quantile(&values, SHARES[4])].map(number));
            if sampling.indices {
                let found = group.indices(sampling, measure, samples);
                let none = || vec![[f64::NAN; 2]; sampling.inputs.len()];
                cells.extend(found.unwrap_or_else(none).into_iter().flatten().map(number));
            }
            rows.push(row(several, &group.name, cells));
        }
    }
    Table { heads: heads(several, &columns), rows }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::mock::{complete, study};

    const INPUTS: &str = "[sampling]\ncount = 512\nindices = true\n\
        [[axis]]\nkey = 'a'\ndistribution = { uniform = { from = 1.0, to = 2.0 } }\n\
        [[axis]]\nkey = 'b'\ndistribution = { uniform = { from = 1.0, to = 3.0 } }\n";

    /// [SaltelliEtAl2010; Jansen1999]
    #[test]
    fn indices_of_a_product_are_those_in_closed_form() {
        let study = study(INPUTS);
        let value = |run: &crate::study::run::Run, name: &str| run.value(name).and_then(toml::Value::as_float).unwrap();
        let results = complete(&study, |run| value(run, "a") * value(run, "b"));
        let found = statistics(&study, &results).unwrap();
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
        let found = statistics(&study, &results).unwrap();
        let cells: Vec<[&str; 3]> = found.quantiles.rows.iter().map(|row| [0, 1, 3].map(|k| row[k].as_str())).collect();
        assert_eq!(cells, [["c = 1", "m", "7"], ["c = 2", "m", "8"]]);
        assert!(found.indices.is_none());
    }
}
