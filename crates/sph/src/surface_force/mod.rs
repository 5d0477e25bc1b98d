//! The two forms of the surface force, with a common interface.
//!
//! [`SurfaceForce::Csf`](meniscus_case::SurfaceForce) is that of the paper: a volume force in a band, with the contact line force. In
//! [`SurfaceForce::PressureJump`](meniscus_case::SurfaceForce) the jump σκ enters the pressure differences across the interface, as in the ghost
//! fluid method (Fedkiw et al. 1999; Kang et al. 2000), and the wetting law gives the angle at which the interface meets the wall.
//!
//! Each of these modules uses those before it: `points` of the interface between particles; `stencils`, the points around a position;
//! `contact_points`, where the interface meets a wall; `detected_lines`, its contact lines; `pinned_lines`, those at edges of walls; `fit`, its
//! curvature; `jump`, which applies it to pairs. The geometry of the circles is in [`interface`](meniscus_geometry::interface).

mod contact_points;
pub(crate) mod continuum;
pub(crate) mod detected_lines;
mod fields;
pub(crate) mod fit;
pub(crate) mod jump;
pub(crate) mod pinned_lines;
pub(crate) mod points;
mod pressure_jump;
pub(crate) mod stencils;

pub(crate) use self::fields::{InterfaceFields, SurfaceForce};
use crate::bulk::BulkFields;
use crate::neighborhood::Neighborhood;
use crate::parallel::values;
use crate::particles::Phase;
use crate::terms::color;
use crate::view::View;
use crate::wetting::lines::TrackedLine;
use meniscus_case::SurfaceForce as Formulation;

/// The fields of the interface and the present contact lines.
pub(crate) fn interface_fields(flow: &View<BulkFields>) -> (InterfaceFields, Vec<TrackedLine>) {
    let (Neighborhood { pairs, images }, method) = (flow.neighborhood, &flow.config.method);
    let (n, moving, phase) = (flow.state.particles.len(), flow.state.particles.moving(), &flow.state.particles.phase);
    let sharp = images.field(phase.iter().map(|p: &Phase| p.color()).collect());
    let (mut found, mut lines) = (InterfaceFields::default(), Vec::new());
    if method.tension == 0.0 {
        (found.color, found.normal, found.curvature) = (sharp, images.field(Vec::new()), vec![0.0; n]);
    } else {
        // Whether both fluids are within the support; also true on walls, which have no color of their own.
        let mixed = values(n, |a| {
            let is_other = |b: usize| b < moving && phase[b] != phase[a];
            a >= moving || pairs.of(a).any(|ab| is_other(images.source(ab.b)))
        });
        let color = images.field(color::smoothed_color(pairs, &flow.fields.fluid_volume, &sharp, &mixed));
        (found, lines) = match method.surface_force {
            Formulation::Csf { line_delta } => flow.with_continuum_force(color, line_delta),
            Formulation::PressureJump { curvature } => flow.with_jump(sharp, color, &mixed, curvature),
        };
    }
    found.slip_length = slip_lengths(flow, &lines);
    (found, lines)
}

/// The slip length in m of the wall next to each fluid particle, with that of contact lines near the `lines`.
fn slip_lengths(flow: &View<BulkFields>, lines: &[TrackedLine]) -> Vec<f64> {
    let (particles, config) = (&flow.state.particles, flow.config);
    values(particles.fluids, |a| {
        let distance = |line: &TrackedLine| config.domain.separation(particles.position[a], line.position).norm();
        let has_wall = flow.fields.wall_distance[a].is_finite();
        let nearest = lines.iter().filter(|_| has_wall).map(distance).fold(f64::INFINITY, f64::min);
        config.method.no_slip.slip_length_at(nearest)
    })
}
