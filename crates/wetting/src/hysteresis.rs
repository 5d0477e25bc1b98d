//! Contact angle hysteresis: between the receding and the advancing angle the contact line is pinned.
//!
//! At rest the angle takes any value within the range; at a bound the line depins and moves with the angle of that bound (Dussan 1979). With the pressure
//! jump the line is strictly pinned: the fit passes through the anchor of the line, a point of the wall that moves only with a line at a bound
//! (`sph::wetting::lines`). With the continuum force a line within its range is merely not driven, and creeps with the flow.

use super::law::{LineState, Parameter, WettingModel, law};
use super::tadmor::{order, tadmor};
use meniscus_core::input::Problem;

law! {
    /// Contact lines pinned between receding and advancing angle (Dussan 1979).
    pub struct Hysteresis {
        /// Advancing contact angle in degrees.
        pub advancing_angle_deg: Parameter::ADVANCING_ANGLE,
        /// Receding contact angle in degrees, 0 to the advancing one.
        pub receding_angle_deg: Parameter::RECEDING_ANGLE,
    }
}

impl WettingModel for Hysteresis {
    /// The present angle clamped to the range of hysteresis \[Dussan1979\].
    fn angle(&self, line: &LineState) -> f64 {
        let [receding, advancing] = self.hysteresis_range();
        line.present.max(receding).min(advancing)
    }

    /// The equilibrium angle that belongs to both bounds ([`tadmor`]).
    fn static_angle(&self) -> f64 {
        let [receding, advancing] = self.hysteresis_range();
        tadmor(advancing, receding)
    }

    fn hysteresis_range(&self) -> [f64; 2] {
        [self.receding_angle_deg.to_radians(), self.advancing_angle_deg.to_radians()]
    }

    fn pins(&self) -> bool {
        true
    }

    fn is_dynamic(&self) -> bool {
        false
    }

    fn contradiction(&self) -> Option<Problem> {
        order(self.receding_angle_deg, self.advancing_angle_deg)
    }
}
