//! A bounding volume hierarchy: items near a point, and the nearest one, in logarithmic time.
//!
//! It wraps parry's hierarchy of bounding volumes, and is the only search structure of this module: over bodies, the curves of a body, the pieces of a
//! surface, and the edges of rings. Unbounded items are near every point and are kept outside the tree.

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhNode};

use meniscus_core::math::{Bounds, Vec2};

/// A tree over items given by index and box.
#[derive(Clone)]
pub struct Tree {
    bvh: Bvh,
    /// The item of each leaf.
    leaves: Vec<u32>,
    /// Items with an unbounded box.
    endless: Vec<u32>,
}

impl Tree {
    /// The tree over items with these boxes, in m; an empty box (its lower corner above its upper one) is never found.
    pub fn over(boxes: impl IntoIterator<Item = Bounds>) -> Self {
        let (mut leaves, mut endless, mut finite) = (Vec::new(), Vec::new(), Vec::new());
        for (index, b) in (0_u32..).zip(boxes) {
            let is_finite = b.min.iter().chain(b.max.iter()).all(|v| v.is_finite());
            if is_finite {
                leaves.push(index);
                finite.push(Aabb::new(Vector::new(b.min.x, b.min.y), Vector::new(b.max.x, b.max.y)));
            } else if (0..2).all(|i| b.min[i] <= b.max[i]) {
                endless.push(index);
            }
        }
        Self { bvh: Bvh::from_leaves(BvhBuildStrategy::Binned, &finite), leaves, endless }
    }

    /// Items whose box overlaps `near`, in tree order.
    pub fn near(&self, near: Bounds) -> impl Iterator<Item = usize> {
        let leaves = self.bvh.leaves(move |node| {
            let (min, max) = (node.mins(), node.maxs());
            min.x <= near.max.x && near.min.x <= max.x && min.y <= near.max.y && near.min.y <= max.y
        });
        let finite = leaves.filter_map(|leaf| self.leaves.get(leaf as usize));
        self.endless.iter().chain(finite).map(|&index| index as usize)
    }

    /// The same items in the order of their index.
    pub fn near_in_order(&self, near: Bounds) -> Vec<usize> {
        let mut found: Vec<usize> = self.near(near).collect();
        found.sort_unstable();
        found
    }

    /// Items whose box is within `reach` (m) of `x`, up to rounding, in tree order.
    pub(crate) fn within(&self, x: Vec2, reach: f64) -> impl Iterator<Item = usize> {
        // Slightly enlarged, so that rounding of a box excludes nothing.
        let most = reach * reach * (1.0 + 1e-12);
        let leaves = self.bvh.leaves(move |node| squared_distance(x, node) <= most);
        let finite = leaves.filter_map(|leaf| self.leaves.get(leaf as usize));
        self.endless.iter().chain(finite).map(|&index| index as usize)
    }

    /// The bounded item with the smallest squared distance (m²) from `x`, and that distance; `squared` returns it by index.
    pub(crate) fn nearest(&self, x: Vec2, squared: impl Fn(usize) -> f64) -> Option<(usize, f64)> {
        let of_leaf = |leaf: u32| self.leaves.get(leaf as usize).map(|&index| squared(index as usize));
        let (leaf, least) =
            self.bvh.find_best(f64::MAX, |node, _| squared_distance(x, node), |leaf, _| of_leaf(leaf))?;
        Some((*self.leaves.get(leaf as usize)? as usize, least))
    }
}

/// Squared distance in m² from `x` to the box of a node.
fn squared_distance(x: Vec2, node: &BvhNode) -> f64 {
    let (min, max) = (node.mins(), node.maxs());
    let (dx, dy) = ((min.x - x.x).max(x.x - max.x).max(0.0), (min.y - x.y).max(x.y - max.y).max(0.0));
    dx * dx + dy * dy
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64) -> Bounds {
        Bounds { min: Vec2::new(x, y), max: Vec2::new(x + 0.5, y + 0.5) }
    }

    #[test]
    fn a_tree_of_any_size_finds_what_a_loop_finds() {
        for count in [0, 1, 2, 3, 100] {
            let boxes: Vec<Bounds> = (0..count).map(|k| square(f64::from(k % 10), f64::from(k / 10))).collect();
            let tree = Tree::over(boxes.iter().copied());
            let near = Bounds { min: Vec2::new(0.4, 0.6), max: Vec2::new(3.0, 4.2) };
            let looped: Vec<usize> = (0..boxes.len()).filter(|&i| boxes[i].overlaps(&near)).collect();
            assert_eq!(tree.near_in_order(near), looped);
            let x = Vec2::new(4.7, 3.1);
            let squared = |i: usize| (boxes[i].center() - x).norm_squared();
            let least = (0..boxes.len()).map(squared).min_by(f64::total_cmp);
            assert_eq!(tree.nearest(x, squared).map(|found| found.1), least);
        }
    }

    #[test]
    fn things_without_end_are_near_everywhere_and_empty_ones_nowhere() {
        let all = Bounds { min: Vec2::repeat(f64::NEG_INFINITY), max: Vec2::repeat(f64::INFINITY) };
        let none = Bounds { min: all.max, max: all.min };
        let tree = Tree::over([square(0.0, 0.0), all, none, square(3.0, 0.0)]);
        assert_eq!(tree.near_in_order(square(3.1, 0.1)), [1, 3]);
        assert_eq!(tree.near_in_order(square(9.0, 9.0)), [1]);
    }
}
