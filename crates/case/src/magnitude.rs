//! Magnitudes out of range for a flow in SI units, under any key: products of a few of them would overflow or underflow.

use serde::Serialize;
use toml::Value;

use meniscus_core::input::Checker;

/// Smallest and largest magnitude of a number that is not 0.
const SIZES: (f64, f64) = (1.0e-20, 1.0e15);
/// A number of a list below this fraction of the largest one is 0 within rounding, such as a coordinate on an axis.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Smallest magnitude of such a number that is not 0.
const SMALLEST_ROUNDING: f64 = 1.0e-40;

/// Refuses such numbers in a table of the case; keys that are refused already are skipped.
pub(super) fn magnitudes(checker: &mut Checker, table: &str, raw: Option<&impl Serialize>) {
    // Whatever does not serialize has no numbers.
    let Some(Ok(value)) = raw.map(Value::try_from) else { return };
    let mut found = Vec::new();
    collect(&value, table.to_owned(), 0.0, &mut found);
    for (path, number) in found {
        if !checker.problems.iter().any(|problem| problem.path == path) {
            let message = format!("expected 0 or a size from {:e} to {:e}, found {number:e}", SIZES.0, SIZES.1);
            checker.refuse(path, message, "numbers are in SI units: m, kg, s, Pa, N/m");
        }
    }
}

/// Finds numbers with magnitudes out of range; below `rounding` they are 0 within rounding.
fn collect(value: &Value, path: String, rounding: f64, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Float(number) => {
            let size = number.abs();
            let is_zero = size == 0.0 || (SMALLEST_ROUNDING..rounding).contains(&size);
            if !is_zero && !(SIZES.0..=SIZES.1).contains(&size) {
                found.push((path, *number));
            }
        }
        Value::Array(all) => {
            let rounding = rounding.max(ROUNDING * largest(value));
            all.iter().enumerate().for_each(|(index, one)| collect(one, format!("{path}[{index}]"), rounding, found));
        }
        Value::Table(table) => table.iter().for_each(|(key, one)| collect(one, format!("{path}.{key}"), 0.0, found)),
        _ => {}
    }
}

/// The largest magnitude of the numbers of a list and of its nested lists.
fn largest(value: &Value) -> f64 {
    match value {
        Value::Float(number) => number.abs(),
        Value::Array(all) => all.iter().map(largest).fold(0.0, f64::max),
        _ => 0.0,
    }
}
