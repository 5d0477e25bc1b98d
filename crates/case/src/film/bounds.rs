//! Common treatment of bounds between two keys: bounds are closed, and a ratio that misses its bound by rounding meets it.

/// Relative tolerance of a bound for a computed ratio: 5 × 0.1 and 0.5 are not the same number.
const ROUNDING: f64 = 1.0e-9;

/// Whether a positive value is above a closed bound.
pub(super) fn exceeds(value: f64, bound: f64) -> bool {
    value > bound * (1.0 + ROUNDING)
}

/// Whether a positive value is below a closed bound.
pub(super) fn falls_short(value: f64, bound: f64) -> bool {
    value < bound * (1.0 - ROUNDING)
}

/// Whether a positive value is outside of a closed range.
pub(super) fn is_outside(value: f64, range: (f64, f64)) -> bool {
    falls_short(value, range.0) || exceeds(value, range.1)
}
