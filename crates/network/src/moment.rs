//! A displacement at one moment, stored while the displacement continues.

use super::displacement::Displacement;

/// A displacement at one moment.
#[derive(Debug, Clone)]
pub struct Moment {
    /// The displacement of the half cycle.
    pub displacement: Displacement,
    /// Index of the half cycle.
    pub half_cycle: usize,
    /// Number of its events so far.
    pub events: usize,
    /// Applied curvature towards the wetting phase in 1/m; `None` before the first event.
    pub applied: Option<f64>,
    /// Saturation of the wetting phase.
    pub saturation: f64,
}
