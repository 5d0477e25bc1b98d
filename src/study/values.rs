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

/// Whether two values are equal; for numbers, regardless of how they were written.
pub(crate) fn same(a: &Value, b: &Value) -> bool {
    match (number_of(a), number_of(b)) {
        (Some(a), Some(b)) => a == b,
        _ => a == b,
    }
}
