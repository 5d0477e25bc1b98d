//! A drop on a disc without gravity (C10 of the benchmarks), compared with its closed form.

use std::f64::consts::PI;

use meniscus_core::solver::{Measure, measure};
use meniscus_geometry::analysis::roots::bisect;
use meniscus_geometry::interface::cap::cap;
use meniscus_sph::measures::Subject;

/// A drop on a disc without gravity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DropOnDisc {
    /// Half of the angle in rad that the wetted part of the disc subtends at its center.
    pub(crate) half_angle: f64,
    /// Height over the disc in m.
    pub(crate) height: f64,
}

/// The drop of `area` (m²) with the contact `angle` (rad) on a disc of `disc_radius` (m); `None` if there is none.
///
/// The distance of the centers is c² = R² + r² - 2 R r cos theta; the area is that of the drop's circle minus its overlap with the disc.
pub(crate) fn drop_on_disc(area: f64, angle: f64, disc_radius: f64) -> Option<DropOnDisc> {
    let distance = |r: f64| (disc_radius.powi(2) + r * r - 2.0 * disc_radius * r * angle.cos()).sqrt();
    let half_angle = |r: f64| {
        let c = distance(r);
        // The two-argument arctangent is valid for half angles above 90 degrees too.
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
    // Limits: a very small drop sits on a flat wall; a very large one encloses the disc.
    let scale = cap(area, angle).radius;
    let radius = bisect(|r| drop_area(r) - area, 1e-3 * scale, scale.max(disc_radius) * 1e3)?;
    Some(DropOnDisc { half_angle: half_angle(radius), height: distance(radius) + radius - disc_radius })
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (Some(disc), Some(wetting)) = (s.discs.first(), s.flow.config.method.wetting) else { return vec![] };
    let ends: Vec<_> = s.observed.lines_with_angle().collect();
    let half = match ends[..] {
        [a, b] => 0.5 * (a.position - disc.center).angle(&(b.position - disc.center)),
        _ => f64::NAN,
    };
    let contour = s.observed.interface.iter().flat_map(|line| &line.points);
    let height = contour.map(|x| (x - disc.center).norm() - disc.radius).fold(f64::NAN, f64::max);
    let exact = drop_on_disc(s.observed.areas.wetting, wetting.static_angle(), disc.radius);
    let ratio = |found: f64, exact: Option<f64>| exact.map_or(f64::NAN, |exact| found / exact);
    vec![
        measure("half-angle-deg", half.to_degrees(), "deg")
            .by("half of the angle between the contact points of the fitted circle, seen from the center of the \
                 disc"),
        measure("half-angle-ratio", ratio(half, exact.map(|e| e.half_angle)), "")
            .by("half-angle over that of the exact drop with the same area and the requested angle"),
        measure("height-ratio", ratio(height, exact.map(|e| e.height)), "")
            .by("largest distance of the c = 0.5 contour from the disc over that of the exact drop"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a unit in the last printed digit.
    const PRINTED: f64 = 0.6e-5;

    #[test]
    fn drops_on_a_disc_have_the_printed_sizes() {
        for (degrees, radius, half_angle, height) in
            [(40.0_f64, 0.91675, 63.195, 0.57697), (90.0, 0.65564, 33.250, 0.85141), (120.0, 0.59142, 21.569, 0.98470)]
        {
            let drop = drop_on_disc(1.0, degrees.to_radians(), 1.0).expect("a drop");
            // The law of sines in the triangle of both centers and the contact point.
            let found = drop.half_angle.sin() / (drop.half_angle + degrees.to_radians()).sin();
            assert!((found - radius).abs() < PRINTED, "{degrees}: {found}");
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
