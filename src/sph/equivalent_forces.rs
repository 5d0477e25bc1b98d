//! The volume forces that the pressure jump stands for, to look at: the jump itself acts on pairs and has no place of its own.

use crate::case::LineDelta;
use crate::math::Vec2;
use crate::sph::flow::Flow;
use crate::sph::terms::{curvature, surface_tension};
use crate::sph::wetting::contact_line::{LineFields, LineParticles};
use crate::sph::wetting::lines::{DetectedLine, LINE_REACH, nearest};

/// σκn [Huber2013, Eq. 20] and the line force [Eqs. 21-23] of the fluid particles in N/m³, with the curvature and the normal
/// that the jump uses; the forces of the flow itself where they are volume forces.
pub fn volume_forces(flow: &Flow) -> (Vec<Vec2>, Vec<Vec2>) {
    let (f, m, p) = (&flow.fields, &flow.setting.method, &flow.state.particles);
    if f.jump.is_none() {
        return (f.surface_force.clone(), f.line_force.clone());
    }
    let (mut surface, mut line) = (vec![Vec2::zeros(); p.fluids], vec![Vec2::zeros(); p.fluids]);
    let weight = vec![1.0; p.fluids];
    surface_tension::surface_force(m.tension, &f.curvature, &f.normal, &weight, &mut surface);
    if m.wetting.is_some() {
        let mut unit_normal = vec![Vec2::zeros(); p.fluids];
        curvature::unit_normal(&f.normal[..p.fluids], m.kernel.h, &mut unit_normal);
        let fields = LineFields {
            position: &p.position,
            velocity: &p.velocity,
            normal: &f.normal,
            unit_normal: &unit_normal,
            wall_distance: &f.wall_distance,
            wall_normal: &f.wall_normal,
            volume: &f.volume,
            weight: &weight,
        };
        let found = LineParticles::find(&flow.neighborhood, &fields, &m.kernel, p.fluids);
        // A line that the jump does not know is not driven: its angle is that which is there.
        let angle = |seen: &dyn DetectedLine| {
            nearest(&f.lines, &flow.setting.domain, seen.place(), seen.outward(), LINE_REACH * m.kernel.h)
                .map_or_else(|| seen.present(None), |line| line.angle)
        };
        let angles: Vec<f64> =
            found.detected_lines(&fields, &flow.setting.domain).iter().map(|seen| angle(seen)).collect();
        found.line_force(&fields, LineDelta::Normalized, &angles, m.tension, &mut line);
    }
    (surface, line)
}
