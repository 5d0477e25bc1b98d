//! A hysteresis range: between the receding and the advancing angle the contact line holds its place.
//!
//! At rest the angle is whatever the drop needs, up to the bounds; at a bound the line lets go and moves with the angle of that
//! bound (Dussan 1979). With the pressure jump the line holds indeed: the fit passes through the anchor of the line, a point of the wall
//! that only a line at a bound takes along (`sph::wetting::lines`). With the continuum force a line within its range is only not
//! driven, and creeps with whatever flow there is.

use super::law::{LineState, Parameter, WettingModel, law};
use super::tadmor::{order, tadmor};
use crate::input::Problem;

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
    /// The present angle within the range, else the bound next to it.
    fn angle(&self, line: &LineState) -> f64 {
        let [receding, advancing] = self.hysteresis_range();
        line.present.max(receding).min(advancing)
    }

    /// The angle of equilibrium that belongs to both bounds \[Tadmor2004\].
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
