//! Rise beside a plate that divides a trough into a narrow and a wide part (C3 of the benchmarks; Jurin's law).

use meniscus_core::solver::{Measure, measure};
use meniscus_sph::measures::Subject;
use meniscus_sph::particles::Phase;

/// Mean rise in m between plates `width` (m) apart: 2 l_c² cos theta/w, exact for the mean (Jurin).
pub(crate) fn jurin_mean_height(width: f64, capillary_length: f64, angle: f64) -> f64 {
    2.0 * capillary_length.powi(2) * angle.cos() / width
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (Some(plate), Some(wetting)) = (s.plates.first(), s.flow.config.method.wetting) else { return vec![] };
    let (flow, bounds, m) = (s.flow, s.flow.config.domain.bounds, &s.flow.config.method);
    let widths = [plate.min.x - bounds.min.x, bounds.max.x - plate.max.x];
    let mut areas = [0.0; 2];
    for a in 0..flow.state.particles.fluids {
        let x = flow.state.particles.position[a];
        // Below the plate both parts are connected; the area there is independent of the levels.
        if flow.state.particles.phase[a] == Phase::Wetting && x.y > plate.min.y {
            if x.x < plate.min.x {
                areas[0] += flow.fields.bulk.volume[a];
            } else if x.x > plate.max.x {
                areas[1] += flow.fields.bulk.volume[a];
            }
        }
    }
    let rise = areas[0] / widths[0] - areas[1] / widths[1];
    let weight = (m.wetting_fluid.density - m.other_fluid.density) * m.gravity.norm();
    let length = (m.tension / weight).sqrt();
    let mean = |width: f64| jurin_mean_height(width, length, wetting.static_angle());
    let exact = mean(widths[0]) - mean(widths[1]);
    vec![
        measure("rise-difference-m", rise, "m")
            .by("mean level (area over width) left of the plate less that right of it, at the end"),
        measure("rise-ratio", rise / exact, "")
            .by("difference of the mean levels over that of Jurin's law on both sides"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_rise_between_plates_is_as_printed() {
        for (degrees, width, height) in
            [(40.0_f64, 0.5, 3.06418), (40.0, 1.0, 1.53209), (60.0, 1.0, 1.0), (60.0, 2.0, 0.5)]
        {
            assert!((jurin_mean_height(width, 1.0, degrees.to_radians()) - height).abs() < 0.6e-5);
        }
    }
}
