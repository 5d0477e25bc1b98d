//! From a study file to a checked [`Study`]; the cases of its runs are checked by [`super::runs`].

use std::collections::BTreeMap;
use std::path::Path;

use super::axis::axis;
use super::definition::{Assignment, Axis, Column, ComparisonPlan, Expectation, Sampling, Study, Target, Trend};
use super::names::Names;
use super::raw::{RawComparison, RawStudy};
use super::results::RUN_NUMBERS;
use super::sampling::{SampledAxis, sampled};
use meniscus_case::{other_than_a_study, read};
use meniscus_core::input::{Checker, Document, InputError, Overrides};

/// Most runs of a study.
const MOST_RUNS: usize = 10_000;

/// Default number of compared states, as in `meniscus compare`.
const RECORDS: usize = 100;

/// Most compared states: each is kept in memory cell by cell.
const MOST_RECORDS: usize = 10_000;

/// Reserved column names of the table, besides the numbers of a run.
const TAKEN: [&str; 2] = ["run", "status"];

/// The JSON schema of a study file.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(RawStudy).to_value()
}

/// Loads and checks a study file.
///
/// # Errors
/// All mistakes of the file, or why it cannot be read.
pub fn load(path: &Path) -> Result<Study, InputError> {
    let text = read(path, "check the path of the study file")?;
    let document = Document::parse(&path.display().to_string(), &text, &Overrides::default())?;
    document.refuse(other_than_a_study(&text).into_iter().collect())?;
    let mut reading = document.read::<RawStudy>();
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut checker = Checker::default();
    let raw = &std::mem::take(&mut reading.value).in_range(&mut checker, "");
    checker.format(raw.format);
    let (axes, sampling) = read_axes(&mut checker, raw, folder);
    let all_axes = axes.iter().all(Option::is_some);
    let axes: Vec<Axis> = axes.into_iter().flatten().collect();
    check_axes(&mut checker, &axes);
    let cases = axes.iter().flat_map(|axis| &axis.columns).any(|column| matches!(column.target, Target::Case(_)));
    if raw.case.is_some() && cases {
        checker.refuse("case", "expected one source of base cases, found `case` and an axis with `cases`", "drop one");
    } else if raw.case.is_none() && !cases && all_axes {
        checker.require("case", raw.case.as_ref(), "case = \"../cases/sessile-drop.toml\"");
    }
    let compare = comparison(&mut checker, raw.compare.as_ref(), folder);
    let set = assignments(&mut checker, raw.set.as_deref().unwrap_or_default());
    check_keys(&mut checker, &axes, &set);
    // A parameter of an invalid axis would seem unknown.
    let names = Names { axes: &axes, sampling: sampling.as_ref(), complete: all_axes };
    let expectations = raw.expect.iter().flatten().enumerate();
    let expectations: Vec<Option<Expectation>> =
        expectations.map(|(index, raw)| names.expectation(&mut checker, raw, &format!("expect[{index}]"))).collect();
    let trends = raw.trend.iter().flatten().enumerate();
    let trends: Vec<Option<Trend>> =
        trends.map(|(index, raw)| names.trend(&mut checker, raw, &format!("trend[{index}]"))).collect();
    let report = names.report(&mut checker, raw.report.as_ref());
    let case = raw.case.as_ref().map(|case| folder.join(case));
    let mistakes = reading.refuse(checker.problems);
    let (Some(title), Some(expectations), Some(trends), Some(report), true) = (
        raw.title.clone(),
        expectations.into_iter().collect(),
        trends.into_iter().collect(),
        report,
        mistakes.is_empty() && all_axes,
    ) else {
        return Err(InputError { mistakes });
    };
    let name = path.file_stem().map_or_else(|| "study".to_owned(), |stem| stem.to_string_lossy().into_owned());
    Ok(Study { name, title, case, compare, set, axes, sampling, expectations, trends, report, document })
}

/// The axes, those with a distribution merged into one at the position of the first of them; `None` for each that has a mistake.
fn read_axes(checker: &mut Checker, raw: &RawStudy, folder: &Path) -> (Vec<Option<Axis>>, Option<Sampling>) {
    let written = raw.axis.as_deref().unwrap_or_default();
    let samples = sampled(checker, written, raw.sampling.as_ref());
    let (axis_number, mut samples, sampling) = match samples {
        Some(Some(SampledAxis { axis, axis_number, sampling })) => (Some(axis_number), Some(axis), Some(sampling)),
        Some(None) => (None, None, None),
        None => (written.iter().position(|raw| raw.distribution.is_some()), None, None),
    };
    let mut axes = Vec::new();
    for (index, raw) in written.iter().enumerate() {
        if raw.distribution.is_none() {
            axes.push(axis(checker, raw, index, folder));
        } else if Some(index) == axis_number {
            axes.push(samples.take());
        }
    }
    (axes, sampling)
}

/// The key path of the axis of a parameter: `axis[2]` of `axis[2].values[0]`.
fn axis_path(column: &Column) -> &str {
    let origin = column.origins.first().map_or("axis", String::as_str);
    origin.find(']').map_or(origin, |end| &origin[..=end])
}

/// The network of the comparison, if the file has one.
fn comparison(checker: &mut Checker, raw: Option<&RawComparison>, folder: &Path) -> Option<ComparisonPlan> {
    let raw = raw?;
    let records = raw.records.unwrap_or(RECORDS);
    if !(1..=MOST_RECORDS).contains(&records) {
        let message = format!("expected 1 to {MOST_RECORDS} records, found {records}");
        checker.refuse("compare.records", message, format!("{RECORDS} where it is left out"));
    }
    Some(ComparisonPlan { network: folder.join(raw.network.as_ref()?), records })
}

/// Refuses duplicate parameter names and too many runs.
fn check_axes(checker: &mut Checker, axes: &[Axis]) {
    let mut taken: BTreeMap<&str, &str> = BTreeMap::new();
    for column in axes.iter().flat_map(|axis| &axis.columns) {
        let at = axis_path(column);
        let name = column.name.as_str();
        let is_bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
        if !is_bare {
            checker.refuse(at, format!("`{name}` is not a name of a parameter"), "letters, digits, `-` and `_`");
        } else if TAKEN.contains(&name) || RUN_NUMBERS.contains(&name) {
            checker.refuse(at, format!("`{name}` is the name of a column of the report"), "give another `name`");
        } else if let Some(other) = taken.insert(name, at) {
            let help = "give one of them another `name`";
            checker.refuse(at, format!("two parameters are called `{name}`, the other one in {other}"), help);
        }
    }
    let runs = axes.iter().try_fold(1_usize, |runs, axis| runs.checked_mul(axis.len().max(1)));
    if runs.is_none_or(|runs| runs > MOST_RUNS) {
        let runs = runs.map_or("too many".to_owned(), |runs| runs.to_string());
        checker.refuse("axis", format!("expected at most {MOST_RUNS} runs, found {runs}"), "use shorter axes");
    }
}

/// Reads the fixed values, each with its location.
fn assignments(checker: &mut Checker, texts: &[String]) -> Vec<Assignment> {
    let mut all = Vec::new();
    for (index, text) in texts.iter().enumerate() {
        let origin = format!("set[{index}]");
        match Overrides::parse(&[text]) {
            Ok(_) => all.push(Assignment { text: text.clone(), origin }),
            Err(error) => error.mistakes.iter().for_each(|m| checker.refuse(&origin, m.message.clone(), m.help_text())),
        }
    }
    all
}

/// Refuses malformed key paths, and duplicate keys.
fn check_keys(checker: &mut Checker, axes: &[Axis], set: &[Assignment]) {
    let mut seen: Vec<&str> =
        set.iter().filter_map(|one| one.text.split_once('=')).map(|(key, _)| key.trim()).collect();
    for axis in axes {
        for column in &axis.columns {
            let Target::Keys(keys) = &column.target else { continue };
            let at = axis_path(column);
            for key in keys {
                if Overrides::parse(&[format!("{key}=0")]).is_err() {
                    checker.refuse(at, format!("`{key}` is not a key path"), "as in geometry.shapes[0].disc.radius");
                } else if seen.contains(&key.as_str()) {
                    checker.refuse(at, format!("`{key}` is set twice"), "keep it in one axis, or in `set`");
                }
                seen.push(key);
            }
        }
    }
}
