//! The static angle that belongs to an advancing and a receding one [Tadmor2004; Huber2013, Table 1].
//!
//! cos θ = (Γ_A cos θ_A + Γ_R cos θ_R)/(Γ_A + Γ_R), Γ_i = (sin³θ_i/(2 − 3 cos θ_i + cos³θ_i))^(1/3). The line then moves as with
//! Young's angle: it does not hold between the two (see `hysteresis`). The weights are those of drops in space.

use super::hysteresis::order;
use super::law::{Law, LineState, Quantity, law};
use crate::analysis::laws::drops::tadmor;
use crate::input::Problem;

law! {
    /// Static angle from the advancing and the receding one (Tadmor 2004).
    pub struct Tadmor {
        /// Advancing contact angle in degrees.
        pub advancing_angle_deg: Quantity::ADVANCING_ANGLE,
        /// Receding contact angle in degrees, 0 to the advancing one.
        pub receding_angle_deg: Quantity::RECEDING_ANGLE,
    }
}

impl Law for Tadmor {
    fn angle(&self, _: &LineState) -> f64 {
        self.static_angle()
    }

    /// The angle of equilibrium \[Tadmor2004\].
    fn static_angle(&self) -> f64 {
        tadmor(self.advancing_angle_deg.to_radians(), self.receding_angle_deg.to_radians())
    }

    fn is_dynamic(&self) -> bool {
        false
    }

    fn contradiction(&self) -> Option<Problem> {
        order(self.receding_angle_deg, self.advancing_angle_deg)
    }
}
