//! Points of the interface, where the smoothed color crosses 1/2 between two neighboring particles.

use crate::bulk::BulkFields;
use crate::domain::Domain;
use crate::images::Field;
use crate::neighborhood::Neighborhood;
use crate::view::View;
use meniscus_core::math::Vec2;

/// Pairs closer than this, in units of dx, are used: nearest and diagonal neighbors of the lattice. Their weight vanishes at this distance.
const LINK: f64 = 1.8;

/// Color gradient, in units of 1/h, below which there is no interface.
const SMALLEST_GRADIENT: f64 = 0.05;

/// A particle closer to a wall than this, in units of dx, touches it.
const TOUCHING: f64 = 1.2;

/// Level of the smoothed color at the interface.
const LEVEL: f64 = 0.5;

/// A point of the interface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct InterfacePoint {
    /// Position in m.
    pub(crate) x: Vec2,
    /// Unit normal into the wetting phase.
    pub(crate) normal: Vec2,
    /// Velocity in m/s.
    pub(crate) velocity: Vec2,
    /// Distance to the wall in m, infinite if none is in reach.
    pub(crate) wall_distance: f64,
    /// Wall normal into the fluid, zero if none is in reach.
    pub(crate) wall_normal: Vec2,
    /// Whether both phases touch the wall in the neighborhood: with a film between interface and wall there is no contact line.
    pub(crate) touches: bool,
    /// Weight in means and fits, which vanishes continuously with the distance of the two particles.
    pub(crate) weight: f64,
}

/// All interface points between moving particles, with images near mirrors, from the smoothed color and its consistent `gradient` in 1/m; `near`
/// marks moving particles whose smoothed color, or that of a neighbor, is neither 0 nor 1.
pub(crate) fn interface_points(
    flow: &View<BulkFields>,
    color: &Field<f64>,
    gradient: &Field<Vec2>,
    near: &[bool],
) -> Vec<InterfacePoint> {
    let velocity = flow.velocity();
    let (Neighborhood { pairs, images }, moving) = (flow.neighborhood, flow.state.particles.moving());
    let (spacing, h) = (flow.config.method.spacing, flow.config.method.kernel.h);
    let mut points = Vec::new();
    let link2 = (LINK * spacing).powi(2);
    for a in (0..moving).filter(|&a| near[a]) {
        let c_a = color[a] - LEVEL;
        for ab in pairs.of(a) {
            let source = images.source(ab.b);
            let is_image = source != ab.b;
            // Each pair once, pairs with an image from the particle.
            if source >= moving || (!is_image && ab.b < a) {
                continue;
            }
            let c_b = color[ab.b] - LEVEL;
            if (c_a > 0.0) == (c_b > 0.0) {
                continue;
            }
            let x_a = flow.state.particles.position[a];
            let r_ba = -flow.separation(a, ab.b);
            let f = c_a / (c_a - c_b);
            let g = (1.0 - f) * gradient[a] + f * gradient[ab.b];
            let closeness = 1.0 - r_ba.norm_squared() / link2;
            if closeness > 0.0 && g.norm() > SMALLEST_GRADIENT / h {
                let (wall_distance, wall_normal) = wall_between(flow.fields, a, source, f);
                let velocity = (1.0 - f) * velocity[a] + f * velocity[ab.b];
                let (x, normal) = (x_a + f * r_ba, g.normalize());
                let touches = wall_distance.is_finite() && both_touch(flow, color, a, source);
                let weight = closeness.powi(2);
                points.push(InterfacePoint { x, normal, velocity, wall_distance, wall_normal, touches, weight });
            }
        }
    }
    reflect(&mut points, &flow.config.domain, 3.0 * h);
    points
}

/// Whether particles of both phases touch the wall around `a` or `b`, by the smoothed color, which filters isolated particles.
fn both_touch(flow: &View<BulkFields>, color: &[f64], a: usize, b: usize) -> bool {
    let (Neighborhood { pairs, images }, spacing) = (flow.neighborhood, flow.config.method.spacing);
    let phase = |i: usize| {
        let touches = flow.fields.wall_distance.get(i).is_some_and(|d| *d < TOUCHING * spacing);
        touches.then(|| color[i] > LEVEL)
    };
    [a, b].into_iter().any(|i| {
        let around = pairs.of(i).filter_map(|ij| phase(images.source(ij.b))).chain(phase(i));
        let (mut wetting, mut other) = (false, false);
        for is_wetting in around {
            wetting |= is_wetting;
            other |= !is_wetting;
        }
        wetting && other
    })
}

/// Wall distance and normal interpolated between a and b at the fraction `f`.
fn wall_between(fields: &BulkFields, a: usize, b: usize, f: f64) -> (f64, Vec2) {
    let (d_a, d_b) = (fields.wall_distance[a], fields.wall_distance[b]);
    match (d_a.is_finite(), d_b.is_finite()) {
        (true, true) => {
            let normal = (1.0 - f) * fields.wall_normal[a] + f * fields.wall_normal[b];
            // The normals of opposite walls cancel: use the nearer one.
            let nearer = if d_a < d_b { fields.wall_normal[a] } else { fields.wall_normal[b] };
            ((1.0 - f) * d_a + f * d_b, normal.try_normalize(0.5).unwrap_or(nearer))
        }
        (true, false) => (d_a, fields.wall_normal[a]),
        (false, true) => (d_b, fields.wall_normal[b]),
        (false, false) => (f64::INFINITY, Vec2::zeros()),
    }
}

fn reflect(points: &mut Vec<InterfacePoint>, domain: &Domain, reach: f64) {
    for mirror in &domain.mirrors {
        for i in 0..points.len() {
            let point = points[i];
            if (point.x[mirror.axis] - mirror.at).abs() < reach {
                let x = mirror.position(point.x);
                let (normal, wall_normal) = (mirror.reflect(point.normal), mirror.reflect(point.wall_normal));
                let velocity = mirror.velocity(point.velocity);
                points.push(InterfacePoint { x, normal, velocity, wall_normal, ..point });
            }
        }
    }
}
