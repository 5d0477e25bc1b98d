//! The volume forces that the pressure jump stands for, to look at: the jump itself acts on pairs and has no place of its own.

use crate::math::Vec2;
use crate::sph::projection::Flow;
use crate::sph::terms::{curvature, surface_tension};
use crate::sph::wetting::contact_line::{LineFields, line_force};

/// σκn [Huber2013, Eq. 20] and the line force [Eqs. 21-23] of the fluid particles in N/m³, with the curvature and the normal
/// that the jump uses; the forces of the flow itself where they are volume forces.
#[must_use]
pub fn volume_forces(flow: &Flow) -> (Vec<Vec2>, Vec<Vec2>) {
    let (f, m, fluids) = (&flow.fields, &flow.method, flow.particles.fluids);
    if f.jump.is_none() {
        return (f.surface_force.clone(), f.line_force.clone());
    }
    let (mut surface, mut line) = (vec![Vec2::zeros(); fluids], vec![Vec2::zeros(); fluids]);
    let weight = vec![1.0; fluids];
    surface_tension::surface_force(m.tension, &f.curvature, &f.normal, &weight, &mut surface);
    if let Some(wetting) = &m.wetting {
        let mut unit_normal = vec![Vec2::zeros(); fluids];
        curvature::unit_normal(&f.normal[..fluids], m.kernel.h, &mut unit_normal);
        let fields = LineFields {
            normal: &f.normal,
            unit_normal: &unit_normal,
            wall_distance: &f.wall_distance,
            wall_normal: &f.wall_normal,
            volume: &f.volume,
            weight: &weight,
        };
        line_force(&flow.pairs, &flow.images, &fields, &m.kernel, (wetting, m.tension), &mut line);
    }
    (surface, line)
}
