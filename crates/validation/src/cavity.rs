//! Extreme velocities on the center lines of a cavity whose top wall moves (A4 of the benchmarks).

use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, measure};
use meniscus_geometry::analysis::resample::Stencils;
use meniscus_sph::measures::Subject;
use meniscus_sph::observe::fluid_samples;

/// Points on a center line: much denser than the particles, to resolve the extremum.
const POINTS: usize = 400;

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, bounds) = (s.flow, s.flow.config.domain.bounds);
    let lid = s.wall_speeds[3];
    let velocity = &flow.state.particles.velocity[..flow.state.particles.fluids];
    let on_line = |axis: usize| {
        let at = |i: usize| {
            let mut x: Vec2 = bounds.center();
            x[axis] = bounds.min[axis] + (i as f64 + 0.5) / POINTS as f64 * bounds.size()[axis];
            x
        };
        let nodes: Vec<Vec2> = (0..POINTS).map(at).collect();
        Stencils::new(&fluid_samples(flow), &nodes).vector(velocity)
    };
    let (upright, level) = (on_line(1), on_line(0));
    let u = upright.iter().map(|v| v.x / lid).fold(f64::NAN, f64::min);
    let [least, most] = [f64::min, f64::max].map(|pick| level.iter().map(|v| v.y / lid).fold(f64::NAN, pick));
    vec![
        measure("u-min", u, "").by("least velocity along the lid on the upright center line, over that of the lid"),
        measure("v-max", most, "").by("largest upward velocity on the level center line, over that of the lid"),
        measure("v-min", least, "").by("least upward velocity on the level center line, over that of the lid"),
    ]
}
