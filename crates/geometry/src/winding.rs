//! Winding numbers of closed rings of segments and arcs.
//!
//! From outside the box around a part of a ring, that part subtends the same angle as its chord: both form a closed loop that does not enclose the point. A
//! tree of boxes over consecutive edges thus gives the winding number from the few edges whose boxes contain the point. No ray is cast, so that vertices and
//! tangents need no special treatment (the idea of the hierarchical winding numbers of Jacobson et al. 2013, here without approximation).

use crate::curve::{Curve, cross};
use meniscus_core::math::{Bounds, Vec2};

/// Number of consecutive edges that are not divided further.
const LEAF: usize = 4;

/// Consecutive edges of a ring.
#[derive(Clone)]
struct Part {
    bounds: Bounds,
    /// First point and last point in m.
    ends: [Vec2; 2],
    /// The edges, from the first to before the last.
    edges: std::ops::Range<usize>,
    /// The second half; the first half follows this part in the list. `None` for few edges.
    second: Option<usize>,
}

/// Closed rings, prepared for queries.
#[derive(Clone)]
pub(crate) struct Winding {
    curves: Vec<Curve>,
    parts: Vec<Part>,
    /// The part that is a whole ring, for each ring.
    rings: Vec<usize>,
}

impl Winding {
    /// Prepares closed rings, each a chain of edges whose last one ends at the start of the first.
    pub(crate) fn of(rings: impl IntoIterator<Item = Vec<Curve>>) -> Self {
        let mut winding = Self { curves: Vec::new(), parts: Vec::new(), rings: Vec::new() };
        for ring in rings.into_iter().filter(|ring| !ring.is_empty()) {
            let first = winding.curves.len();
            winding.curves.extend(ring);
            let root = winding.divide(first..winding.curves.len());
            winding.rings.push(root);
        }
        winding
    }

    /// Adds the part of these edges with all below it and returns its index.
    fn divide(&mut self, edges: std::ops::Range<usize>) -> usize {
        let index = self.parts.len();
        let (a, b) = (&self.curves[edges.start], &self.curves[edges.end - 1]);
        let part = Part { bounds: a.bounds(), ends: [a.point(0.0), b.point(1.0)], edges: edges.clone(), second: None };
        self.parts.push(part);
        if edges.len() > LEAF {
            let middle = edges.start + edges.len() / 2;
            let first = self.divide(edges.start..middle);
            let second = self.divide(middle..edges.end);
            self.parts[index].second = Some(second);
            self.parts[index].bounds = self.parts[first].bounds.united(&self.parts[second].bounds);
        } else {
            let all = self.curves[edges].iter().map(Curve::bounds);
            self.parts[index].bounds = all.fold(self.parts[index].bounds, |a, b| a.united(&b));
        }
        index
    }

    /// The winding number about `x`, positive counter-clockwise; an integer off the rings.
    pub(crate) fn turns(&self, x: Vec2) -> f64 {
        self.rings.iter().map(|&ring| self.angle(ring, x)).sum::<f64>() / std::f64::consts::TAU
    }

    /// The signed angle in rad that a part subtends at `x`.
    fn angle(&self, part: usize, x: Vec2) -> f64 {
        let Part { bounds, ends, edges, second } = &self.parts[part];
        if !bounds.contains(x) {
            let (a, b) = (ends[0] - x, ends[1] - x);
            return cross(a, b).atan2(a.dot(&b));
        }
        match second {
            Some(second) => self.angle(part + 1, x) + self.angle(*second, x),
            None => self.curves[edges.clone()].iter().map(|curve| curve.winding(x)).sum(),
        }
    }

    /// The rings shifted by `by` in m.
    pub(crate) fn shifted(&self, by: Vec2) -> Self {
        let shift = |part: &Part| Part {
            bounds: Bounds { min: part.bounds.min + by, max: part.bounds.max + by },
            ends: part.ends.map(|end| end + by),
            ..part.clone()
        };
        Self {
            curves: self.curves.iter().map(|curve| curve.shifted(by)).collect(),
            parts: self.parts.iter().map(shift).collect(),
            rings: self.rings.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::unit;

    /// A flower of `petals` arcs, each more than a half circle.
    fn flower(petals: usize) -> Vec<Curve> {
        let tip = |k: usize| unit(std::f64::consts::TAU * k as f64 / petals as f64);
        (0..petals).map(|k| Curve::from_bulge(tip(k), tip((k + 1) % petals), 1.3)).collect()
    }

    #[test]
    fn the_tree_turns_as_the_sum_over_all_edges_does() {
        let (outer, hole) = (
            flower(200),
            flower(150).into_iter().rev().map(|c| {
                let Curve::Arc { center, radius, start, sweep } = c.reversed() else { return c };
                Curve::Arc { center: 0.5 * center, radius: 0.5 * radius, start, sweep }
            }),
        );
        let hole: Vec<Curve> = hole.collect();
        let winding = Winding::of([outer.clone(), hole.clone()]);
        for k in 0..2000 {
            let x = unit(0.7 * f64::from(k)) * (1.2 * (0.37 * f64::from(k)).sin());
            let looped: f64 = outer.iter().chain(&hole).map(|c| c.winding(x)).sum();
            assert!((winding.turns(x) - looped / std::f64::consts::TAU).abs() < 1e-9, "{x}");
        }
        assert!(winding.turns(Vec2::zeros()).abs() < 1e-9);
        assert!((winding.turns(Vec2::new(0.8, 0.0)) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn level_with_a_vertex_and_beside_a_tangent_the_number_of_turns_is_right() {
        // A stadium: rays along its straight sides and through its joints contain vertices and tangents only.
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(Vec2::from);
        let bulges = [0.0, 1.0, 0.0, 1.0];
        let ring: Vec<Curve> = (0..4).map(|k| Curve::from_bulge(corners[k], corners[(k + 1) % 4], bulges[k])).collect();
        let winding = Winding::of([ring]);
        for (x, turns) in [
            ([-1.9, -1.0], 0.0),
            ([-2.5, 1.0], 0.0),
            ([0.0, 0.0], 1.0),
            ([-1.5, 0.0], 1.0),
            ([-1.0, 0.0], 1.0),
            ([1.0, 0.9], 1.0),
            ([1.9, 0.0], 1.0),
            ([2.1, 0.0], 0.0),
            ([1.0, 1.1], 0.0),
            ([-3.0, 0.0], 0.0),
            ([1.8, 0.9], 0.0),
        ] {
            assert!((winding.turns(Vec2::from(x)) - turns).abs() < 1e-12, "{x:?}");
        }
    }
}
