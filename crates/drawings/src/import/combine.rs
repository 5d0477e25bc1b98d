//! Boolean operations on regions, with exact arcs.

use crate::import::drawing::{FillRule, Ring, shape_of, vertices};
use crate::import::nest::{Region, regions};
use crate::import::nodes::Nodes;
use meniscus_core::math::Bounds;
use meniscus_geometry::body::Body;
use meniscus_geometry::boundary::{difference, intersection, union};
use meniscus_geometry::curve::{Curve, cross};

/// Lengths below this fraction of the size of the drawing count as zero at intersections.
pub(crate) const TOLERANCE: f64 = 1e-9;
/// Ends of curves closer than this many tolerances coincide: they are computed twice, once on each curve.
const JOINED: f64 = 10.0;

/// A region that can be combined with others.
pub(crate) struct Solid(Body);

impl Solid {
    /// The solid of a region with valid rings.
    pub(crate) fn of((outer, holes): &Region) -> Option<Self> {
        // The box is relevant only to infinite shapes.
        let bounds = outer.bounds();
        Body::of(&shape_of(outer.clone(), holes.clone()), 0, bounds).into_iter().next().map(Self)
    }

    /// The solid within a valid ring.
    pub(crate) fn of_ring(ring: &Ring) -> Option<Self> {
        Self::of(&(ring.clone(), Vec::new()))
    }

    /// The box around it.
    pub(crate) fn bounds(&self) -> Bounds {
        self.0.bounds
    }

    /// The difference to the others; `None` if it cannot be determined.
    pub(crate) fn without(&self, others: &[Self], tolerance: f64) -> Option<Vec<Region>> {
        let others: Vec<&Body> = others.iter().map(|other| &other.0).collect();
        closed(&difference(&self.0, &others, tolerance), tolerance)
    }

    /// The intersection of both; `None` if it cannot be determined.
    pub(crate) fn within(&self, other: &Self, tolerance: f64) -> Option<Vec<Region>> {
        closed(&intersection(&self.0, &other.0, tolerance), tolerance)
    }

    /// The union of all; `None` if it cannot be determined.
    pub(crate) fn united(all: &[Self], tolerance: f64) -> Option<Vec<Region>> {
        let bodies: Vec<&Body> = all.iter().map(|one| &one.0).collect();
        let curves: Vec<Curve> = union(&bodies, tolerance).into_iter().map(|piece| piece.curve).collect();
        closed(&curves, tolerance)
    }
}

/// The regions within closed curves, solid on the left of each; `None` if a curve has a dead end.
fn closed(curves: &[Curve], tolerance: f64) -> Option<Vec<Region>> {
    let mut nodes = Nodes::new(JOINED * tolerance);
    let ends: Vec<[usize; 2]> = curves.iter().map(|curve| [0.0, 1.0].map(|u| nodes.number(curve.point(u)))).collect();
    let mut leaving: Vec<Vec<usize>> = vec![Vec::new(); nodes.points.len()];
    (0..curves.len()).for_each(|i| leaving[ends[i][0]].push(i));
    let mut rings = Vec::new();
    for first in 0..curves.len() {
        let mut ring = Ring::default();
        let mut at = first;
        while let Some(slot) = leaving[ends[at][0]].iter().position(|&i| i == at) {
            leaving[ends[at][0]].swap_remove(slot);
            ring.vertices.extend(vertices(&curves[at]));
            if ends[at][1] == ends[first][0] && leaving[ends[at][1]].is_empty() {
                break;
            }
            // Where regions touch in a point the sharpest turn to the left stays in the same region.
            let along = curves[at].tangent(1.0);
            let turn = |i: &usize| {
                let next = curves[*i].tangent(0.0);
                cross(along, next).atan2(along.dot(&next))
            };
            let around = leaving[ends[at][1]].iter().copied().chain((ends[at][1] == ends[first][0]).then_some(first));
            at = around.max_by(|a, b| turn(a).total_cmp(&turn(b)))?;
        }
        if !ring.vertices.is_empty() {
            rings.push(ring);
        }
    }
    Some(regions(&rings, FillRule::EvenOdd))
}

/// The area of regions that do not overlap.
pub(crate) fn area(regions: &[Region]) -> f64 {
    let of = |ring: &Ring| ring.area().abs();
    regions.iter().map(|(outer, holes)| of(outer) - holes.iter().map(of).sum::<f64>()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::drawing::seen;
    use crate::import::nest::circle;
    use meniscus_core::math::Vec2;
    use std::f64::consts::PI;

    fn bar(x: f64, y: f64, width: f64, height: f64) -> Region {
        (seen::bar(x, y, width, height), Vec::new())
    }

    fn disc(x: f64, y: f64, radius: f64) -> Region {
        (circle(Vec2::new(x, y), radius), Vec::new())
    }

    fn solid(region: &Region) -> Solid {
        Solid::of(region).unwrap()
    }

    #[test]
    fn a_channel_through_a_plate_leaves_two_parts_and_a_disc_in_it_a_hole() {
        let plate = solid(&bar(0.0, 0.0, 8.0, 8.0));
        for channel in [bar(0.0, 3.0, 8.0, 2.0), bar(-1.0, 3.0, 10.0, 2.0)] {
            let left = plate.without(&[solid(&channel)], 1e-9).unwrap();
            assert_eq!(left.len(), 2);
            assert!((area(&left) - 48.0).abs() < 1e-12);
            assert!((area(&plate.within(&solid(&channel), 1e-9).unwrap()) - 16.0).abs() < 1e-12);
        }
        let left = plate.without(&[solid(&disc(4.0, 4.0, 2.0))], 1e-9).unwrap();
        assert_eq!((left.len(), left[0].1.len()), (1, 1));
        assert!((area(&left) - (64.0 - 4.0 * PI)).abs() < 1e-12);
        // Half of the disc lies in the plate.
        let left = plate.without(&[solid(&disc(8.0, 4.0, 2.0))], 1e-9).unwrap();
        assert!((area(&left) - (64.0 - 2.0 * PI)).abs() < 1e-12);
        assert!(plate.without(&[solid(&bar(-1.0, -1.0, 10.0, 10.0))], 1e-9).unwrap().is_empty());
        assert!((area(&plate.without(&[solid(&bar(8.0, 0.0, 2.0, 8.0))], 1e-9).unwrap()) - 64.0).abs() < 1e-12);
    }

    #[test]
    fn parts_that_touch_in_a_point_stay_apart() {
        let plate = solid(&bar(0.0, 0.0, 2.0, 2.0));
        let left = plate.without(&[solid(&bar(0.0, 0.0, 1.0, 1.0)), solid(&bar(1.0, 1.0, 1.0, 1.0))], 1e-9).unwrap();
        assert_eq!(left.iter().map(|(outer, holes)| (outer.area(), holes.len())).collect::<Vec<_>>(), [(1.0, 0); 2]);
        // A diamond whose vertices lie on the sides of the plate.
        let tips = [[2.0, 1.0], [1.0, 2.0], [0.0, 1.0], [1.0, 0.0]];
        let diamond = (Ring { vertices: tips.map(|[x, y]| [x, y, 0.0]).to_vec() }, Vec::new());
        let left = plate.without(&[solid(&diamond)], 1e-9).unwrap();
        assert_eq!((left.len(), area(&left)), (4, 2.0));
    }

    #[test]
    fn bars_around_a_pore_are_one_ring_with_a_hole() {
        let bars = [bar(0.0, 0.0, 9.0, 1.0), bar(0.0, 8.0, 9.0, 1.0), bar(0.0, 0.5, 1.0, 8.0), bar(8.0, 0.5, 1.0, 8.0)];
        let all = Solid::united(&bars.each_ref().map(solid), 1e-9).unwrap();
        assert_eq!((all.len(), all[0].1.len()), (1, 1));
        assert!((area(&all) - (81.0 - 49.0)).abs() < 1e-12);
    }
}
