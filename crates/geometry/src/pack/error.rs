//! Errors of generators, and their common bounds.

/// Why a pack cannot be generated, and a remedy.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {message} ({help})")]
pub struct PackError {
    /// The key with the problem, such as `radius`.
    pub key: &'static str,
    /// The problem.
    pub message: String,
    /// The remedy.
    pub help: String,
}

impl PackError {
    pub(crate) fn new(key: &'static str, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { key, message: message.into(), help: help.into() }
    }

    pub(crate) fn require(
        is_good: bool,
        key: &'static str,
        message: impl Into<String>,
        help: &str,
    ) -> Result<(), Self> {
        if is_good { Ok(()) } else { Err(Self::new(key, message, help)) }
    }

    /// Rejects an invalid radius or gap.
    pub(crate) fn require_size(key: &'static str, size: f64) -> Result<(), Self> {
        let help = if key == "gap" { "a length above 0, so that fluid can pass" } else { "a length above 0" };
        Self::require(size > 0.0 && size.is_finite(), key, format!("{size:e} m is not a valid {key}"), help)
    }
}

/// Maximum number of discs of one generator: more would indicate a wrong unit.
pub(crate) const MOST_DISCS: f64 = 2e6;

/// A rectangle as lower left and upper right corner in m, checked.
pub(crate) fn size_of(region: [[f64; 2]; 2]) -> Result<[f64; 2], PackError> {
    let size = [region[1][0] - region[0][0], region[1][1] - region[0][1]];
    let is_good = region.as_flattened().iter().all(|v| v.is_finite()) && size.iter().all(|&s| s > 0.0);
    PackError::require(
        is_good,
        "region",
        format!("{region:?} is not a rectangle"),
        "give [[xmin, ymin], [xmax, ymax]] in m",
    )?;
    Ok(size)
}
