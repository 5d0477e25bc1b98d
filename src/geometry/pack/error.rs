//! What generators refuse, and the bounds that they share.

/// What cannot be made, with the reason and a way out.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {message} ({help})")]
pub struct PackError {
    /// The key that is wrong, such as `radius`.
    pub key: &'static str,
    /// What is wrong with it.
    pub message: String,
    /// A way out.
    pub help: String,
}

impl PackError {
    pub(crate) fn new(key: &'static str, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { key, message: message.into(), help: help.into() }
    }

    pub(crate) fn unless(is_good: bool, key: &'static str, message: impl Into<String>, help: &str) -> Result<(), Self> {
        if is_good { Ok(()) } else { Err(Self::new(key, message, help)) }
    }

    /// Refuses a radius or a gap that is none.
    pub(crate) fn unless_size(key: &'static str, size: f64) -> Result<(), Self> {
        let help = if key == "gap" { "a length above 0, so that fluid can pass" } else { "a length above 0" };
        Self::unless(size > 0.0 && size.is_finite(), key, format!("{size:e} m is no {key}"), help)
    }
}

/// Most discs of one generator: more would be a slip of a unit.
pub(crate) const MOST_DISCS: f64 = 2e6;

/// A rectangle as lower left and upper right corner in m, checked.
pub(crate) fn size_of(region: [[f64; 2]; 2]) -> Result<[f64; 2], PackError> {
    let size = [region[1][0] - region[0][0], region[1][1] - region[0][1]];
    let is_good = region.as_flattened().iter().all(|v| v.is_finite()) && size.iter().all(|&s| s > 0.0);
    PackError::unless(
        is_good,
        "region",
        format!("{region:?} is no rectangle"),
        "give [[xmin, ymin], [xmax, ymax]] in m",
    )?;
    Ok(size)
}
