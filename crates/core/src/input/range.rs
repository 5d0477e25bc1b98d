//! Ranges of numbers in an input file: a check refuses values outside of them, a schema states them to editors.

use std::fmt;

use serde_json::{Value, json};

/// A range of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Above a limit.
    Above(f64),
    /// At or above a limit.
    AtLeast(f64),
    /// Closed interval.
    Within(f64, f64),
    /// Open interval.
    Between(f64, f64),
}

impl Range {
    /// Whether a value lies in it.
    pub(crate) fn contains(&self, value: f64) -> bool {
        match *self {
            Self::Above(limit) => value > limit,
            Self::AtLeast(limit) => value >= limit,
            Self::Within(low, high) => low <= value && value <= high,
            Self::Between(low, high) => low < value && value < high,
        }
    }

    /// The keywords of JSON Schema for it.
    pub(crate) fn keywords(&self) -> Vec<(&'static str, Value)> {
        match *self {
            Self::Above(limit) => vec![("exclusiveMinimum", number(limit))],
            Self::AtLeast(limit) => vec![("minimum", number(limit))],
            Self::Within(low, high) => vec![("minimum", number(low)), ("maximum", number(high))],
            Self::Between(low, high) => vec![("exclusiveMinimum", number(low)), ("exclusiveMaximum", number(high))],
        }
    }
}

/// To follow a noun: `above 0`, `from 0.0 to 180.0`.
impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Above(limit) => write!(f, "above {limit}"),
            Self::AtLeast(limit) => write!(f, "of at least {limit}"),
            Self::Within(low, high) => write!(f, "from {low:?} to {high:?}"),
            Self::Between(low, high) => write!(f, "above {low} and below {high}"),
        }
    }
}

/// An integer without a decimal point.
fn number(value: f64) -> Value {
    if value.fract() == 0.0 && value.abs() < 1.0e6 { json!(value as i64) } else { json!(value) }
}
