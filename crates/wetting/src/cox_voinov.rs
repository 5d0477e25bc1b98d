//! Viscous bending of the interface between the slip length and the scale of the circle fit [Voinov1976; Cox1986].
//!
//! θ_d³ = θ_e³ + 9 Ca ln(L/λ): closer to the line than the fit resolves, the flow bends the interface. λ is the slip length of the liquid on the wall, L the
//! smoothing length h. Bending farther out is resolved, so that with a finer spacing the law contributes less and the flow more, and the apparent angle at a
//! given distance should not change (Afkhami et al. 2009). Valid for small capillary numbers, angles up to about 135 degrees and another phase of small
//! viscosity.

use std::f64::consts::PI;

use super::law::{LineState, Parameter, WettingModel, law};

law! {
    /// Viscous bending below the resolved scale (Voinov 1976; Cox 1986).
    pub struct CoxVoinov {
        /// Static contact angle in degrees.
        pub contact_angle_deg: Parameter::CONTACT_ANGLE,
        /// Slip length of the liquid on its wall in m.
        pub slip_length: Parameter::positive("a slip length in m", "slip-length = 1.0e-9 # m"),
    }
}

impl WettingModel for CoxVoinov {
    /// Dynamic angle θ_d in rad by viscous bending up to the distance `line.length`, for small angles [Voinov1976; Cox1986, Eq. 8.3].
    fn angle(&self, line: &LineState) -> f64 {
        let decades = (line.length / self.slip_length).ln().max(0.0);
        let cube = self.static_angle().powi(3) + 9.0 * line.capillary_number() * decades;
        cube.max(0.0).cbrt().min(PI)
    }
}
