//! Drops without gravity on flat walls and on discs.

use std::f64::consts::PI;

use crate::analysis::roots::bisect;

/// A drop on a flat wall without gravity: a circular segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cap {
    /// Radius of the circle in m.
    pub radius: f64,
    /// Length of the wetted wall in m.
    pub base: f64,
    /// Height in m.
    pub height: f64,
    /// Laplace jump over surface tension in 1/m.
    pub curvature: f64,
}

/// The cap of `area` (m²) with the contact `angle` (rad, in (0, pi]): A = R² (theta - sin theta cos theta).
#[must_use]
pub fn cap(area: f64, angle: f64) -> Cap {
    let radius = (area / (angle - angle.sin() * angle.cos())).sqrt();
    Cap { radius, base: 2.0 * radius * angle.sin(), height: radius * (1.0 - angle.cos()), curvature: 1.0 / radius }
}

/// The contact angle in rad of a cap with the given base and height in m.
#[must_use]
pub fn cap_angle(base: f64, height: f64) -> f64 {
    2.0 * (2.0 * height / base).atan()
}

/// A drop on a disc without gravity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropOnDisc {
    /// Radius of the drop's circle in m.
    pub radius: f64,
    /// Distance of the centers of drop and disc in m.
    pub center_distance: f64,
    /// Half of the angle in rad under which the disc's center sees the wetted part of the disc.
    pub half_angle: f64,
    /// Height over the disc in m.
    pub height: f64,
}

/// The drop of `area` (m²) with the contact `angle` (rad) on a disc of `disc_radius` (m); nothing where none fits.
///
/// Centers at c² = R² + r² - 2 R r cos theta; the area is that of the drop's circle less its overlap with the disc.
#[must_use]
pub fn drop_on_disc(area: f64, angle: f64, disc_radius: f64) -> Option<DropOnDisc> {
    let distance = |r: f64| (disc_radius.powi(2) + r * r - 2.0 * disc_radius * r * angle.cos()).sqrt();
    let half_angle = |r: f64| {
        let c = distance(r);
        // The arctangent of sine and cosine keeps half angles above 90 degrees.
        (r * angle.sin() / c).atan2((disc_radius - r * angle.cos()) / c)
    };
    let drop_area = |r: f64| {
        let beta = half_angle(r);
        // The triangle of both centers and the contact point has the angles beta, gamma and theta.
        let gamma = PI - beta - angle;
        let of_disc = disc_radius.powi(2) * (beta - beta.sin() * beta.cos());
        let of_drop = r * r * ((PI - gamma) + gamma.sin() * gamma.cos());
        of_drop - of_disc
    };
    // A very small drop sits on a flat wall; a very large one swallows the disc.
    let scale = cap(area, angle).radius;
    let radius = bisect(|r| drop_area(r) - area, 1e-3 * scale, scale.max(disc_radius) * 1e3)?;
    let center_distance = distance(radius);
    Some(DropOnDisc {
        radius,
        center_distance,
        half_angle: half_angle(radius),
        height: center_distance + radius - disc_radius,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half of the last digit printed.
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
            assert!((cap_angle(cap.base, cap.height).to_degrees() - degrees).abs() < 1e-9);
        }
    }

    #[test]
    fn drops_on_a_disc_have_the_printed_sizes() {
        for (degrees, radius, half_angle, height) in
            [(40.0_f64, 0.91675, 63.195, 0.57697), (90.0, 0.65564, 33.250, 0.85141), (120.0, 0.59142, 21.569, 0.98470)]
        {
            let drop = drop_on_disc(1.0, degrees.to_radians(), 1.0).expect("a drop");
            assert!((drop.radius - radius).abs() < PRINTED, "{degrees}: {drop:?}");
            assert!((drop.half_angle.to_degrees() - half_angle).abs() < 6e-4, "{degrees}: {drop:?}");
            assert!((drop.height - height).abs() < 2.0 * PRINTED, "{degrees}: {drop:?}");
        }
    }

    #[test]
    fn a_drop_on_a_large_disc_is_a_cap() {
        let flat = cap(1.0, 1.2);
        let drop = drop_on_disc(1.0, 1.2, 1.0e3).expect("a drop");
        assert!((drop.height / flat.height - 1.0).abs() < 2e-3);
    }
}
