//! Numbers that are no quantity of a flow in SI units, in whatever key: products of a few of them would leave the range of a double.

use serde::Serialize;
use toml::Value;

use crate::input::Checker;

/// Smallest and largest size of a number that is not 0.
const SIZES: (f64, f64) = (1.0e-20, 1.0e15);

/// Refuses such numbers in a table of the case; keys that are refused already are left to that.
pub(super) fn magnitudes(checker: &mut Checker, table: &str, raw: Option<&impl Serialize>) {
    // What does not serialize holds no number.
    let Some(Ok(value)) = raw.map(Value::try_from) else { return };
    let mut found = Vec::new();
    collect(&value, table.to_owned(), &mut found);
    for (path, number) in found {
        if !checker.problems.iter().any(|problem| problem.path == path) {
            let message = format!("expected 0 or a size from {:e} to {:e}, found {number:e}", SIZES.0, SIZES.1);
            checker.refuse(path, message, "numbers are in SI units: m, kg, s, Pa, N/m");
        }
    }
}

fn collect(value: &Value, path: String, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Float(number) if *number != 0.0 && !(SIZES.0..=SIZES.1).contains(&number.abs()) => {
            found.push((path, *number));
        }
        Value::Array(all) => {
            all.iter().enumerate().for_each(|(index, one)| collect(one, format!("{path}[{index}]"), found));
        }
        Value::Table(table) => table.iter().for_each(|(key, one)| collect(one, format!("{path}.{key}"), found)),
        _ => {}
    }
}
