//! The static angle that belongs to an advancing and a receding one [Tadmor2004; Huber2013, Table 1].
//!
//! cos θ = (Γ_A cos θ_A + Γ_R cos θ_R)/(Γ_A + Γ_R), Γ_i = (sin³θ_i/(2 − 3 cos θ_i + cos³θ_i))^(1/3). The line then moves as with Young's angle: it is not
//! pinned between the two (see `hysteresis`). The weights are those of three-dimensional drops.

use super::law::{LineState, Parameter, WettingModel, law};
use meniscus_core::input::Problem;

law! {
    /// Static angle from the advancing and the receding one (Tadmor 2004).
    pub struct Tadmor {
        /// Advancing contact angle in degrees.
        pub advancing_angle_deg: Parameter::ADVANCING_ANGLE,
        /// Receding contact angle in degrees, 0 to the advancing one.
        pub receding_angle_deg: Parameter::RECEDING_ANGLE,
    }
}

impl WettingModel for Tadmor {
    fn angle(&self, _: &LineState) -> f64 {
        self.static_angle()
    }

    /// The equilibrium angle of [`tadmor`].
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

/// Equilibrium contact angle in rad from an advancing and a receding one \[Tadmor2004\]. cos theta = (G_A cos theta_A + G_R cos theta_R)/(G_A + G_R), G =
/// (sin³/(2 - 3 cos + cos³))^(1/3). Evaluated with 1/G³ = (2 + cos) tan(theta/2)/(2 cos²(theta/2)), which keeps its digits down to 0: a receding angle of 0
/// gives an equilibrium angle of 0.
pub(super) fn tadmor(advancing: f64, receding: f64) -> f64 {
    let inverse = |angle: f64| {
        let half = 0.5 * angle;
        (2.0 + angle.cos()) * half.tan() / (2.0 * half.cos().powi(2))
    };
    let (a, r) = (inverse(advancing), inverse(receding));
    // G_A/G_R; two angles of 0 have equal weights.
    let ratio = if a > 0.0 { (r / a).cbrt() } else { 1.0 };
    ((ratio * advancing.cos() + receding.cos()) / (ratio + 1.0)).clamp(-1.0, 1.0).acos()
}

/// The problem of a receding angle above the advancing one, both in degrees.
pub(super) fn order(receding: f64, advancing: f64) -> Option<Problem> {
    (receding > advancing).then(|| {
        Problem::new(
            "receding-angle-deg",
            format!("the receding angle of {receding:.1} degrees is above the advancing one of {advancing:.1}"),
            "a line recedes at the smaller angle: exchange the two",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Tadmor2004]
    #[test]
    fn tadmor_gives_the_angles_of_the_alkanes() {
        // Advancing and receding angles of Lam et al. 2002 as printed in Table 1 of Huber et al. 2013.
        for (advancing, receding, expected) in [
            (52.9_f64, 40.7_f64, 46.77),
            (58.4, 45.7, 51.98),
            (61.9, 51.5, 56.63),
            (65.4, 60.1, 62.73),
            (69.6, 64.3, 66.92),
            (73.1, 65.8, 69.39),
            (76.7, 71.0, 73.81),
        ] {
            let found = tadmor(advancing.to_radians(), receding.to_radians()).to_degrees();
            assert!((found - expected).abs() < 0.006, "{advancing}/{receding}: {found}");
        }
    }

    #[test]
    fn tadmor_goes_on_to_complete_wetting_and_drying() {
        let degrees =
            |advancing: f64, receding: f64| tadmor(advancing.to_radians(), receding.to_radians()).to_degrees();
        for same in [0.0, 1.0e-9, 1.0e-3, 1.0, 90.0, 179.0, 180.0] {
            // The arc cosine of 1 - 1e-16 is 1e-6 degrees.
            assert!((degrees(same, same) - same).abs() < 1.0e-5, "{same}: {}", degrees(same, same));
        }
        // A receding angle of 0 dominates any other one; the limit is approached as its cube root.
        let falling = [10.0, 1.0, 1.0e-3, 1.0e-9, 1.0e-20, 0.0].map(|receding| degrees(60.0, receding));
        assert!(falling.windows(2).all(|pair| pair[1] < pair[0]) && falling[5] == 0.0, "{falling:?}");
    }
}
