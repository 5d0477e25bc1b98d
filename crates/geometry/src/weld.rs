//! Corners and edges of different shapes that nearly coincide, as in drawings with rounded coordinates, are made to coincide.
//!
//! Edges that meet under an angle of the size of rounding have no certain intersection. Each shape is therefore fitted to those before it: its corners are
//! moved to their corners, or onto their straight edges, and its straight edges are led through their corners.

use std::ops::Range;

use crate::spec::{CurvedPolygon, Polygon, ShapeSpec};
use crate::tree::Tree;
use meniscus_core::math::{Bounds, Vec2};

/// What is nearer than this share of the larger side of the domain coincides.
pub const WELD: f64 = 2e-7;
/// What is nearer than this share coincides already: intersections count it as zero.
const COINCIDENT: f64 = 1e-10;

/// The edge from a corner to the next one.
struct Edge {
    ring: usize,
    /// Tangent of a quarter of its turning angle, as in a shape file.
    bulge: f64,
    /// Both corners, and those between them through which it is led.
    points: Vec<Vec2>,
}

/// A ring of corners, each with the bulge of the edge that begins there.
type Corners = Vec<[f64; 3]>;

/// The shapes with nearly coincident corners and edges made coincident.
pub(crate) fn welded(shapes: &[ShapeSpec], domain: Bounds) -> Vec<ShapeSpec> {
    let rings: Vec<Vec<Corners>> = shapes.iter().map(rings_of).collect();
    let mut found = shapes.to_vec();
    for (index, rings) in weld(&rings, domain.size().max()).0 {
        found[index] = with_rings(&shapes[index], rings);
    }
    found
}

/// The shapes of these rings that change where nearly coincident corners and edges are made coincident, by their indices, and how many corners were moved or
/// added; `size` is that of the domain in m.
pub fn weld(shapes: &[Vec<Corners>], size: f64) -> (Vec<(usize, Vec<Corners>)>, usize) {
    let (mut edges, mut of_shape) = (Vec::new(), Vec::new());
    for rings in shapes {
        let first = edges.len();
        // Arcs alone have no edges that others could nearly coincide with.
        if rings.iter().flatten().any(|corner| corner[2] == 0.0) {
            edges.extend(rings.iter().enumerate().flat_map(|(ring, corners)| edges_of(ring, corners)));
        }
        of_shape.push(first..edges.len());
    }
    let boxes = edges.iter().map(|edge| around(&edge.points).grown(2.0 * WELD * size));
    let mut weld = Weld { tree: Tree::over(boxes), edges, within: WELD * size, coincident: COINCIDENT * size };
    let (mut found, mut count) = (Vec::new(), 0);
    for (index, edges) in of_shape.into_iter().enumerate() {
        let changes = weld.fit(edges.clone());
        if changes > 0 {
            count += changes;
            found.push((index, corners_of(&weld.edges[edges])));
        }
    }
    (found, count)
}

fn around(points: &[Vec2]) -> Bounds {
    Bounds::around(points.iter().copied()).unwrap_or(Bounds::EMPTY)
}

struct Weld {
    edges: Vec<Edge>,
    tree: Tree,
    /// Distances in m.
    within: f64,
    coincident: f64,
}

impl Weld {
    /// Fits the edges of a shape to those of the shapes before it, and returns the number of corners that were moved or added.
    fn fit(&mut self, edges: Range<usize>) -> usize {
        let mut changes = 0;
        let rings: Vec<Range<usize>> = {
            let of_ring = self.edges[edges.clone()].chunk_by(|a, b| a.ring == b.ring);
            of_ring
                .scan(edges.start, |start, ring| {
                    *start += ring.len();
                    Some(*start - ring.len()..*start)
                })
                .collect()
        };
        for ring in rings {
            let corners: Vec<Vec2> = ring.clone().map(|k| self.edges[k].points[0]).collect();
            let moved: Vec<Vec2> = corners.iter().map(|&x| self.moved(x, edges.start)).collect();
            changes += corners.iter().zip(&moved).filter(|(x, to)| x != to).count();
            for (i, k) in ring.enumerate() {
                let (a, b) = (moved[i], moved[(i + 1) % moved.len()]);
                let between = if self.edges[k].bulge == 0.0 { self.between(a, b, edges.start) } else { Vec::new() };
                changes += between.len();
                self.edges[k].points = [vec![a], between, vec![b]].concat();
            }
        }
        changes
    }

    /// The edges of shapes before the one that begins at edge `start`, near a box.
    fn before(&self, near: Bounds, start: usize) -> impl Iterator<Item = &Edge> {
        self.tree.near_in_order(near.grown(self.within)).into_iter().filter(move |&k| k < start).map(|k| &self.edges[k])
    }

    /// Where a corner goes: to the nearest corner, else to the nearest straight edge.
    fn moved(&self, x: Vec2, start: usize) -> Vec2 {
        let near: Vec<&Edge> = self.before(around(&[x]), start).collect();
        let nearest = |points: &mut dyn Iterator<Item = Vec2>| {
            let nearest = points.min_by(|a, b| (a - x).norm().total_cmp(&(b - x).norm()));
            nearest.filter(|p| (p - x).norm() <= self.within)
        };
        let corner = nearest(&mut near.iter().flat_map(|edge| edge.points.iter().copied()));
        let straight = near.iter().filter(|edge| edge.bulge == 0.0).flat_map(|edge| edge.points.windows(2));
        let target = corner.or_else(|| nearest(&mut straight.filter_map(|ends| projection(x, ends[0], ends[1]))));
        target.filter(|p| (p - x).norm() > self.coincident).unwrap_or(x)
    }

    /// The corners near a straight edge but not near its ends, in order.
    fn between(&self, a: Vec2, b: Vec2, start: usize) -> Vec<Vec2> {
        let is_near = |p: &Vec2| {
            let apart = projection(*p, a, b).map_or(f64::INFINITY, |q| (p - q).norm());
            self.coincident < apart && apart <= self.within && (p - a).norm().min((p - b).norm()) > self.within
        };
        let corners = self.before(around(&[a, b]), start).flat_map(|edge| &edge.points);
        let mut found: Vec<Vec2> = corners.copied().filter(is_near).collect();
        found.sort_by(|p, q| (p - a).norm().total_cmp(&(q - a).norm()));
        found.dedup_by(|next, last| (*next - *last).norm() <= self.within);
        found
    }
}

/// The point of a segment whose normal passes through `x`, if there is one.
fn projection(x: Vec2, a: Vec2, b: Vec2) -> Option<Vec2> {
    let along = b - a;
    let share = (x - a).dot(&along) / along.norm_squared();
    (0.0..=1.0).contains(&share).then(|| a + along * share)
}

fn edges_of(ring: usize, corners: &[[f64; 3]]) -> Vec<Edge> {
    let place = |[x, y, _]: [f64; 3]| Vec2::new(x, y);
    let next = corners.iter().cycle().skip(1);
    let edge = |(&a, &b): (&[f64; 3], &[f64; 3])| Edge { ring, bulge: a[2], points: vec![place(a), place(b)] };
    corners.iter().zip(next).map(edge).collect()
}

/// The rings of these edges.
fn corners_of(edges: &[Edge]) -> Vec<Corners> {
    let ring = |edges: &[Edge]| {
        let starts =
            |edge: &Edge| edge.points[..edge.points.len() - 1].iter().map(|p| [p.x, p.y, edge.bulge]).collect();
        let mut ring: Corners = edges.iter().flat_map(|edge| -> Corners { starts(edge) }).collect();
        ring.dedup_by(|next, last| next[..2] == last[..2]);
        ring
    };
    edges.chunk_by(|a, b| a.ring == b.ring).map(ring).collect()
}

/// The rings of a shape in the frame of the domain; none of a shape without corners.
fn rings_of(spec: &ShapeSpec) -> Vec<Corners> {
    let CurvedPolygon { outer, holes, position, rotation_deg } = match spec {
        ShapeSpec::Rectangle(rectangle) => rectangle.curved(),
        ShapeSpec::Polygon(polygon) => polygon.curved(),
        ShapeSpec::CurvedPolygon(polygon) => polygon.clone(),
        _ => return Vec::new(),
    };
    let turn = nalgebra::Rotation2::new(rotation_deg.to_radians());
    let place = |[x, y, bulge]: [f64; 3]| {
        let p = turn * Vec2::new(x, y) + Vec2::from(position);
        [p.x, p.y, bulge]
    };
    std::iter::once(outer).chain(holes).map(|ring| ring.into_iter().map(place).collect()).collect()
}

/// The shape with these rings.
fn with_rings(spec: &ShapeSpec, rings: Vec<Corners>) -> ShapeSpec {
    let mut rings = rings.into_iter();
    let (position, rotation_deg) = ([0.0; 2], 0.0);
    let (outer, holes) = (rings.next().unwrap_or_default(), rings.collect::<Vec<_>>());
    if matches!(spec, ShapeSpec::CurvedPolygon(_)) {
        return ShapeSpec::CurvedPolygon(CurvedPolygon { outer, holes, position, rotation_deg });
    }
    let plain = |ring: Corners| ring.into_iter().map(|[x, y, _]| [x, y]).collect();
    let holes = holes.into_iter().map(plain).collect();
    ShapeSpec::Polygon(Polygon { outer: plain(outer), holes, position, rotation_deg })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::Geometry;
    use crate::spec::{GeometrySpec, SolidSide};

    fn polygon(outer: &[[f64; 2]]) -> ShapeSpec {
        let outer = outer.to_vec();
        ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 })
    }

    #[test]
    fn a_bar_flush_with_a_turned_block_within_seven_decimals_joins_it() {
        let rounded = |x: f64| (x * 1e7).round() * 1e-7;
        for degrees in [3.0_f64, 13.0, 20.0, 37.0, 61.0, 77.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let turned = |[x, y]: [f64; 2]| [rounded(0.5 + cos * x - sin * y), rounded(0.5 + sin * x + cos * y)];
            let block = [[-0.2, -0.1], [0.2, -0.1], [0.2, 0.0], [-0.2, 0.0]].map(turned);
            let bar = [[-0.07, 0.0], [0.05, 0.0], [0.05, 0.2], [-0.07, 0.2]].map(turned);
            for shapes in [[block, bar], [bar, block]] {
                let shapes = shapes.map(|outer| polygon(&outer)).to_vec();
                let spec = GeometrySpec { min: [0.0; 2], max: [1.0; 2], solid: SolidSide::Inside, shapes };
                let geometry = Geometry::new(&spec).unwrap();
                let wall: f64 = geometry.boundary.pieces.iter().map(|piece| piece.curve.length()).sum();
                assert!((wall - (1.0 + 0.4)).abs() < 1e-6, "{degrees}: {wall}");
                assert!((geometry.porosity().value - (1.0 - 0.04 - 0.024)).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn shapes_that_coincide_exactly_or_are_apart_stay_as_they_are() {
        let block = polygon(&[[0.2, 0.2], [0.5, 0.2], [0.5, 0.4], [0.2, 0.4]]);
        let domain = Bounds { min: Vec2::zeros(), max: Vec2::repeat(1.0) };
        for left in [0.5, 0.5 + 1e-5, 0.6] {
            let bar = polygon(&[[left, 0.2], [0.9, 0.2], [0.9, 0.4], [left, 0.4]]);
            assert_eq!(welded(&[block.clone(), bar.clone()], domain), vec![block.clone(), bar]);
        }
    }
}
