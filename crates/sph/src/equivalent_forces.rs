//! Volume forces equivalent to the pressure jump, for output only: the jump itself acts on pairs of particles, not at points.

use crate::flow::Flow;
use crate::surface_force::SurfaceForce;
use crate::terms::curvature;
use crate::wetting::contact_line::MeanLine;
use crate::wetting::lines::{DetectedLine, LINE_REACH, nearest};
use meniscus_case::LineDelta;
use meniscus_core::math::Vec2;

/// σκn and the line force of the paper on the fluid particles in N/m³, with the curvature and the normal of the jump; with the continuum surface force, its
/// own volume forces.
pub fn volume_forces(flow: &Flow) -> [Vec<Vec2>; 2] {
    let (f, h, fluids) = (&flow.fields.interface, flow.config.method.kernel.h, flow.state.particles.fluids);
    if let SurfaceForce::Continuum { surface, line } = &f.force {
        return [surface.clone(), line.clone()];
    }
    let unit_normal = curvature::unit_normal(&f.normal[..fluids], h);
    // A line that the jump does not track is not driven: it has its present angle.
    let angle = |mean: &MeanLine| {
        nearest(&flow.lines, &flow.config.domain, mean.position(), mean.outward(), LINE_REACH * h)
            .map_or_else(|| mean.present(None), |line| line.angle)
    };
    let angles = |lines: &[MeanLine]| lines.iter().map(angle).collect();
    let (flow, normals) = (flow.view().with(&flow.fields.bulk), [&f.normal, &unit_normal[..]]);
    flow.volume_forces(normals, &f.curvature, &vec![1.0; fluids], LineDelta::Normalized, angles)
}
