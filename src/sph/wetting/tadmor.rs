//! The static angle that belongs to an advancing and a receding one [Tadmor2004; Huber2013, Table 1].
//!
//! cos θ = (Γ_A cos θ_A + Γ_R cos θ_R)/(Γ_A + Γ_R), Γ_i = (sin³θ_i/(2 − 3 cos θ_i + cos³θ_i))^(1/3). The line then moves as with
//! Young's angle: it does not hold between the two (see `hysteresis`). The weights are those of drops in space.

use crate::analysis::laws::drops::tadmor;

/// A static angle from two measured ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TadmorAngle {
    /// Advancing angle in rad.
    pub advancing: f64,
    /// Receding angle in rad.
    pub receding: f64,
}

impl TadmorAngle {
    /// The angle of equilibrium in rad.
    #[must_use]
    pub fn contact_angle(&self) -> f64 {
        tadmor(self.advancing, self.receding)
    }
}
