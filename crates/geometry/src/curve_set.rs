//! The curves of one body or ring, with a tree if there are many: search by position, and for the nearest one.

use std::ops::Deref;

use crate::curve::{ClosestPoint, Curve};
use crate::tree::Tree;
use meniscus_core::math::{Bounds, Vec2};

/// Up to this many curves a plain loop is faster than the tree.
const TREE_FROM: usize = 16;

/// Curves in a fixed order.
#[derive(Clone)]
pub struct CurveSet {
    curves: Vec<Curve>,
    tree: Option<Tree>,
}

impl From<Vec<Curve>> for CurveSet {
    fn from(curves: Vec<Curve>) -> Self {
        let tree = (curves.len() > TREE_FROM).then(|| Tree::over(curves.iter().map(Curve::bounds)));
        Self { curves, tree }
    }
}

impl Deref for CurveSet {
    type Target = [Curve];

    fn deref(&self) -> &[Curve] {
        &self.curves
    }
}

impl CurveSet {
    /// Curves that may intersect the box, in their order: all of them if there are few.
    pub(crate) fn near(&self, bounds: Bounds) -> impl Iterator<Item = &Curve> {
        let found = match &self.tree {
            Some(tree) => tree.near_in_order(bounds),
            None => (0..self.curves.len()).collect(),
        };
        found.into_iter().map(|index| &self.curves[index])
    }

    /// The nearest curve to `x` and the nearest point on it; of equidistant curves the first one.
    pub(crate) fn nearest(&self, x: Vec2) -> Option<(&Curve, ClosestPoint)> {
        let Some(tree) = &self.tree else { return nearest_of(self.curves.iter(), x) };
        let (_, squared) = tree.nearest(x, |index| (self.curves[index].project(x).point - x).norm_squared())?;
        let mut as_near: Vec<usize> = tree.within(x, squared.sqrt()).collect();
        as_near.sort_unstable();
        nearest_of(as_near.into_iter().map(|index| &self.curves[index]), x)
    }

    /// Distance of `x` from the nearest curve in m; infinite without curves.
    pub(crate) fn distance(&self, x: Vec2) -> f64 {
        self.nearest(x).map_or(f64::INFINITY, |(_, closest)| (closest.point - x).norm())
    }

    /// The curves shifted by `by` in m.
    pub(crate) fn shifted(&self, by: Vec2) -> Self {
        self.curves.iter().map(|curve| curve.shifted(by)).collect::<Vec<_>>().into()
    }

    /// The smallest box around all curves.
    pub(crate) fn bounds(&self) -> Bounds {
        self.curves.iter().fold(Bounds::EMPTY, |all, curve| all.united(&curve.bounds()))
    }
}

fn nearest_of<'a>(curves: impl Iterator<Item = &'a Curve>, x: Vec2) -> Option<(&'a Curve, ClosestPoint)> {
    curves
        .map(|curve| (curve, curve.project(x)))
        .min_by(|a, b| (a.1.point - x).norm_squared().total_cmp(&(b.1.point - x).norm_squared()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_curves_equally_near_the_first_is_found_as_by_a_loop() {
        // The spokes of a wheel start at the same distance from its hub.
        let spoke = |k: usize| {
            let t = crate::curve::unit(std::f64::consts::TAU * k as f64 / 64.0);
            Curve::Segment { a: t, b: 2.0 * t }
        };
        let curves: Vec<Curve> = (0..64).map(spoke).collect();
        let set = CurveSet::from(curves.clone());
        for k in 0..500 {
            let x = Vec2::new((0.37 * f64::from(k)).sin(), (0.91 * f64::from(k)).cos()) * 0.01 * f64::from(k);
            let (found, looped) = (set.nearest(x).unwrap(), nearest_of(curves.iter(), x).unwrap());
            assert_eq!((found.0, found.1.point), (looped.0, looped.1.point));
        }
        assert_eq!(set.nearest(Vec2::zeros()).unwrap().0, &curves[nearest_index(&curves)]);
    }

    fn nearest_index(curves: &[Curve]) -> usize {
        let squared = |k: &usize| curves[*k].project(Vec2::zeros()).point.norm_squared();
        (0..curves.len()).min_by(|a, b| squared(a).total_cmp(&squared(b))).unwrap()
    }
}
