//! Wetting properties and velocity of a wall at a point.

use crate::math::Vec2;
use crate::sph::method::Method;
use crate::wetting::Wetting;

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

/// The properties of the walls of a flow; without a query all are alike and at rest.
#[derive(Default)]
pub struct WallField(Option<WallQuery>);

impl WallField {
    /// Walls with patches or velocities.
    pub(crate) fn new(query: WallQuery) -> Self {
        Self(Some(query))
    }

    /// The wetting model of the wall nearest to `x` (m); `None` if the flow has none.
    pub(crate) fn model(&self, method: &Method, x: Vec2) -> Option<Wetting> {
        let patch = self.0.as_ref().and_then(|query| query(x).patch);
        patch.and_then(|patch| method.patches.get(patch).copied()).or(method.wetting)
    }

    /// Velocity in m/s of the wall nearest to `x` (m).
    pub(crate) fn velocity(&self, x: Vec2) -> Vec2 {
        self.0.as_ref().map_or(Vec2::zeros(), |query| query(x).velocity)
    }
}
