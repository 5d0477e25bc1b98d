//! What a measurement needs to know of a wall at a point of the plane.

use crate::math::Vec2;

/// The wall as seen from a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPoint {
    /// Signed distance to the nearest wall in m: above 0 in the pore, below 0 in the solid.
    pub distance: f64,
    /// Unit normal of the nearest wall, pointing into the pore.
    pub normal: Vec2,
}
