//! The narrowest passages between solids.
//!
//! Definition. A throat is a pair of wall points with nothing but pore in the disc whose diameter they span, at a local
//! minimum of the pore's width along the medial axis: a saddle of the wall distance (`critical`). Its width is the
//! distance of the two points; for discs this is the gap of two neighboring grains on the line of their centers. Where walls run level, the
//! middle of that part of the domain stands for all of it. Only throats whose middle lies in the domain count.
//!
//! Walls count beyond the sides of the domain too. The cost is that of sorting the walls.

use crate::geometry::critical::CriticalPoints;
use crate::geometry::critical::walls::{Sides, Walls};
use crate::geometry::solid::Geometry;
use crate::math::Vec2;

/// A narrow passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Throat {
    /// Distance of the walls in m.
    pub width: f64,
    /// The two wall points in m.
    pub ends: [Vec2; 2],
    /// Their middle in m.
    pub center: Vec2,
}

impl Geometry {
    /// The narrowest throat, if there is one.
    pub fn narrowest_throat(&self) -> Option<Throat> {
        throats(self).into_iter().next()
    }
}

/// All throats, the narrowest first; the definition stands at the top of this module.
pub fn throats(geometry: &Geometry) -> Vec<Throat> {
    let walls = Walls::new(geometry, Sides::Beyond);
    let even = vec![1.0; walls.walls.len()];
    let mut all: Vec<Throat> = CriticalPoints::find(&walls, &even, &[])
        .saddles
        .iter()
        .map(|at| Throat { width: 2.0 * at.half, ends: at.contacts.map(|c| c.point), center: at.center })
        .collect();
    // The passages come sorted by place; those of one width stay so.
    all.sort_by(|a, b| a.width.total_cmp(&b.width));
    all
}
