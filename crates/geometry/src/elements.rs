//! Elements of the pore space that contain a point.

use std::f64::consts::PI;

use crate::curve::Curve;
use crate::tree::Tree;
use meniscus_core::math::{Bounds, Vec2};

/// Parts of the plane with exact boundaries, prepared for point queries.
pub struct Elements {
    boundaries: Vec<Vec<Curve>>,
    tree: Tree,
    images: Vec<Vec2>,
}

impl Elements {
    /// Parts with the pore on the right of their `boundaries` (m); `images` are the shifts to periodic images in m, zero first.
    pub fn new(boundaries: Vec<Vec<Curve>>, images: Vec<Vec2>) -> Self {
        let around = |curves: &Vec<Curve>| curves.iter().fold(Bounds::EMPTY, |all, curve| all.united(&curve.bounds()));
        let tree = Tree::over(boundaries.iter().map(around));
        Self { boundaries, tree, images }
    }

    /// The part that contains a point (m); the first one for points on a common boundary.
    pub fn at(&self, x: Vec2) -> Option<usize> {
        let winds =
            |element: usize, x: Vec2| self.boundaries[element].iter().map(|curve| curve.winding(x)).sum::<f64>() < -PI;
        self.images.iter().find_map(|image| {
            let x = x + image;
            self.tree.near_in_order(Bounds { min: x, max: x }).into_iter().find(|&element| winds(element, x))
        })
    }
}
