//! The region occupied by one phase at time zero.

use meniscus_core::math::Vec2;
use meniscus_geometry::{Geometry, Wall};

/// A region within the pore, given by the surface that separates it from the other phase.
pub(crate) struct Region {
    /// The surface that separates the phases.
    pub(crate) surface: Geometry,
    /// The region with its walls, where the surface alone does not determine on which side of it a point lies.
    whole: Option<Geometry>,
    /// Area within the pore in m², `None` if it is not known exactly.
    pub(super) area: Option<f64>,
}

impl Region {
    /// The region of closed shapes, which may reach into the solid.
    pub(crate) fn of_shapes(shapes: Geometry) -> Self {
        Self { surface: shapes, whole: None, area: None }
    }

    /// A region bounded by walls and interfaces, `whole`, and its interfaces alone, which may extend slightly into the solid; `area` in m² where it is known.
    pub(crate) fn bounded(whole: Geometry, interfaces: Geometry, area: Option<f64>) -> Self {
        Self { surface: interfaces, whole: Some(whole), area }
    }

    /// Whether a point of the pore (m) lies in the region.
    pub(crate) fn contains(&self, x: Vec2) -> bool {
        self.whole.as_ref().unwrap_or(&self.surface).signed_distance(x) < 0.0
    }

    /// Signed distance in m to the surface, negative in the region; infinite where its nearest part lies behind a wall.
    pub(crate) fn signed_distance(&self, x: Vec2) -> f64 {
        self.unless_behind_wall(self.surface.signed_distance(x), x)
    }

    /// Distance and normal of the surface at a point (m), the normal out of the region.
    pub(crate) fn wall(&self, x: Vec2) -> Wall {
        let wall = self.surface.wall(x);
        let distance = self.unless_behind_wall(wall.distance, x);
        if distance.is_finite() { wall } else { Wall { distance, normal: Vec2::zeros(), ..wall } }
    }

    fn unless_behind_wall(&self, distance: f64, x: Vec2) -> f64 {
        match &self.whole {
            Some(_) if self.contains(x) != (distance < 0.0) => f64::INFINITY.copysign(-distance),
            _ => distance,
        }
    }
}
