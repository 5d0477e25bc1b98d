//! Walls: velocities, wetting patches, and mirrors.

use std::sync::Arc;

use crate::domain::{ImageVelocity, Mirror};
use crate::wetting::wall::{WallProperties, WallQuery};
use meniscus_case::{PatchedWall, Side, Sph, WettingPatch};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::Geometry;

/// Axis of each side (left, right, bottom, top) and its coordinate along it in m.
pub(super) fn coordinates_of_sides(Bounds { min, max }: Bounds) -> [(usize, f64); 4] {
    [(0, min.x), (0, max.x), (1, min.y), (1, max.y)]
}

pub(super) fn mirrors(bounds: Bounds, sides: [Side; 4]) -> Vec<Mirror> {
    let mirror = |(side, (axis, at)): (Side, (usize, f64))| match side {
        Side::Image => Some(Mirror { axis, at, image: ImageVelocity::Reversed }),
        Side::Symmetry => Some(Mirror { axis, at, image: ImageVelocity::Mirrored }),
        Side::Periodic | Side::Wall | Side::Inlet | Side::Outlet => None,
    };
    sides.into_iter().zip(coordinates_of_sides(bounds)).filter_map(mirror).collect()
}

/// Patches and velocities of the walls; `None` if all walls are alike and at rest.
pub(super) fn wall_properties(sph: &Sph, geometry: &Arc<Geometry>) -> Option<WallQuery> {
    if sph.wetting_patches.is_empty() && sph.wall_speeds == [0.0; 4] {
        return None;
    }
    let (patches, speeds, geometry) = (sph.wetting_patches.clone(), sph.wall_speeds, Arc::clone(geometry));
    Some(Box::new(move |x| {
        let wall = geometry.wall(x);
        // Walls at the sides are numbered after the shapes.
        let side = wall.shape.checked_sub(geometry.shape_count()).filter(|side| *side < 4);
        let velocity = match side {
            Some(side @ (0 | 1)) => Vec2::new(0.0, speeds[side as usize]),
            Some(side) => Vec2::new(speeds[side as usize], 0.0),
            None => Vec2::zeros(),
        };
        let closest = geometry.wrapped(x - wall.distance * wall.normal);
        let lies_there = |patch: &WettingPatch| {
            let on = match patch.on {
                PatchedWall::All => true,
                PatchedWall::Shape(shape) => wall.shape == shape,
                PatchedWall::Side(number) => side == Some(number),
                PatchedWall::Plate(_) => false,
            };
            on && wall.distance.is_finite() && patch.stripes.is_none_or(|stripes| stripes.contains(closest))
        };
        WallProperties { patch: patches.iter().rposition(lies_there), velocity }
    }))
}

/// Velocity of a wall particle in m/s: that of the side behind which it lies, zero behind a corner.
pub(super) fn wall_velocity(speeds: [f64; 4], x: Vec2, bounds: Bounds) -> Vec2 {
    let [left, right, bottom, top] = speeds;
    let behind = |i: usize, lower: f64, upper: f64| match () {
        () if x[i] < bounds.min[i] => Some(lower),
        () if x[i] > bounds.max[i] => Some(upper),
        () => None,
    };
    match (behind(0, left, right), behind(1, bottom, top)) {
        (Some(along), None) => Vec2::new(0.0, along),
        (None, Some(along)) => Vec2::new(along, 0.0),
        _ => Vec2::zeros(),
    }
}
