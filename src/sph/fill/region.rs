//! The region that one phase fills at time zero.

use crate::geometry::{Geometry, Wall};
use crate::math::Vec2;

/// A region within the pore, by the surface that parts it from the other phase.
pub(crate) struct Region {
    surface: Geometry,
    /// The region with its walls, where the surface alone does not tell which side of it a point lies on.
    whole: Option<Geometry>,
    area: Option<f64>,
}

impl Region {
    /// The region of closed shapes, which may reach into the solid.
    pub(crate) fn of_shapes(shapes: Geometry) -> Self {
        Self { surface: shapes, whole: None, area: None }
    }

    /// The region bounded by walls and interfaces, `whole`, and its interfaces alone, which may reach a little into the solid; its area in m²
    /// where it is known.
    pub(crate) fn bounded(whole: Geometry, interfaces: Geometry, area: Option<f64>) -> Self {
        Self { surface: interfaces, whole: Some(whole), area }
    }

    /// Its area within the pore in m², where it is known exactly.
    pub(crate) fn area(&self) -> Option<f64> {
        self.area
    }

    /// The surface that parts both phases.
    pub(crate) fn surface(&self) -> &Geometry {
        &self.surface
    }

    /// Whether a point of the pore (m) lies in the region.
    pub(crate) fn holds(&self, x: Vec2) -> bool {
        self.whole.as_ref().unwrap_or(&self.surface).signed_distance(x) < 0.0
    }

    /// Signed distance in m to the surface, below 0 in the region; infinite where the nearest part of it is seen through a wall.
    pub(crate) fn signed_distance(&self, x: Vec2) -> f64 {
        self.seen(self.surface.signed_distance(x), x)
    }

    /// Distance and normal of the surface at a point (m), the normal out of the region.
    pub(crate) fn wall(&self, x: Vec2) -> Wall {
        let wall = self.surface.wall(x);
        let distance = self.seen(wall.distance, x);
        if distance.is_finite() { wall } else { Wall { distance, normal: Vec2::zeros(), ..wall } }
    }

    fn seen(&self, distance: f64, x: Vec2) -> f64 {
        match &self.whole {
            Some(_) if self.holds(x) != (distance < 0.0) => f64::INFINITY.copysign(-distance),
            _ => distance,
        }
    }
}
