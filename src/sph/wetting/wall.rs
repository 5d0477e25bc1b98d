//! What a wall is made of, and how it moves, at a point of it.

use crate::math::Vec2;
use crate::sph::method::Method;
use crate::wetting::Wetting;

/// A wall at a point.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct WallProperties {
    /// Number of the patch that lies there, if one does.
    pub(crate) patch: Option<usize>,
    /// Velocity of the wall in m/s.
    pub(crate) velocity: Vec2,
}

/// What the nearest wall is at a point (m).
pub(crate) type WallQuery = Box<dyn Fn(Vec2) -> WallProperties + Send + Sync>;

/// The walls of a flow; without a query all are alike and at rest.
#[derive(Default)]
pub struct WallField(Option<WallQuery>);

impl WallField {
    /// Walls that differ or move.
    pub(crate) fn new(query: WallQuery) -> Self {
        Self(Some(query))
    }

    /// The wetting model of the wall nearest to `x` (m); none where the flow has none.
    pub(crate) fn model(&self, method: &Method, x: Vec2) -> Option<Wetting> {
        let patch = self.0.as_ref().and_then(|query| query(x).patch);
        patch.and_then(|patch| method.patches.get(patch).copied()).or(method.wetting)
    }

    /// Velocity in m/s of the wall nearest to `x` (m).
    pub(crate) fn velocity(&self, x: Vec2) -> Vec2 {
        self.0.as_ref().map_or(Vec2::zeros(), |query| query(x).velocity)
    }
}
