//! Where the interface, continued straight, meets the wall, and how far its angle there is pulled to the contact angle at once.

use crate::interface::weighted_circle::WallFrame;
use crate::math::{Vec2, perpendicular};
use crate::sph::surface_force::points::InterfacePoint;
use crate::sph::surface_force::stencils::Interface;

/// Share of the normal along the wall below which the interface runs parallel to it and has no contact line.
const SMALLEST_TANGENT: f64 = 0.1;

/// Largest difference of the angle used from the present one, so that far starts move and do not tear: 45 degrees.
const LARGEST_PULL: f64 = std::f64::consts::FRAC_PI_4;

/// Where the straight continuation of the interface meets the wall.
pub(super) struct ContactPoint {
    /// From the point of the interface to the wall, in m.
    pub(super) contact: Vec2,
    /// Wall normal there.
    pub(super) normal: Vec2,
    /// 1 where ν_ns lies to the left of the normal, else -1: the same all along a wall, around its edges too.
    pub(super) side: f64,
    /// Way along the interface to the wall in m.
    pub(super) way: f64,
}

impl Interface<'_> {
    /// The straight way from `point` to a wall in reach, none where the interface runs along the wall.
    pub(super) fn contact_point(&self, point: &InterfacePoint) -> Option<ContactPoint> {
        if !point.wall_distance.is_finite() {
            return None;
        }
        let slope = along(point.normal, point.wall_normal).norm();
        if slope < SMALLEST_TANGENT {
            return None;
        }
        let side = -perpendicular(point.wall_normal).dot(&point.normal).signum();
        let way = point.wall_distance.max(0.0) / slope.max(2.0 * SMALLEST_TANGENT);
        // Down along the interface to the wall, then onto it.
        let mut down = perpendicular(point.normal);
        if down.dot(&point.wall_normal) > 0.0 {
            down = -down;
        }
        let end = point.x + way * down;
        let (distance, normal) = (self.wall)(end);
        let contact = end - distance * normal - point.x;
        Some(ContactPoint { contact, normal, side, way })
    }
}

/// The contact angle in rad as far as an interface with the unit `normal` is pulled towards it at once, at the `wall`.
pub(super) fn angle_pulled(normal: Vec2, wall: WallFrame, angle: f64) -> f64 {
    let present = (-normal.dot(&wall.outward)).atan2(-normal.dot(&wall.normal));
    angle.clamp(present - LARGEST_PULL, present + LARGEST_PULL)
}

/// The part of `n` along the line with the unit normal `e`.
fn along(n: Vec2, e: Vec2) -> Vec2 {
    n - n.dot(&e) * e
}
