//! Values of parameters: as numbers and as text, and their equality.

use toml::Value;

/// A value as text.
pub(crate) fn shown(value: &Value) -> String {
    /// Outside of this range, an exponent is shorter than zeros.
    const FIXED: std::ops::Range<f64> = 1.0e-3..1.0e6;
    match value {
        Value::String(text) => text.clone(),
        Value::Float(number) if *number != 0.0 && !FIXED.contains(&number.abs()) => format!("{number:e}"),
        Value::Float(number) => number.to_string(),
        other => other.to_string(),
    }
}

/// The number of a value, integer or not.
pub(crate) fn number_of(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// The different numbers among values, ascending.
pub(crate) fn numbers(values: &[Value]) -> Vec<f64> {
    ascending(values.iter().filter_map(number_of))
}

/// The different ones of some numbers, ascending.
pub(crate) fn ascending(numbers: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    numbers
}

/// Whether ascending numbers are rather apart by equal ratios than by equal differences.
pub(crate) fn is_geometric(numbers: &[f64]) -> bool {
    /// Below this ratio of the last to the first number, both scales look alike.
    const RATIO: f64 = 8.0;
    let (Some(&first), Some(&last)) = (numbers.first(), numbers.last()) else { return false };
    if numbers.len() < 3 || first <= 0.0 || last < RATIO * first {
        return false;
    }
    let scatter = |on: &dyn Fn(f64) -> f64| {
        let steps = || numbers.windows(2).map(|pair| on(pair[1]) - on(pair[0]));
        steps().fold(0.0, f64::max) / steps().fold(f64::INFINITY, f64::min)
    };
    scatter(&f64::ln) < scatter(&|x| x)
}

/// Whether two values are equal; for numbers, regardless of how they were written.
pub(crate) fn same(a: &Value, b: &Value) -> bool {
    match (number_of(a), number_of(b)) {
        (Some(a), Some(b)) => a == b,
        _ => a == b,
    }
}
