//! The cap of a drop without gravity on a flat wall.

/// A drop on a flat wall without gravity: a circular segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cap {
    /// Radius of the circle in m.
    pub radius: f64,
    /// Length of the wetted wall in m.
    pub base: f64,
    /// Height in m.
    pub height: f64,
    /// Laplace pressure jump over surface tension in 1/m.
    pub curvature: f64,
}

/// The cap of `area` (m²) with the contact `angle` (rad, in (0, pi]): A = R² (theta - sin theta cos theta).
pub fn cap(area: f64, angle: f64) -> Cap {
    let radius = (area / (angle - angle.sin() * angle.cos())).sqrt();
    Cap { radius, base: 2.0 * radius * angle.sin(), height: radius * (1.0 - angle.cos()), curvature: 1.0 / radius }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a unit in the last printed digit.
    const PRINTED: f64 = 0.6e-5;

    #[test]
    fn caps_of_area_one_have_the_printed_sizes() {
        for (degrees, base, height, jump) in [
            (30.0_f64, 3.32253, 0.44513, 0.30098),
            (40.0, 2.83433, 0.51581, 0.45357),
            (60.0, 2.21010, 0.63800, 0.78370),
            (70.0, 1.98068, 0.69344, 0.94886),
            (90.0, 1.59577, 0.79788, 1.25331),
            (110.0, 1.25537, 0.89642, 1.49708),
            (120.0, 1.08949, 0.94353, 1.58978),
            (140.0, 0.75029, 1.03070, 1.71344),
            (150.0, 0.57250, 1.06831, 1.74671),
        ] {
            let cap = cap(1.0, degrees.to_radians());
            assert!((cap.base - base).abs() < PRINTED, "{degrees}: {cap:?}");
            assert!((cap.height - height).abs() < PRINTED, "{degrees}: {cap:?}");
            assert!((cap.curvature - jump).abs() < PRINTED, "{degrees}: {cap:?}");
            assert!(((2.0 * (2.0 * cap.height / cap.base).atan()).to_degrees() - degrees).abs() < 1e-9);
        }
    }
}
