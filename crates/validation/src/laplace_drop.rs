//! Laplace jump and parasitic currents of a free drop (B1 of the benchmarks).

use super::moments::Moments;
use super::series::last;
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, measure};
use meniscus_geometry::analysis::phases::{PressureSamples, laplace_jump, resolution_error};
use meniscus_sph::measures::Subject;
use meniscus_sph::observe::sharp_color;

/// Last fraction of the run over which the maximum speed of the parasitic current is taken.
const LAST: f64 = 0.1;

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, fluids) = (s.flow, s.flow.state.particles.fluids);
    let colors = sharp_color(flow);
    let radius = (s.observed.areas.wetting / std::f64::consts::PI).sqrt();
    let samples = PressureSamples {
        points: &flow.state.particles.position[..fluids],
        pressures: &flow.state.particles.pressure[..fluids],
        colors: &colors,
        smoothing_length: flow.config.method.kernel.h,
        period: flow.config.domain.periods(),
    };
    let jump = laplace_jump(&samples, center(s), radius);
    // Between floor and lid the curvature over the depth contributes too.
    let plates = flow.config.method.plates;
    let curvature = plates.map_or(1.0 / radius, |plates| -plates.depth.curvature_of_drop(-1.0 / radius));
    let scale = flow.config.method.tension * curvature;
    let speeds = last(s.series, "max_relative_speed_m_per_s", LAST);
    let speed = speeds.into_iter().map(|(_, speed)| speed).fold(f64::NAN, f64::max);
    let capillary = flow.config.method.wetting_fluid.viscosity * speed / flow.config.method.tension;
    vec![
        measure("laplace-jump-ratio", jump.mean / scale, "")
            .by("mean p over r < R - 3h less mean p over r > R + 3h, over tension/R with R from the drop's area")
            .with_uncertainty(
                jump.error.hypot(resolution_error(jump.mean, flow.config.method.tension, flow.config.method.kernel.h))
                    / scale,
            ),
        measure("parasitic-capillary-number", capillary, "").by(
            "drop viscosity times the largest speed, relative to the mean velocity, of the records in the last tenth \
                 of the run over the tension",
        ),
        measure("radius-scatter-ratio", scatter(s), "")
            .by("standard deviation over mean of the distance of the c = 0.5 contour from the center of the drop"),
    ]
}

/// Standard deviation over mean of the distance of the contour points from the center.
fn scatter(s: &Subject) -> f64 {
    let center = center(s);
    let points = s.observed.interface.iter().flat_map(|line| &line.points);
    let radii: Vec<f64> = points.map(|x| s.flow.config.domain.separation(*x, center).norm()).collect();
    let mean = radii.iter().sum::<f64>() / radii.len() as f64;
    (radii.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / radii.len() as f64).sqrt() / mean
}

/// Center of the drop in m, also if it lies across a periodic side.
fn center(s: &Subject) -> Vec2 {
    Moments::of_wetting_phase(s.flow).center
}
