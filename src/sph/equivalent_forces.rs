//! The volume forces that the pressure jump stands for, to look at: the jump itself acts on pairs and has no place of its own.

use crate::case::LineDelta;
use crate::math::Vec2;
use crate::sph::flow::Flow;
use crate::sph::surface_force::SurfaceForce;
use crate::sph::terms::curvature;
use crate::sph::wetting::contact_line::MeanLine;
use crate::sph::wetting::lines::{DetectedLine, LINE_REACH, nearest};

/// σκn [Huber2013, Eq. 20] and the line force [Eqs. 21-23] of the fluid particles in N/m³, with the curvature and the normal
/// that the jump uses; the forces of the flow itself where they are volume forces.
pub fn volume_forces(flow: &Flow) -> [Vec<Vec2>; 2] {
    let (f, h, fluids) = (&flow.fields.interface, flow.config.method.kernel.h, flow.state.particles.fluids);
    if let SurfaceForce::Continuum { surface, line } = &f.force {
        return [surface.clone(), line.clone()];
    }
    let unit_normal = curvature::unit_normal(&f.normal[..fluids], h);
    // A line that the jump does not know is not driven: its angle is that which is there.
    let angle = |seen: &MeanLine| {
        nearest(&flow.lines, &flow.config.domain, seen.place(), seen.outward(), LINE_REACH * h)
            .map_or_else(|| seen.present(None), |line| line.angle)
    };
    let angles = |seen: &[MeanLine]| seen.iter().map(angle).collect();
    let (flow, normals) = (flow.view().with(&flow.fields.bulk), [&f.normal, &unit_normal[..]]);
    flow.volume_forces(normals, &f.curvature, &vec![1.0; fluids], LineDelta::Normalized, angles)
}
