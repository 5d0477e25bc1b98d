//! The axes with a distribution and the table `[sampling]`: combined into one axis with a row per run.

use nalgebra::DMatrix;
use toml::Value;

use super::design::{MOST_INPUTS, Matrix, Row, correlated, factor, plain, saltelli};
use super::distribution::Distribution;
use crate::study::axis::last_part;
use crate::study::definition::{Axis, Column, Input, MATRIX, SAMPLE, Sampling, Target};
use crate::study::raw::{RawAxis, RawCorrelation, RawSampling};
use meniscus_core::input::Checker;

/// Smallest and largest number of samples; the sequence has 65 536.
const COUNTS: std::ops::RangeInclusive<usize> = 2..=10_000;

/// Significant digits of a sampled value.
const DIGITS: usize = 9;

/// The axis of the samples.
pub(crate) struct SampledAxis {
    /// A row for each run.
    pub(crate) axis: Axis,
    /// Index in the file of the first axis that it replaces.
    pub(crate) axis_number: usize,
    /// The sampling.
    pub(crate) sampling: Sampling,
}

/// An uncertain value.
struct Uncertain {
    number: usize,
    name: String,
    keys: Vec<String>,
    distribution: Distribution,
}

/// Merges the axes with a distribution. The outer option is missing if a mistake was found, the inner one if no axis has a distribution.
pub(crate) fn sampled(
    checker: &mut Checker,
    axes: &[RawAxis],
    raw: Option<&RawSampling>,
) -> Option<Option<SampledAxis>> {
    let before = checker.problems.len();
    let with_distribution = axes.iter().enumerate().filter(|(_, axis)| axis.distribution.is_some());
    let inputs: Vec<Option<Uncertain>> =
        with_distribution.map(|(number, axis)| uncertain(checker, axis, number)).collect();
    let Some(raw) = raw else {
        if !inputs.is_empty() {
            checker.require::<()>("sampling", None, "[sampling] with count = 256");
            return None;
        }
        return Some(None);
    };
    if inputs.is_empty() {
        let help = "give an axis a `distribution` in place of `values`, or leave [sampling] out";
        checker.refuse("sampling", "there is nothing to sample: no axis has a distribution", help);
        return None;
    }
    let count = raw.count.filter(|count| {
        let is_right = COUNTS.contains(count);
        if !is_right {
            let message = format!("expected {} to {} samples, found {count}", COUNTS.start(), COUNTS.end());
            checker.refuse("sampling.count", message, "count = 256");
        }
        is_right
    });
    if inputs.len() > MOST_INPUTS {
        let message = format!("expected at most {MOST_INPUTS} axes with a distribution, found {}", inputs.len());
        checker.refuse("axis", message, "keep those that matter");
    }
    let inputs: Vec<Uncertain> = inputs.into_iter().collect::<Option<_>>()?;
    let indices = raw.indices.unwrap_or(false);
    let correlations = raw.correlation.as_deref().unwrap_or_default();
    let matrix = correlation(checker, correlations, &inputs);
    if indices && !correlations.is_empty() {
        checker.refuse(
            "sampling.indices",
            "Sobol indices share the variance among independent inputs, and these are correlated",
            "leave out `indices`, or the correlations",
        );
    }
    if checker.problems.len() > before {
        return None;
    }
    let (count, seed) = (count?, raw.seed.unwrap_or(1));
    let mut rows = if indices { saltelli(count, inputs.len(), seed) } else { plain(count, inputs.len(), seed) };
    if let Some(factor) = matrix? {
        rows.iter_mut().for_each(|(_, shares)| *shares = correlated(shares, &factor));
    }
    let axis_number = inputs[0].number;
    let axis = Axis { columns: columns(&inputs, &rows, indices) };
    let inputs = inputs.into_iter().map(|input| Input { name: input.name, keys: input.keys }).collect();
    let processes = raw.processes.unwrap_or(false);
    Some(Some(SampledAxis { axis, axis_number, sampling: Sampling { count, indices, processes, inputs } }))
}

fn uncertain(checker: &mut Checker, raw: &RawAxis, number: usize) -> Option<Uncertain> {
    let at = format!("axis[{number}]");
    let others = [
        ("values", raw.values.is_some()),
        ("range", raw.range.is_some()),
        ("pair", raw.pair.is_some()),
        ("table", raw.table.is_some()),
        ("columns", raw.columns.is_some()),
        ("cases", raw.cases.is_some()),
    ];
    let before = checker.problems.len();
    for (key, _) in others.into_iter().filter(|(_, given)| *given) {
        let message = format!("`distribution` and `{key}` are both given");
        checker.refuse(format!("{at}.{key}"), message, "keep one of them");
    }
    let key = checker.require(&format!("{at}.key"), raw.key.clone(), "key = \"network.interface.tension\"");
    let distribution = Distribution::of(checker, raw.distribution.as_ref()?, &format!("{at}.distribution"));
    let key = key.filter(|_| checker.problems.len() == before)?;
    let name = raw.name.clone().unwrap_or_else(|| last_part(&key));
    let keys = std::iter::once(key).chain(raw.also.iter().flatten().cloned()).collect();
    Some(Uncertain { number, name, keys, distribution: distribution? })
}

/// The factor of the correlation matrix; the inner option is missing if nothing is correlated.
fn correlation(checker: &mut Checker, raw: &[RawCorrelation], inputs: &[Uncertain]) -> Option<Option<DMatrix<f64>>> {
    if raw.is_empty() {
        return Some(None);
    }
    let before = checker.problems.len();
    let mut matrix = DMatrix::identity(inputs.len(), inputs.len());
    for (number, raw) in raw.iter().enumerate() {
        let at = format!("sampling.correlation[{number}]");
        let names = raw.axes.as_deref().unwrap_or_default();
        let known = || inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>().join(", ");
        let found: Vec<usize> =
            names.iter().filter_map(|name| inputs.iter().position(|input| input.name == *name)).collect();
        if let Some(lost) = names.iter().find(|name| inputs.iter().all(|input| input.name != **name)) {
            let message = format!("`{lost}` is not the name of an axis with a distribution");
            checker.refuse(format!("{at}.axes"), message, format!("those are: {}", known()));
            continue;
        }
        let [a, b] = found[..] else {
            let message = format!("expected the names of two axes, found {}", names.len());
            checker.refuse(format!("{at}.axes"), message, "axes = [\"angle\", \"tension\"]");
            continue;
        };
        if a == b || matrix[(a, b)] != 0.0 {
            let message = format!("the correlation of `{}` and `{}` is given already", names[0], names[1]);
            checker.refuse(format!("{at}.axes"), message, "name each pair of different axes once");
            continue;
        }
        let Some(value) = raw.value else { continue };
        matrix[(a, b)] = value;
        matrix[(b, a)] = value;
    }
    if checker.problems.len() > before {
        return None;
    }
    let factor = factor(matrix);
    if factor.is_none() {
        checker.refuse(
            "sampling.correlation",
            "the correlations contradict each other: their matrix is not positive definite",
            "take smaller ones: inputs strongly correlated with the same input are correlated with each other",
        );
    }
    factor.map(Some)
}

/// The columns of the axis: the indices of the rows, their roles, and the values.
fn columns(inputs: &[Uncertain], rows: &[Row], indices: bool) -> Vec<Column> {
    let of_sampling = |name: &str, values: Vec<Value>| Column {
        name: name.to_owned(),
        target: Target::Nothing,
        origins: vec!["sampling".to_owned(); values.len()],
        values,
    };
    let numbers = (1..=rows.len()).map(|number| Value::Integer(number as i64)).collect();
    let mut columns = vec![of_sampling(SAMPLE, numbers)];
    if indices {
        let word = |matrix: Matrix| match matrix {
            Matrix::A => "A".to_owned(),
            Matrix::B => "B".to_owned(),
            Matrix::Mixed(k) => format!("A-{}", inputs[k].name),
        };
        columns.push(of_sampling(MATRIX, rows.iter().map(|(matrix, _)| Value::String(word(*matrix))).collect()));
    }
    columns.extend(inputs.iter().enumerate().map(|(k, input)| Column {
        name: input.name.clone(),
        target: Target::Keys(input.keys.clone()),
        values: rows.iter().map(|(_, row)| Value::Float(rounded(input.distribution.quantile(row[k])))).collect(),
        origins: vec![format!("axis[{}].distribution", input.number); rows.len()],
    }));
    columns
}

/// The number to [`DIGITS`] digits, as in tables and in the keys of the case.
fn rounded(number: f64) -> f64 {
    format!("{number:.precision$e}", precision = DIGITS - 1).parse().unwrap_or(number)
}
