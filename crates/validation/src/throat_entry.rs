//! A static meniscus at the largest capillary pressure in a throat (C7 of the benchmarks); between two discs compared with the exact solution.

use std::f64::consts::PI;

use meniscus_core::solver::{Measure, measure};
use meniscus_geometry::analysis::roots::bisect;
use meniscus_sph::measures::Subject;

/// The column with which the entry pressure varies.
const PRESSURE: &str = "capillary_pressure_Pa";

/// Entry curvature p_c*/sigma in 1/m of the throat between two discs with `radii` (m) and centers `distance` (m) apart.
///
/// 1/r* with sqrt(R1² + r² + 2 R1 r cos theta) + sqrt(R2² + r² + 2 R2 r cos theta) = L, `angle` (rad) below 90 degrees or slightly above. `None` if the discs
/// overlap or there is no such arc.
pub(crate) fn entry_curvature(radii: [f64; 2], distance: f64, angle: f64) -> Option<f64> {
    let reach = |r: f64| radii.iter().map(|big| (big * big + r * r + 2.0 * big * r * angle.cos()).sqrt()).sum::<f64>();
    let r = bisect(|r| reach(r) - distance, 1e-12 * distance, 10.0 * distance)?;
    Some(1.0 / r)
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (tension, error) = (s.flow.config.method.tension, s.capillary_pressure_error());
    let found = &s.observed.capillary_pressure;
    let pressure = measure("entry-pressure-Pa", found.value, "Pa")
        .by("capillary pressure p_n - p_w at the end: the entry pressure where the invading phase fills up to its \
             meniscus of largest curvature")
        .with_uncertainty(error)
        .moving_with(PRESSURE, 1.0);
    let ([a, b], Some(wetting)) = (s.discs, s.flow.config.method.wetting) else { return vec![pressure] };
    let distance = (b.center - a.center).norm();
    // The phase at the larger pressure is the invading one; the angle is that through the other one.
    let angle = wetting.static_angle();
    let depth = s.flow.config.method.plates.map(|plates| plates.depth);
    let in_plane = depth.map_or(found.value, |depth| depth.plane(found.value / tension));
    let [defending, sign] = if in_plane < 0.0 { [PI - angle, -1.0] } else { [angle, 1.0] };
    let exact = entry_curvature([a.radius, b.radius], distance, defending).map(|curvature| sign * curvature);
    let entry = exact.map(|exact| tension * depth.map_or(exact, |depth| depth.curvature(exact)));
    let ratio = |pressure: f64| entry.map_or(f64::NAN, |entry| pressure / entry);
    let fitted: Vec<f64> = s.observed.lines_with_angle().map(|line| -line.curvature).collect();
    let curvature = fitted.iter().sum::<f64>() / fitted.len() as f64;
    vec![
        pressure,
        measure("entry-pressure-ratio", ratio(found.value), "")
            .by("capillary pressure at the end over the exact entry pressure of the throat, tension/r*")
            .with_uncertainty(ratio(error).abs())
            .moving_with(PRESSURE, ratio(1.0)),
        measure("entry-curvature-ratio", exact.map_or(f64::NAN, |exact| curvature / exact), "")
            .by("curvature of the fitted meniscus at the end over 1/r*"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entry_curvatures_of_throats_between_discs_are_as_printed() {
        let angles = [0.0, 20.0, 40.0, 60.0, 90.0_f64];
        for (gap, expected) in
            [(0.5, [4.0, 3.80798, 3.26775, 2.49136, 1.33333]), (1.0, [2.0, 1.92014, 1.69707, 1.37980, 0.89443])]
        {
            for (degrees, value) in angles.iter().zip(expected) {
                let found = entry_curvature([1.0, 1.0], 2.0 + gap, degrees.to_radians()).expect("a throat");
                assert!((found - value).abs() < 0.6e-5, "gap {gap}, {degrees} deg: {found}");
            }
        }
        assert_eq!(entry_curvature([1.0, 1.0], 1.9, 0.3), None);
    }
}
