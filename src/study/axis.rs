//! Axes of a study file: lists, ranges, pairs, CSV files and base cases, converted to columns of values.

use std::path::Path;

use toml::Value;

use super::definition::{Axis, Column, Target};
use super::raw::{RawAxis, RawColumn, RawRange, RawScale};
use meniscus_case::read;
use meniscus_core::input::Checker;

/// Most values of an axis.
const MOST_VALUES: usize = 10_000;

/// Significant digits of a computed value, so that 0.1 + 2 x 0.1 is written as 0.3.
const DIGITS: usize = 12;

/// The axis at `axis[index]` of the file; paths are relative to `folder`.
pub(super) fn axis(checker: &mut Checker, raw: &RawAxis, index: usize, folder: &Path) -> Option<Axis> {
    let at = format!("axis[{index}]");
    let kinds = [
        ("key", raw.key.is_some()),
        ("pair", raw.pair.is_some()),
        ("table", raw.table.is_some()),
        ("cases", raw.cases.is_some()),
    ];
    let given: Vec<&str> = kinds.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
    let [kind] = given[..] else {
        let found = if given.is_empty() { "none".to_owned() } else { given.join(", ") };
        checker.refuse(
            at,
            format!("expected one of `key`, `pair`, `table` and `cases`, found {found}"),
            "an axis is `key = \"sph.spacing\"` with `values` or `range`, or `pair`, or `table`, or `cases`",
        );
        return None;
    };
    refuse_foreign_keys(checker, raw, kind, &at);
    let columns = match kind {
        "key" => {
            let column = RawColumn {
                name: raw.name.clone(),
                key: raw.key.clone(),
                also: raw.also.clone(),
                values: raw.values.clone(),
                range: raw.range.clone(),
            };
            vec![column_of(checker, &column, &at)?]
        }
        "pair" => pair(checker, raw.pair.as_deref().unwrap_or_default(), &at)?,
        "table" => table(checker, raw, &at, folder)?,
        _ => vec![cases(checker, raw, &at, folder)?],
    };
    Some(Axis { columns })
}

/// Refuses keys that do not belong to the kind of the axis.
fn refuse_foreign_keys(checker: &mut Checker, raw: &RawAxis, kind: &str, at: &str) {
    let keys: [(&str, bool, &[&str]); 5] = [
        ("name", raw.name.is_some(), &["key", "cases"]),
        ("also", raw.also.is_some(), &["key"]),
        ("values", raw.values.is_some(), &["key"]),
        ("range", raw.range.is_some(), &["key"]),
        ("columns", raw.columns.is_some(), &["table"]),
    ];
    for (key, given, kinds) in keys {
        if given && !kinds.contains(&kind) {
            let help = format!("it goes with `{}`", kinds.join("` or `"));
            checker.refuse(format!("{at}.{key}"), format!("`{key}` does not apply to `{kind}`"), help);
        }
    }
}

fn pair(checker: &mut Checker, raw: &[RawColumn], at: &str) -> Option<Vec<Column>> {
    let mut columns = Vec::new();
    for (number, raw) in raw.iter().enumerate() {
        columns.push(column_of(checker, raw, &format!("{at}.pair[{number}]")));
    }
    let columns: Vec<Column> = columns.into_iter().collect::<Option<_>>()?;
    let Some(first) = columns.first() else {
        checker.refuse(format!("{at}.pair"), "expected parameters that vary together, found none", "");
        return None;
    };
    for (number, column) in columns.iter().enumerate() {
        if column.values.len() != first.values.len() {
            let (here, there) = (column.values.len(), first.values.len());
            checker.refuse(
                format!("{at}.pair[{number}]"),
                format!("`{}` has {here} values, `{}` has {there}", column.name, first.name),
                "parameters that vary together need as many values each",
            );
            return None;
        }
    }
    Some(columns)
}

/// A parameter with a list or a range.
fn column_of(checker: &mut Checker, raw: &RawColumn, at: &str) -> Option<Column> {
    let (values, origins): (Vec<Value>, Vec<String>) = match (&raw.values, &raw.range) {
        (Some(values), None) => {
            (values.clone(), (0..values.len()).map(|number| format!("{at}.values[{number}]")).collect())
        }
        (None, Some(range)) => {
            let values = numbers(checker, range, &format!("{at}.range"))?;
            let origins = vec![format!("{at}.range"); values.len()];
            (values.into_iter().map(Value::Float).collect(), origins)
        }
        (values, _) => {
            let found = if values.is_some() { "both" } else { "neither" };
            let help = "values = [1.0, 2.0]; a `distribution` belongs next to the `key` of an axis";
            checker.refuse(at, format!("expected `values` or `range`, found {found}"), help);
            return None;
        }
    };
    if values.is_empty() || values.len() > MOST_VALUES {
        let message = format!("expected 1 to {MOST_VALUES} values, found {}", values.len());
        checker.refuse(format!("{at}.values"), message, "");
        return None;
    }
    let target = target(checker, raw, at);
    let name = raw.name.clone().or_else(|| raw.key.as_deref().map(last_part));
    let name = checker.require(&format!("{at}.name"), name, "name = \"exact-width\", or a key of the case")?;
    Some(Column { name, target, values, origins })
}

/// The keys that a parameter sets.
fn target(checker: &mut Checker, raw: &RawColumn, at: &str) -> Target {
    let also = raw.also.iter().flatten();
    match &raw.key {
        Some(key) => Target::Keys(std::iter::once(key).chain(also).cloned().collect()),
        None => {
            if raw.also.is_some() {
                checker.refuse(
                    format!("{at}.also"),
                    "`also` requires `key`, found none",
                    "name the first key in `key`",
                );
            }
            Target::Nothing
        }
    }
}

/// `contact-angle-deg` of `sph.wetting.young.contact-angle-deg`.
pub(super) fn last_part(key: &str) -> String {
    let last = key.rsplit('.').next().unwrap_or(key);
    last.split('[').next().unwrap_or(last).to_owned()
}

/// The numbers of a range, both ends included.
fn numbers(checker: &mut Checker, raw: &RawRange, at: &str) -> Option<Vec<f64>> {
    let (from, to, count) = (raw.from?, raw.to?, raw.count?);
    if !(2..=MOST_VALUES).contains(&count) {
        checker.refuse(format!("{at}.count"), format!("expected 2 to {MOST_VALUES} values, found {count}"), "");
        return None;
    }
    let logarithmic = raw.scale.unwrap_or_default() == RawScale::Logarithmic;
    if logarithmic && !(from > 0.0 && to > 0.0) {
        checker.refuse(
            at,
            format!("a logarithmic range needs ends above 0, found {from:?} and {to:?}"),
            "scale = \"linear\"",
        );
        return None;
    }
    let fraction = |number: usize| number as f64 / (count - 1) as f64;
    let value = |number: usize| match number {
        0 => from,
        last if last + 1 == count => to,
        _ if logarithmic => rounded(from * (to / from).powf(fraction(number))),
        _ => rounded(from + (to - from) * fraction(number)),
    };
    Some((0..count).map(value).collect())
}

/// The number, rounded to [`DIGITS`] digits.
fn rounded(number: f64) -> f64 {
    format!("{number:.precision$e}", precision = DIGITS - 1).parse().unwrap_or(number)
}

/// The columns of a CSV file.
fn table(checker: &mut Checker, raw: &RawAxis, at: &str, folder: &Path) -> Option<Vec<Column>> {
    let at_table = format!("{at}.table");
    let path = folder.join(raw.table.as_deref()?);
    let text = match read(&path, "its path is relative to the study file") {
        Ok(text) => text,
        Err(error) => {
            error.mistakes.iter().for_each(|m| checker.refuse(&at_table, m.message.clone(), m.help_text()));
            return None;
        }
    };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(text.as_bytes());
    let heads: Vec<String> = match reader.headers() {
        Ok(heads) => heads.iter().map(str::to_owned).collect(),
        Err(error) => {
            checker.refuse(&at_table, format!("{}: {error}", path.display()), "");
            return None;
        }
    };
    let mut columns: Vec<Column> = heads
        .iter()
        .map(|head| Column { name: head.clone(), target: Target::Nothing, values: Vec::new(), origins: Vec::new() })
        .collect();
    for (head, key) in raw.columns.iter().flatten() {
        match columns.iter_mut().find(|column| column.name == *head) {
            Some(column) => column.target = Target::Keys(vec![key.clone()]),
            None => checker.refuse(
                format!("{at}.columns.{head}"),
                format!("{} has no column `{head}`", path.display()),
                format!("its columns: {}", heads.join(", ")),
            ),
        }
    }
    for record in reader.records() {
        match record {
            Ok(record) => {
                for (column, field) in columns.iter_mut().zip(record.iter()) {
                    column.origins.push(match column.target {
                        Target::Keys(_) => format!("{at}.columns.{}", column.name),
                        _ => at_table.clone(),
                    });
                    column.values.push(field_value(field));
                }
            }
            Err(error) => {
                checker.refuse(&at_table, format!("{}: {error}", path.display()), "every row needs as many fields");
                return None;
            }
        }
    }
    if columns.first().is_none_or(|column| column.values.is_empty()) {
        checker.refuse(&at_table, format!("{} has no row below its head", path.display()), "");
        return None;
    }
    Some(columns)
}

/// A field as a number if it is one, else as text.
fn field_value(field: &str) -> Value {
    match field.parse::<f64>() {
        Ok(number) if number.is_finite() => Value::Float(number),
        _ => Value::String(field.to_owned()),
    }
}

/// Base cases as a parameter.
fn cases(checker: &mut Checker, raw: &RawAxis, at: &str, folder: &Path) -> Option<Column> {
    let cases = raw.cases.as_deref().unwrap_or_default();
    if cases.is_empty() {
        checker.refuse(format!("{at}.cases"), "expected case files, found none", "cases = [\"a.toml\", \"b.toml\"]");
        return None;
    }
    Some(Column {
        name: raw.name.clone().unwrap_or_else(|| "case".to_owned()),
        target: Target::Case(cases.iter().map(|case| folder.join(case)).collect()),
        values: cases.iter().map(|case| Value::String(case.with_extension("").display().to_string())).collect(),
        origins: (0..cases.len()).map(|number| format!("{at}.cases[{number}]")).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(scale: RawScale) -> RawRange {
        RawRange { from: Some(0.1), to: Some(0.9), count: Some(3), scale: Some(scale) }
    }

    #[test]
    fn ranges_include_both_ends_and_have_short_numbers() {
        let mut checker = Checker::default();
        assert_eq!(numbers(&mut checker, &range(RawScale::Linear), "r"), Some(vec![0.1, 0.5, 0.9]));
        assert_eq!(numbers(&mut checker, &range(RawScale::Logarithmic), "r"), Some(vec![0.1, 0.3, 0.9]));
        let negative = RawRange { from: Some(-0.1), ..range(RawScale::Logarithmic) };
        assert_eq!(numbers(&mut checker, &negative, "r"), None);
        assert!(checker.problems[0].message.contains("needs ends above 0"));
    }

    #[test]
    fn a_csv_file_gives_a_parameter_per_column() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("t.csv"), "# source\nangle, exact ,side\n20,3.5,wall\n40,2e-1,periodic\n")
            .unwrap();
        let raw = RawAxis {
            table: Some("t.csv".into()),
            columns: Some([("angle".to_owned(), "a.b".to_owned())].into()),
            ..RawAxis::default()
        };
        let mut checker = Checker::default();
        let axis = axis(&mut checker, &raw, 0, folder.path()).unwrap();
        assert_eq!(checker.problems, []);
        assert_eq!(axis.len(), 2);
        assert_eq!(axis.columns[0].target, Target::Keys(vec!["a.b".to_owned()]));
        assert_eq!(axis.columns[1].values, [Value::Float(3.5), Value::Float(0.2)]);
        assert_eq!(axis.columns[2].values[1], Value::String("periodic".to_owned()));
    }
}
