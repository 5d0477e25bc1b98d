//! A hysteresis range: between the receding and the advancing angle the contact line holds its place.
//!
//! At rest the angle is whatever the drop needs, up to the bounds; at a bound the line lets go and moves with the angle of that
//! bound (Dussan 1979). With the pressure jump the line holds indeed: the fit passes through the anchor of the line, a point of the wall
//! that only a line at a bound takes along (see `lines`). With the continuum force a line within its range is only not driven,
//! and creeps with whatever flow there is.

use crate::analysis::laws::drops::tadmor;
use crate::sph::wetting::LineState;

/// Bounds of the angle of a line at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hysteresis {
    /// Advancing angle θ_A in rad.
    pub advancing: f64,
    /// Receding angle θ_R in rad, at most θ_A.
    pub receding: f64,
}

impl Hysteresis {
    /// The present angle within the range, else the bound next to it, in rad.
    #[must_use]
    pub fn angle(&self, line: &LineState) -> f64 {
        line.present.max(self.receding).min(self.advancing)
    }

    /// The angle of equilibrium in rad that belongs to both bounds \[Tadmor2004\].
    #[must_use]
    pub fn equilibrium(&self) -> f64 {
        tadmor(self.advancing, self.receding)
    }
}
