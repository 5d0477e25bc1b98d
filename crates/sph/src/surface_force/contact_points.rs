//! Intersection of the straight continuation of the interface with the wall, and the limit on the change of its angle towards the contact angle.

use crate::surface_force::points::InterfacePoint;
use crate::surface_force::stencils::Interface;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::interface::weighted_circle::WallFrame;

/// Component of the normal along the wall below which the interface is parallel to it and has no contact line.
const SMALLEST_TANGENT: f64 = 0.1;

/// Largest difference of the imposed angle from the present one, 45 degrees, so that the interface does not tear at starts far from equilibrium.
const LARGEST_PULL: f64 = std::f64::consts::FRAC_PI_4;

/// Intersection of the straight continuation of the interface with the wall.
pub(super) struct ContactPoint {
    /// From the point of the interface to the wall, in m.
    pub(super) contact: Vec2,
    /// Wall normal there.
    pub(super) normal: Vec2,
    /// 1 if ν_ns points to the left of the normal, else -1: constant along a wall, also around its edges.
    pub(super) side: f64,
    /// Distance along the interface to the wall in m.
    pub(super) arc_length: f64,
}

impl Interface<'_> {
    /// The contact point of the straight continuation from `point` to a wall in reach, `None` if the interface is parallel to the wall.
    pub(super) fn contact_point(&self, point: &InterfacePoint) -> Option<ContactPoint> {
        if !point.wall_distance.is_finite() {
            return None;
        }
        let slope = along(point.normal, point.wall_normal).norm();
        if slope < SMALLEST_TANGENT {
            return None;
        }
        let side = -perpendicular(point.wall_normal).dot(&point.normal).signum();
        let arc_length = point.wall_distance.max(0.0) / slope.max(2.0 * SMALLEST_TANGENT);
        // Along the interface towards the wall, then projected onto it.
        let mut down = perpendicular(point.normal);
        if down.dot(&point.wall_normal) > 0.0 {
            down = -down;
        }
        let end = point.x + arc_length * down;
        let (distance, normal) = (self.wall)(end);
        let contact = end - distance * normal - point.x;
        Some(ContactPoint { contact, normal, side, arc_length })
    }
}

/// The contact `angle` in rad limited to the range around the present angle at the `wall` of an interface with the unit `normal`.
pub(super) fn angle_pulled(normal: Vec2, wall: WallFrame, angle: f64) -> f64 {
    let present = (-normal.dot(&wall.outward)).atan2(-normal.dot(&wall.normal));
    angle.clamp(present - LARGEST_PULL, present + LARGEST_PULL)
}

/// The component of `n` tangential to the line with the unit normal `e`.
fn along(n: Vec2, e: Vec2) -> Vec2 {
    n - n.dot(&e) * e
}
