//! Continuum surface force of the paper: volume forces in a band around the interface.

use crate::bulk::BulkFields;
use crate::images::Field;
use crate::neighborhood::Neighborhood;
use crate::surface_force::fields::{InterfaceFields, SurfaceForce};
use crate::terms::{color, curvature, surface_tension};
use crate::view::View;
use crate::wetting::contact_line::{LineFields, LineParticles, MeanLine};
use crate::wetting::lines::TrackedLine;
use meniscus_case::LineDelta;
use meniscus_core::math::Vec2;

impl View<'_, BulkFields> {
    /// Normals and curvature in a band, surface force and line force of the paper.
    pub(super) fn with_continuum_force(
        &self,
        color: Field<f64>,
        delta: LineDelta,
    ) -> (InterfaceFields, Vec<TrackedLine>) {
        let (Neighborhood { pairs, images }, method, bulk) = (self.neighborhood, &self.config.method, self.fields);
        let (fluids, moving) = (self.state.particles.fluids, self.state.particles.moving());
        let normal = color::color_gradient(pairs, &bulk.fluid_volume, &color, moving);
        let unit_normal = images.reflected_field(curvature::unit_normal(&normal, method.kernel.h));
        let normal = images.reflected_field(normal);
        let mut curvature = curvature::curvature(pairs, &bulk.fluid_volume, &unit_normal, moving);
        curvature.resize(self.state.particles.len(), 0.0);
        let profile = method.profile();
        let weight: Vec<f64> = bulk.density[..fluids].iter().map(|&rho| method.force_weight(rho / profile)).collect();
        let mut lines = Vec::new();
        let [surface, line] = self.volume_forces([&normal, &unit_normal], &curvature, &weight, delta, |detected| {
            lines = self.followed(detected);
            lines.iter().map(|line| line.angle).collect()
        });
        let force = SurfaceForce::Continuum { surface, line };
        (InterfaceFields { color, normal, curvature, force, ..InterfaceFields::default() }, lines)
    }

    /// σκn ([`surface_tension::surface_force`]) and the line force ([`LineParticles::line_force`]) on the fluid particles in N/m³, from n and n̂, κ and the
    /// weights of the forces; `angles` returns the contact angles in rad imposed at the detected lines.
    pub(crate) fn volume_forces(
        &self,
        [normal, unit_normal]: [&[Vec2]; 2],
        curvature: &[f64],
        weight: &[f64],
        delta: LineDelta,
        angles: impl FnOnce(&[MeanLine]) -> Vec<f64>,
    ) -> [Vec<Vec2>; 2] {
        let (particles, method, bulk) = (&self.state.particles, &self.config.method, self.fields);
        let with_plates: Option<Vec<f64>> =
            method.plates.map(|plates| curvature.iter().map(|&k| -plates.depth.curvature(-k)).collect());
        let curvature = with_plates.as_deref().unwrap_or(curvature);
        let surface = surface_tension::surface_force(method.tension, curvature, normal, weight);
        let mut line = vec![Vec2::zeros(); particles.fluids];
        if method.wetting.is_some() {
            let fields = LineFields {
                position: &particles.position,
                velocity: &particles.velocity,
                normal,
                unit_normal,
                wall_distance: &bulk.wall_distance,
                wall_normal: &bulk.wall_normal,
                volume: &bulk.volume,
                weight,
            };
            let found = LineParticles::find(self.neighborhood, &fields, &method.kernel, particles.fluids);
            let angles = angles(&found.detected_lines(&fields, &self.config.domain));
            line = found.line_force(&fields, delta, &angles, method.tension);
        }
        [surface, line]
    }
}
