//! From a study file to a checked [`Study`]; the cases of its runs are checked by [`super::runs`].

use std::collections::BTreeMap;
use std::path::Path;

use toml::Value;

use super::axis::axis;
use super::definition::{Assignment, Axis, Choice, Curve, Expectation, Quantity, ReportPlan, Study, Target, Trend};
use super::raw::{RawCurve, RawExpectation, RawReport, RawStudy, RawTrend};
use crate::case::{Checker, read};
use crate::input::{Document, InputError, Overrides, nearest};

/// Most runs of a study.
const MOST_RUNS: usize = 10_000;


/// Names of columns that a parameter must not have.
const TAKEN: [&str; 5] = ["run", "status", "steps", "unknowns", "wall-time-s"];

/// Loads and checks a study file.
///
/// # Errors
/// All mistakes of the file, or why it cannot be read.
pub fn load(path: &Path) -> Result<Study, InputError> {
    let text = read(path, "check the path of the study file")?;
    let document = Document::parse(&path.display().to_string(), &text, &Overrides::default())?;
    let reading = document.read::<RawStudy>();
    let raw = &reading.value;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut checker = Checker::default();
    checker.format(raw.format);
    let title = checker.require("title", raw.title.clone(), "title = \"what the study shows\"");
    let axes: Vec<Option<Axis>> =
        raw.axis.iter().flatten().enumerate().map(|(index, raw)| axis(&mut checker, raw, index, folder)).collect();
    let all_axes = axes.iter().all(Option::is_some);
    let axes: Vec<Axis> = axes.into_iter().flatten().collect();
    check_axes(&mut checker, &axes);
    let cases = axes.iter().flat_map(|axis| &axis.columns).any(|column| matches!(column.target, Target::Case(_)));
    if raw.case.is_some() && cases {
        checker.refuse("case", "expected one source of base cases, found `case` and an axis with `cases`", "drop one");
    } else if raw.case.is_none() && !cases && all_axes {
        checker.require("case", raw.case.as_ref(), "case = \"../cases/sessile-drop.toml\"");
    }
    let set = assignments(&mut checker, raw.set.as_deref().unwrap_or_default());
    check_keys(&mut checker, &axes, &set);
    // A parameter of an axis that is wrong would seem unknown.
    let names = Names { axes: &axes, complete: all_axes };
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
        title,
        expectations.into_iter().collect(),
        trends.into_iter().collect(),
        report,
        mistakes.is_empty() && all_axes,
    ) else {
        return Err(InputError { mistakes });
    };
    let name = path.file_stem().map_or_else(|| "study".to_owned(), |stem| stem.to_string_lossy().into_owned());
    Ok(Study { name, title, case, set, axes, expectations, trends, report, document })
}

/// Refuses parameters of one name and too many runs.
fn check_axes(checker: &mut Checker, axes: &[Axis]) {
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, column) in
        axes.iter().enumerate().flat_map(|(index, axis)| axis.columns.iter().map(move |c| (index, c)))
    {
        let at = format!("axis[{index}]");
        let name = column.name.as_str();
        let is_bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
        if !is_bare {
            checker.refuse(&at, format!("`{name}` is not a name of a parameter"), "letters, digits, `-` and `_`");
        } else if TAKEN.contains(&name) {
            checker.refuse(&at, format!("`{name}` is the name of a column of the report"), "give another `name`");
        } else if let Some(other) = seen.insert(name, index) {
            let help = "give one of them another `name`";
            checker.refuse(&at, format!("two parameters are called `{name}`, the other one in axis[{other}]"), help);
        }
    }
    let runs = axes.iter().try_fold(1_usize, |runs, axis| runs.checked_mul(axis.len().max(1)));
    if runs.is_none_or(|runs| runs > MOST_RUNS) {
        let runs = runs.map_or("too many".to_owned(), |runs| runs.to_string());
        checker.refuse("axis", format!("expected at most {MOST_RUNS} runs, found {runs}"), "use shorter axes");
    }
}

/// Reads the fixed values, each at its place.
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

/// Refuses keys that are no key paths, and keys that are given twice.
fn check_keys(checker: &mut Checker, axes: &[Axis], set: &[Assignment]) {
    let mut seen: Vec<&str> =
        set.iter().filter_map(|one| one.text.split_once('=')).map(|(key, _)| key.trim()).collect();
    for (index, axis) in axes.iter().enumerate() {
        for column in &axis.columns {
            let Target::Key(key) = &column.target else { continue };
            let at = format!("axis[{index}]");
            if Overrides::parse(&[format!("{key}=0")]).is_err() {
                checker.refuse(&at, format!("`{key}` is not a key path"), "as in geometry.shapes[0].disc.radius");
            } else if seen.contains(&key.as_str()) {
                checker.refuse(&at, format!("`{key}` is set twice"), "keep it in one axis, or in `set`");
            }
            seen.push(key);
        }
    }
}

/// The parameters, by which expectations and curves name values.
struct Names<'a> {
    axes: &'a [Axis],
    /// Whether all axes were understood.
    complete: bool,
}

impl Names<'_> {
    fn is_known(&self, name: &str) -> bool {
        !self.complete || self.values(name).is_some()
    }

    fn values(&self, name: &str) -> Option<&[Value]> {
        self.axes.iter().flat_map(|axis| &axis.columns).find(|column| column.name == name).map(|c| c.values.as_slice())
    }

    /// Whether all values of a parameter are numbers; true where that is not known.
    fn is_numeric(&self, name: &str) -> bool {
        self.values(name).is_none_or(|values| values.iter().all(|value| number_of(value).is_some()))
    }

    fn refuse_unknown(&self, checker: &mut Checker, at: &str, name: &str) {
        let known: Vec<&str> = self.axes.iter().flat_map(|axis| &axis.columns).map(|c| c.name.as_str()).collect();
        let meant =
            nearest(name, known.iter().copied()).map_or(String::new(), |near| format!("did you mean `{near}`? "));
        let list = if known.is_empty() { "there are none".to_owned() } else { known.join(", ") };
        checker.refuse(at, format!("`{name}` is not a parameter of this study"), format!("{meant}parameters: {list}"));
    }

    fn parameter(&self, checker: &mut Checker, at: &str, name: &str) -> Option<String> {
        if !self.is_known(name) {
            self.refuse_unknown(checker, at, name);
            return None;
        }
        Some(name.to_owned())
    }

    /// A parameter that holds numbers.
    fn numeric(&self, checker: &mut Checker, at: &str, name: &str) -> Option<String> {
        let name = self.parameter(checker, at, name)?;
        if !self.is_numeric(&name) {
            checker.refuse(at, format!("expected a parameter with numbers, `{name}` has others"), "");
            return None;
        }
        Some(name)
    }

    fn quantity(&self, checker: &mut Checker, at: &str, value: &Value) -> Option<Quantity> {
        match value {
            Value::String(name) => self.numeric(checker, at, name).map(Quantity::Parameter),
            other => match number_of(other) {
                Some(number) => Some(Quantity::Number(number)),
                None => {
                    let found = other.type_str();
                    checker.refuse(at, format!("expected a number or the name of a parameter, found {found}"), "");
                    None
                }
            },
        }
    }

    fn choice(&self, checker: &mut Checker, at: &str, only: Option<&BTreeMap<String, Value>>) -> Option<Choice> {
        let mut chosen = Some(Vec::new());
        for (name, value) in only.into_iter().flatten() {
            let at = format!("{at}.where.{name}");
            let Some(name) = self.parameter(checker, &at, name) else {
                chosen = None;
                continue;
            };
            if self.values(&name).is_some_and(|values| !values.iter().any(|other| same(other, value))) {
                checker.refuse(&at, format!("`{name}` never is {value}"), "name one of its values");
                chosen = None;
            }
            if let Some(chosen) = &mut chosen {
                chosen.push((name, value.clone()));
            }
        }
        chosen.map(Choice)
    }

    fn expectation(&self, checker: &mut Checker, raw: &RawExpectation, at: &str) -> Option<Expectation> {
        let measure = measure(checker, raw.measure.as_ref(), at);
        let key = format!("{at}.value");
        let value = checker.require(&key, raw.value.as_ref(), "value = 1.0, or the name of a parameter");
        let value = value.and_then(|value| self.quantity(checker, &key, value));
        let key = format!("{at}.tolerance");
        let tolerance = checker.require(&key, raw.tolerance.as_ref(), "tolerance = 0.02");
        let tolerance = tolerance.and_then(|value| self.quantity(checker, &key, value));
        if let Some(Quantity::Number(number)) = tolerance {
            checker.positive(&key, Some(number), "a tolerance");
        }
        let only = self.choice(checker, at, raw.only.as_ref());
        Some(Expectation { measure: measure?, value: value?, tolerance: tolerance?, only: only? })
    }

    fn trend(&self, checker: &mut Checker, raw: &RawTrend, at: &str) -> Option<Trend> {
        let measure = measure(checker, raw.measure.as_ref(), at);
        let reference = match &raw.reference {
            Some(value) => self.quantity(checker, &format!("{at}.reference"), value),
            None => Some(Quantity::Number(0.0)),
        };
        let key = format!("{at}.along");
        let along = checker.require(&key, raw.along.as_ref(), "along = \"spacing\"");
        let along = along.and_then(|name| self.numeric(checker, &key, name));
        let only = self.choice(checker, at, raw.only.as_ref());
        Some(Trend { measure: measure?, reference: reference?, along: along?, order: raw.order, only: only? })
    }

    fn report(&self, checker: &mut Checker, raw: Option<&RawReport>) -> Option<ReportPlan> {
        let raw = raw.cloned().unwrap_or_default();
        let curves = raw.curve.iter().flatten().enumerate();
        let curves: Vec<Option<Curve>> =
            curves.map(|(index, raw)| self.curve(checker, raw, &format!("report.curve[{index}]"))).collect();
        Some(ReportPlan {
            measures: raw.measures,
            curves: curves.into_iter().collect::<Option<_>>()?,
            pictures: raw.pictures.unwrap_or(true),
        })
    }

    fn curve(&self, checker: &mut Checker, raw: &RawCurve, at: &str) -> Option<Curve> {
        let x = checker.require(&format!("{at}.x"), raw.x.clone(), "x = \"spacing\"");
        let y = checker.require(&format!("{at}.y"), raw.y.clone(), "y = \"contact-angle-deg\"");
        if let Some(x) = x.as_deref().filter(|x| !self.is_numeric(x)) {
            checker.refuse(format!("{at}.x"), format!("expected a parameter with numbers, `{x}` has others"), "");
        }
        let series = match &raw.series {
            Some(name) => Some(self.parameter(checker, &format!("{at}.series"), name)?),
            None => None,
        };
        let reference = match &raw.reference {
            Some(value) => Some(self.quantity(checker, &format!("{at}.reference"), value)?),
            None => None,
        };
        let (x, y) = (x?, y?);
        let error = raw.error.unwrap_or(false);
        let title = raw
            .title
            .clone()
            .unwrap_or_else(|| if error { format!("error of {y} over {x}") } else { format!("{y} over {x}") });
        Some(Curve {
            title,
            x,
            y,
            series,
            reference,
            error,
            x_scale: raw.x_scale.unwrap_or_default(),
            y_scale: raw.y_scale.unwrap_or_default(),
        })
    }
}

fn measure(checker: &mut Checker, name: Option<&String>, at: &str) -> Option<String> {
    checker.require(&format!("{at}.measure"), name.cloned(), "measure = \"contact-angle-deg\"")
}

/// The number that a value is, whole or not.
#[must_use]
pub fn number_of(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// Whether two values are the same; numbers are, however they were written.
#[must_use]
pub fn same(a: &Value, b: &Value) -> bool {
    match (number_of(a), number_of(b)) {
        (Some(a), Some(b)) => a == b,
        _ => a == b,
    }
}
