//! The surface force as a pressure jump.

use crate::boundary::shepard;
use crate::bulk::BulkFields;
use crate::configuration::Configuration;
use crate::images::Field;
use crate::neighborhood::Neighborhood;
use crate::parallel::values;
use crate::surface_force::fields::{InterfaceFields, SurfaceForce};
use crate::surface_force::fit::{AngleAt, Fitted, InterfaceFit};
use crate::surface_force::jump::Jump;
use crate::surface_force::points::interface_points;
use crate::surface_force::stencils::Interface;
use crate::terms::{color, pressure_gradient};
use crate::view::View;
use crate::wetting::lines::{LINE_REACH, TrackedLine, nearest};
use meniscus_core::math::Vec2;

impl View<'_, BulkFields> {
    /// Sides and curvatures for the pressure jump, fitted if no curvature is `given` (1/m); the normal is the consistent gradient of the smoothed
    /// `color`. `sharp` is the color of each particle and image, 0 or 1; `mixed` marks those with both fluids within the support.
    pub(super) fn with_jump(
        &self,
        sharp: Field<f64>,
        color: Field<f64>,
        mixed: &[bool],
        given: Option<f64>,
    ) -> (InterfaceFields, Vec<TrackedLine>) {
        let (Neighborhood { pairs, images }, Configuration { method, domain, .. }) = (self.neighborhood, self.config);
        let (particles, bulk) = (&self.state.particles, self.fields);
        let (fluids, moving) = (particles.fluids, particles.moving());
        let r_ab = |a: usize, b: usize| self.separation(a, b);
        let near = values(moving, |a| {
            let is_mixed = |b: usize| b < moving && mixed[b];
            mixed[a] || pairs.of(a).any(|ab| is_mixed(images.source(ab.b)))
        });
        let normal = color::consistent_gradient(pairs, &bulk.fluid_volume, &near, &color, r_ab);
        let normal = images.reflected_field(normal);
        let moment = pressure_gradient::moment(pairs, &bulk.volume, r_ab, fluids);
        let points = interface_points(self, &color, &normal, &near);
        let (spacing, h) = (method.spacing, method.kernel.h);
        let interface = Interface {
            gradient: method.curvature_gradient(),
            step: self.state.last_dt,
            ..Interface::new(&points, domain, spacing, h, &self.config.wall)
        };
        let (mut lines, mut pinned) = (Vec::new(), Vec::new());
        if method.wetting.is_some() {
            let detected = interface.lines();
            lines = self.followed(&detected);
            pinned.extend(detected.iter().zip(&lines).filter_map(|(line, now)| line.pinned(now.angle)));
        }
        let angle_at = |x: Vec2, outward: Vec2| {
            // Not used without a wetting model.
            let Some(model) = self.config.wetting_at(x) else { return std::f64::consts::FRAC_PI_2 };
            let line = if model.is_static() { None } else { nearest(&lines, domain, x, outward, LINE_REACH * h) };
            line.map_or_else(|| model.static_angle(), |line| line.angle)
        };
        let angle = method.wetting.is_some().then_some(&angle_at as &AngleAt);
        let fit = InterfaceFit { interface: &interface, angle, pinned_lines: &pinned };
        let gradient = if given.is_some() { Vec2::zeros() } else { method.curvature_gradient() };
        let given = given.map(|curvature| Fitted { curvature, constrained: None });
        let side = shepard::into_walls(self.neighborhood, &bulk.fluid_volume, moving, sharp.to_vec());
        let jump = Jump::new(self, &side, gradient, |x| given.or_else(|| fit.at(x)));
        let curvature = jump.curvature[..particles.len()].iter().map(|&k| if k.is_nan() { 0.0 } else { k }).collect();
        let range = |a: usize| {
            let has_wall = bulk.wall_distance[a].is_finite();
            let model = if has_wall { self.config.wetting_at(particles.position[a]) } else { None };
            model.map_or([f64::NAN; 2], |model| model.hysteresis_range())
        };
        let (wall_hysteresis, has_pinned_line) = ((0..fluids).map(range).collect(), !pinned.is_empty());
        let force = SurfaceForce::Jump { jump, moment, wall_hysteresis, has_pinned_line };
        (InterfaceFields { color, normal, curvature, force, ..InterfaceFields::default() }, lines)
    }
}
