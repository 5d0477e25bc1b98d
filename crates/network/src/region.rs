//! The region of saturations: the pore space in a rectangle, without elements open at the inlet or the outlet.
//!
//! Area of a part Ω of the pore space inside the rectangle from (a, c) to (b, d), by Green's theorem over the boundary of Ω:
//!
//! A = ∮ min(max(x, a), b) dy, where c < y < d.

use super::displacement::Displacement;
use super::graph::{Edge, Network, Region};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::curve::Curve;

/// The areas that count in saturations.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Counted {
    /// Area of each element in m².
    pub(crate) areas: Vec<f64>,
    /// Their sum.
    pub(crate) sum: f64,
}

impl Counted {
    /// The areas of all elements.
    pub(crate) fn everywhere(displacement: &Displacement) -> Self {
        Self::of(displacement.elements().iter().map(|element| element.area).collect())
    }

    /// The areas inside a rectangle, without elements open at the inlet or the outlet.
    pub(crate) fn within(displacement: &Displacement, region: Bounds, periods: [Option<f64>; 2]) -> Self {
        let area = |element: usize| {
            let whole = displacement.elements()[element].area;
            if displacement.is_manifold(element) {
                0.0
            } else {
                area_within(displacement.boundary(element), whole, region, periods)
            }
        };
        Self::of((0..displacement.elements().len()).map(area).collect())
    }

    fn of(areas: Vec<f64>) -> Self {
        let sum = areas.iter().sum();
        Self { areas, sum }
    }

    /// Fraction of an element that counts.
    pub(crate) fn share(&self, displacement: &Displacement, element: usize) -> f64 {
        self.areas[element] / displacement.elements()[element].area
    }

    /// Area in m² of the elements for which `holds` is true.
    pub(crate) fn area_of(&self, holds: impl Fn(usize) -> bool) -> f64 {
        (0..self.areas.len()).filter(|&element| holds(element)).map(|element| self.areas[element]).sum()
    }
}

/// The porosity of a rectangle of the domain.
pub(crate) fn porosity(network: &Network, rectangle: Bounds, periods: [Option<f64>; 2]) -> f64 {
    let curves = |edge: &Edge| match edge {
        Edge::Wall(pieces) => pieces.iter().map(|piece| piece.curve).collect(),
        Edge::Throat { from, to, .. } | Edge::Opening { from, to, .. } => vec![Curve::Segment { a: *from, b: *to }],
    };
    let area = |region: &Region| {
        let boundary = region.edges.iter().flat_map(curves).collect();
        area_within(boundary, region.area, rectangle, periods)
    };
    network.regions.iter().map(area).sum::<f64>() / rectangle.area()
}

/// Rounding error of areas relative to the rectangle.
const ROUNDING: f64 = 1.0e-10;

/// Area in m² of a part of the pore space and its periodic images inside a rectangle; `area` is its total area.
fn area_within(boundary: Vec<Curve>, area: f64, rectangle: Bounds, periods: [Option<f64>; 2]) -> f64 {
    let outline = closed(boundary);
    let Some(ends) = outline.iter().map(Curve::bounds).reduce(|a, b| a.united(&b)) else { return 0.0 };
    let mut found = 0.0;
    for shift in shifts(ends, rectangle, periods) {
        let frame = Bounds { min: rectangle.min - shift, max: rectangle.max - shift };
        let is_inside = (0..2).all(|axis| frame.min[axis] <= ends.min[axis] && frame.max[axis] >= ends.max[axis]);
        // A part entirely inside has its area in closed form.
        found += if is_inside { area } else { -outline.iter().map(|curve| integral(curve, frame)).sum::<f64>() };
    }
    // Parts outside add up to rounding.
    if found > ROUNDING * rectangle.area() { found.min(area) } else { 0.0 }
}

/// The shifts in m by whole periods at which what lies between these ends overlaps a rectangle.
pub(super) fn shifts(ends: Bounds, region: Bounds, periods: [Option<f64>; 2]) -> Vec<Vec2> {
    let [along_x, along_y] = [0, 1].map(|axis| match periods[axis] {
        None => vec![0.0],
        Some(period) => {
            let first = ((region.min[axis] - ends.max[axis]) / period).ceil() as i32;
            let last = ((region.max[axis] - ends.min[axis]) / period).floor() as i32;
            (first..=last).map(|k| f64::from(k) * period).collect()
        }
    });
    along_x.iter().flat_map(|&x| along_y.iter().map(move |&y| Vec2::new(x, y))).collect()
}

/// A boundary with segments across its gaps. Around a periodic domain they cancel those of the adjacent image.
fn closed(curves: Vec<Curve>) -> Vec<Curve> {
    let count = curves.len();
    let gap = |k: usize| Curve::Segment { a: curves[k].point(1.0), b: curves[(k + 1) % count].point(0.0) };
    let gaps: Vec<Curve> = (0..count).map(gap).collect();
    curves.into_iter().chain(gaps).collect()
}

/// ∫ min(max(x, a), b) dy along a curve, where c < y < d.
fn integral(curve: &Curve, Bounds { min, max }: Bounds) -> f64 {
    let mut cuts = vec![0.0, 1.0];
    for (axis, at) in [(0, min.x), (0, max.x), (1, min.y), (1, max.y)] {
        cuts.extend(crossings(curve, axis, at));
    }
    cuts.sort_by(f64::total_cmp);
    let piece = |from: f64, to: f64| {
        let middle = curve.point(0.5 * (from + to));
        let rise = curve.point(to).y - curve.point(from).y;
        match middle {
            at if at.y <= min.y || at.y >= max.y => 0.0,
            at if at.x <= min.x => min.x * rise,
            at if at.x >= max.x => max.x * rise,
            _ => x_dy(&curve.part(from, to)),
        }
    };
    cuts.windows(2).map(|pair| piece(pair[0], pair[1])).sum()
}

/// ∫ x dy along a curve.
fn x_dy(curve: &Curve) -> f64 {
    match *curve {
        Curve::Segment { a, b } => 0.5 * (a.x + b.x) * (b.y - a.y),
        Curve::Arc { center, radius, start, sweep } => {
            let primitive =
                |angle: f64| radius * (center.x * angle.sin() + 0.5 * radius * (angle + 0.5 * (2.0 * angle).sin()));
            primitive(start + sweep) - primitive(start)
        }
    }
}

/// Parameters within a curve at which x (axis 0) or y (axis 1) is `at`.
fn crossings(curve: &Curve, axis: usize, at: f64) -> Vec<f64> {
    let found: Vec<f64> = match *curve {
        Curve::Segment { a, b } => vec![(at - a[axis]) / (b[axis] - a[axis])],
        Curve::Arc { center, radius, start, sweep } => {
            let ratio = (at - center[axis]) / radius;
            if ratio.abs() > 1.0 {
                return Vec::new();
            }
            let angles = if axis == 0 {
                [ratio.acos(), -ratio.acos()]
            } else {
                [ratio.asin(), std::f64::consts::PI - ratio.asin()]
            };
            let turned =
                |angle: f64| ((angle - start) * sweep.signum()).rem_euclid(std::f64::consts::TAU) / sweep.abs();
            angles.map(turned).to_vec()
        }
    };
    found.into_iter().filter(|u| *u > 0.0 && *u < 1.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(min: [f64; 2], max: [f64; 2]) -> Bounds {
        Bounds { min: min.into(), max: max.into() }
    }

    #[test]
    fn a_disc_and_a_square_are_cut_by_a_rectangle_exactly() {
        // Pores lie on the right of their boundaries: clockwise.
        let disc = Curve::Arc { center: Vec2::zeros(), radius: 1.0, start: 0.3, sweep: -std::f64::consts::TAU };
        let area = |curves: &[Curve], region| -curves.iter().map(|curve| integral(curve, region)).sum::<f64>();
        let pi = std::f64::consts::PI;
        for (region, expected) in [
            (bounds([-2.0, -2.0], [2.0, 2.0]), pi),
            (bounds([0.0, -2.0], [2.0, 2.0]), pi / 2.0),
            (bounds([-2.0, -2.0], [0.0, 0.0]), pi / 4.0),
            // A segment of the circle past x = 1/2, and a square inside.
            (bounds([0.5, -2.0], [3.0, 3.0]), pi / 3.0 - 0.75_f64.sqrt() / 2.0),
            (bounds([-0.5, -0.5], [0.5, 0.5]), 1.0),
            (bounds([2.0, -1.0], [3.0, 1.0]), 0.0),
        ] {
            assert!((area(&[disc], region) - expected).abs() < 1e-14, "{region:?}");
        }
        let corners = [[0.0, 0.0], [0.0, 2.0], [2.0, 2.0], [2.0, 0.0]].map(Vec2::from);
        let square: Vec<Curve> = (0..4).map(|k| Curve::Segment { a: corners[k], b: corners[(k + 1) % 4] }).collect();
        assert_eq!(area(&square, bounds([0.5, 1.0], [1.0, 5.0])), 0.5);
    }
}
