//! The narrowest passages between solids.
//!
//! Definition. A throat is a pair of wall points such that the disc whose diameter they span contains only pore, at a local minimum of the pore's width along
//! the medial axis: a saddle of the wall distance (`critical`). Its width is the distance of the two points; for discs this is the gap of two neighboring
//! grains on the line of their centers. A passage of constant width is represented by the midpoint of its part in the domain. Only throats whose midpoint
//! lies in the domain count.
//!
//! Walls beyond the sides of the domain count too. The cost is that of sorting the walls.

use crate::critical::CriticalPoints;
use crate::critical::clusters::Coincident;
use crate::critical::walls::{Sides, Walls};
use crate::solid::Geometry;
use meniscus_core::math::Vec2;

/// A narrow passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Throat {
    /// Distance between the walls in m.
    pub width: f64,
    /// The two wall points in m.
    pub ends: [Vec2; 2],
    /// Their midpoint in m.
    pub center: Vec2,
}

impl Geometry {
    /// The narrowest throat, if there is one.
    pub fn narrowest_throat(&self) -> Option<Throat> {
        throats(self).into_iter().next()
    }
}

/// All throats, the narrowest first; for the definition see the top of this module.
pub fn throats(geometry: &Geometry) -> Vec<Throat> {
    let walls = Walls::new(geometry, Sides::Beyond);
    let even = vec![1.0; walls.walls.len()];
    let mut all: Vec<Throat> = CriticalPoints::find(&walls, &even, &[], Coincident::Clusters)
        .saddles
        .iter()
        .map(|at| Throat { width: 2.0 * at.half, ends: at.contacts.map(|c| c.point), center: at.center })
        .collect();
    // The passages are sorted by position, which a stable sort preserves among equal widths.
    all.sort_by(|a, b| a.width.total_cmp(&b.width));
    all
}
