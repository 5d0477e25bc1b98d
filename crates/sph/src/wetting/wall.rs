//! Wetting properties and velocity of a wall at a point.

use meniscus_core::math::Vec2;

/// Properties of a wall at a point.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct WallProperties {
    /// Number of the patch there, if there is one.
    pub(crate) patch: Option<usize>,
    /// Velocity of the wall in m/s.
    pub(crate) velocity: Vec2,
}

/// The properties of the wall nearest to a point (m).
pub(crate) type WallQuery = Box<dyn Fn(Vec2) -> WallProperties + Send + Sync>;
