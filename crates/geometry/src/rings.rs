//! Validity of the rings of a polygon of segments and arcs: no ring crosses or touches itself, holes lie within the outer ring and outside each other, and
//! rings touch at isolated points at most.
//!
//! Edges that may intersect are found by a tree over their boxes. Two segments are tested by exact predicates (crate `geo`); with arcs the test is within
//! rounding. Rings that intersect are cut there, and each part is classified as inside or outside the other ring by winding numbers. Not detected: holes that
//! touch so that they divide the polygon into several parts, which is harmless here.

use std::collections::{BTreeMap, BTreeSet};

use geo::Intersects;

use crate::boundary::split;
use crate::curve::Curve;
use crate::curve_set::CurveSet;
use crate::intersect::intersections;
use crate::tree::Tree;
use crate::winding::Winding;
use meniscus_core::math::{Bounds, Vec2};

/// Points nearer than this fraction of the polygon's size coincide, if arcs are involved.
const ROUNDING: f64 = 1e-12;

/// Neighboring edges of which one is an arc meet at their common vertex within this fraction of the shorter one: where they are tangent there, the computed
/// intersection is ill-conditioned.
const AT_VERTEX: f64 = 1e-3;

/// Faults of rings; ring 0 is the outer one. Positions in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RingFault {
    /// Two edges of a ring, by the index of their start, intersect elsewhere than at a common end.
    SelfIntersection { ring: usize, edges: [usize; 2], at: Vec2 },
    /// A hole is not inside the outer ring.
    NotContained { hole: usize, at: Vec2 },
    /// Two rings coincide along a line.
    OnALine { rings: [usize; 2], at: Vec2 },
    /// One hole overlaps another.
    OnAnArea { rings: [usize; 2], at: Vec2 },
}

impl RingFault {
    /// The rings involved.
    fn rings(&self) -> [usize; 2] {
        match *self {
            Self::SelfIntersection { ring, .. } => [ring; 2],
            Self::NotContained { hole, .. } => [0, hole],
            Self::OnALine { rings, .. } | Self::OnAnArea { rings, .. } => rings,
        }
    }
}

fn name(ring: usize) -> String {
    match ring.checked_sub(1) {
        None => "exterior ring".to_owned(),
        Some(hole) => format!("interior ring at index {hole}"),
    }
}

impl std::fmt::Display for RingFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let point = |at: &Vec2| format!("({:e}, {:e})", at.x, at.y);
        match self {
            Self::SelfIntersection { ring, edges: [i, j], at } => {
                write!(
                    f,
                    "{} has a self-intersection: the edges from its points {i} and {j} meet at {}",
                    name(*ring),
                    point(at)
                )
            }
            Self::NotContained { hole, at } => {
                write!(f, "{} is not contained within the polygon's exterior: see {}", name(*hole), point(at))
            }
            Self::OnALine { rings: [a, b], at } => {
                write!(f, "{} and {} intersect on a line: see {}", name(*a), name(*b), point(at))
            }
            Self::OnAnArea { rings: [a, b], at } => {
                write!(f, "{} and {} intersect on an area: see {}", name(*a), name(*b), point(at))
            }
        }
    }
}

/// All faults of rings of two edges or more without duplicate points: the first one of each ring and of each pair of rings.
pub fn faults(rings: &[Vec<Curve>]) -> Vec<RingFault> {
    let edges = Edges::of(rings);
    let mut found: Vec<RingFault> = (0..rings.len()).filter_map(|ring| edges.self_intersection(ring)).collect();
    if rings.len() > 1 && found.is_empty() {
        let regions: Vec<Region> = rings.iter().map(|ring| Region::of(ring)).collect();
        let boxes = Tree::over(regions.iter().map(|region| region.curves.bounds()));
        // A pair of holes is visited from both sides.
        let mut known = BTreeSet::new();
        for hole in 1..rings.len() {
            let all = edges.faults_of_hole(hole, &regions, &boxes);
            found.extend(all.into_iter().filter(|fault| known.insert(fault.rings())));
        }
    }
    found
}

/// All intersections of edges of the rings elsewhere than at a common vertex.
pub fn meetings(rings: &[Vec<Curve>]) -> Vec<Vec2> {
    let all = Edges::of(rings);
    let mut found = Vec::new();
    for (ring, own) in rings.iter().enumerate() {
        for (i, edge) in own.iter().enumerate() {
            for (other, j) in all.near(edge).filter(|&near| near > (ring, i)) {
                let is_own = other == ring;
                found.extend(if is_own { all.meeting(own, i, j) } else { all.first_point(edge, &rings[other][j]) });
            }
        }
    }
    found
}

/// The first two rings that cross, and where: each has a part inside the other one and a part outside of it. Rings that touch, and nested rings, do not cross.
pub fn crossing(rings: &[Vec<Curve>]) -> Option<([usize; 2], Vec2)> {
    let edges = Edges::of(rings);
    let regions: Vec<Region> = rings.iter().map(|ring| Region::of(ring)).collect();
    (0..rings.len()).find_map(|number| edges.crossings(number, &regions).into_iter().next())
}

/// All pairs of rings that cross, with a point of each.
pub fn crossings(rings: &[Vec<Curve>]) -> Vec<([usize; 2], Vec2)> {
    let edges = Edges::of(rings);
    let regions: Vec<Region> = rings.iter().map(|ring| Region::of(ring)).collect();
    (0..rings.len()).flat_map(|number| edges.crossings(number, &regions)).collect()
}

/// The area enclosed by one ring.
struct Region {
    curves: CurveSet,
    winding: Winding,
}

impl Region {
    fn of(ring: &[Curve]) -> Self {
        Self { curves: ring.to_vec().into(), winding: Winding::of([ring.to_vec()]) }
    }
}

/// The edges of all rings, one ring after the other.
struct Edges<'a> {
    rings: &'a [Vec<Curve>],
    /// Ring and number of each edge.
    owner: Vec<(usize, usize)>,
    tree: Tree,
    tolerance: f64,
}

impl<'a> Edges<'a> {
    fn of(rings: &'a [Vec<Curve>]) -> Self {
        let owner: Vec<(usize, usize)> =
            rings.iter().enumerate().flat_map(|(ring, edges)| (0..edges.len()).map(move |edge| (ring, edge))).collect();
        let boxes: Vec<Bounds> = rings.iter().flatten().map(Curve::bounds).collect();
        let all = boxes.iter().copied().reduce(|a, b| a.united(&b));
        // Far from the origin the rounding of coordinates exceeds that of the size of the shape.
        let tolerance = all.map_or(0.0, |all| {
            ROUNDING * all.size().max() + 8.0 * f64::EPSILON * all.min.abs().sup(&all.max.abs()).max()
        });
        let tree = Tree::over(boxes.iter().map(|b| b.grown(tolerance)));
        Self { rings, owner, tree, tolerance }
    }

    /// Edges whose box overlaps that of `curve`, in order.
    fn near(&self, curve: &Curve) -> impl Iterator<Item = (usize, usize)> {
        self.tree.near_in_order(curve.bounds().grown(self.tolerance)).into_iter().map(|index| self.owner[index])
    }

    /// The later rings that cross this one.
    fn crossings(&self, number: usize, regions: &[Region]) -> Vec<([usize; 2], Vec2)> {
        let mut found: BTreeMap<usize, Vec2> = BTreeMap::new();
        // By other ring, whether this one has parts inside it and outside it.
        let mut parts: BTreeMap<usize, [bool; 2]> = BTreeMap::new();
        for edge in &self.rings[number] {
            let near: Vec<(usize, usize)> = self.near(edge).filter(|&(other, _)| other > number).collect();
            let others: BTreeSet<usize> = near.iter().map(|&(other, _)| other).collect();
            for other in others.into_iter().filter(|other| !found.contains_key(other)).collect::<Vec<_>>() {
                let walls = near.iter().filter(|&&(one, _)| one == other).map(|&(_, j)| &self.rings[other][j]);
                for part in split(edge, walls, self.tolerance) {
                    let x = part.point(0.5);
                    if regions[other].curves.distance(x) <= self.tolerance {
                        continue;
                    }
                    let both = parts.entry(other).or_default();
                    both[usize::from(regions[other].winding.turns(x).abs() > 0.5)] = true;
                    if *both == [true; 2] {
                        found.entry(other).or_insert_with(|| part.point(0.0));
                    }
                }
            }
        }
        found.into_iter().map(|(other, at)| ([number, other], at)).collect()
    }

    fn self_intersection(&self, ring: usize) -> Option<RingFault> {
        let edges = &self.rings[ring];
        (0..edges.len()).find_map(|i| {
            let others = self.near(&edges[i]).filter(|&(other, j)| other == ring && j > i);
            others.into_iter().find_map(|(_, j)| {
                let at = self.meeting(edges, i, j)?;
                Some(RingFault::SelfIntersection { ring, edges: [i, j], at })
            })
        })
    }

    /// The intersection of edges `i` < `j` of a ring elsewhere than at a common vertex.
    fn meeting(&self, edges: &[Curve], i: usize, j: usize) -> Option<Vec2> {
        let (a, b) = (&edges[i], &edges[j]);
        let vertices: Vec<Vec2> =
            [(j == i + 1).then(|| b.point(0.0)), (i == 0 && j + 1 == edges.len()).then(|| a.point(0.0))]
                .into_iter()
                .flatten()
                .collect();
        if let (Curve::Segment { a: p, b: q }, Curve::Segment { a: r, b: s }) = (a, b) {
            // Neighbors that fold back on each other are detected by the next edge.
            let do_meet = vertices.is_empty() && line(*p, *q).intersects(&line(*r, *s));
            return do_meet.then(|| self.first_point(a, b).unwrap_or(*r));
        }
        let near_vertex = AT_VERTEX * a.length().min(b.length());
        let mut parameters = Vec::new();
        intersections(a, b, self.tolerance, &mut parameters);
        let away = |x: &Vec2| vertices.iter().all(|vertex| (x - vertex).norm() > near_vertex);
        parameters.into_iter().map(|u| a.point(u)).find(away)
    }

    fn first_point(&self, a: &Curve, b: &Curve) -> Option<Vec2> {
        let mut parameters = Vec::new();
        intersections(a, b, self.tolerance, &mut parameters);
        parameters.into_iter().min_by(f64::total_cmp).map(|u| a.point(u))
    }

    /// Faults between a hole and the other rings, except previous holes.
    fn faults_of_hole(&self, hole: usize, regions: &[Region], boxes: &Tree) -> Vec<RingFault> {
        let mut found: Vec<(usize, RingFault)> = Vec::new();
        for (number, edge) in self.rings[hole].iter().enumerate() {
            let near: Vec<(usize, usize)> = self.near(edge).filter(|&(ring, _)| ring != hole).collect();
            // A hole that intersects no other ring is classified as a whole, by its first edge.
            let mut rings: Vec<usize> = near.iter().map(|&(ring, _)| ring).collect();
            if number == 0 {
                let start = edge.point(0.0);
                rings.extend(boxes.near(Bounds { min: start, max: start }).filter(|&ring| ring != hole));
                rings.push(0);
                rings.sort_unstable();
            }
            rings.dedup();
            for ring in rings {
                if found.iter().any(|(known, _)| *known == ring) {
                    continue;
                }
                let others = near.iter().filter(|&&(other, _)| other == ring).map(|&(_, j)| &self.rings[ring][j]);
                let parts = split(edge, others, self.tolerance);
                let fault = parts.iter().find_map(|part| self.fault(hole, ring, &regions[ring], part.point(0.5)));
                found.extend(fault.map(|fault| (ring, fault)));
            }
        }
        found.into_iter().map(|(_, fault)| fault).collect()
    }

    /// The fault if `x` on a hole lies in, on or outside another ring.
    fn fault(&self, hole: usize, ring: usize, region: &Region, x: Vec2) -> Option<RingFault> {
        let rings = [ring.min(hole), ring.max(hole)];
        if region.curves.distance(x) <= self.tolerance {
            return Some(RingFault::OnALine { rings, at: x });
        }
        let is_in = region.winding.turns(x).abs() > 0.5;
        match (ring, is_in) {
            (0, false) => Some(RingFault::NotContained { hole, at: x }),
            (1.., true) => Some(RingFault::OnAnArea { rings, at: x }),
            _ => None,
        }
    }
}

fn line(a: Vec2, b: Vec2) -> geo::Line<f64> {
    geo::Line::new(geo::coord! { x: a.x, y: a.y }, geo::coord! { x: b.x, y: b.y })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::bulged_ring;

    fn ring(vertices: &[[f64; 3]]) -> Vec<Curve> {
        bulged_ring(vertices).collect()
    }

    fn square(x: f64, y: f64, side: f64) -> Vec<Curve> {
        ring(&[[x, y, 0.0], [x + side, y, 0.0], [x + side, y + side, 0.0], [x, y + side, 0.0]])
    }

    fn hole(curves: Vec<Curve>) -> Vec<Curve> {
        curves.iter().rev().map(Curve::reversed).collect()
    }

    #[test]
    fn sound_rings_have_no_fault_even_where_they_touch_at_a_point() {
        let lens = ring(&[[0.0, 0.0, 0.5], [1.0, 0.0, 0.5]]);
        // A half circle tangent to straight sides, and a crescent with cusps.
        let stadium = ring(&[[-1.0, -1.0, 0.0], [1.0, -1.0, 1.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 1.0]]);
        let crescent = ring(&[[0.0, -1.0, 1.0], [0.0, 1.0, -0.6]]);
        for sound in [lens, stadium, crescent, square(0.0, 0.0, 1.0)] {
            assert_eq!(faults(&[sound]), []);
        }
        let disc = hole(ring(&[[1.0, 2.0, 1.0], [3.0, 2.0, 1.0]]));
        let diamond = hole(ring(&[[0.0, 2.0, 0.0], [0.5, 1.5, 0.0], [1.0, 2.0, 0.0], [0.5, 2.5, 0.0]]));
        assert_eq!(faults(&[square(0.0, 0.0, 4.0), disc, diamond]), []);
    }

    #[test]
    fn edges_that_cross_or_touch_are_named_with_their_place() {
        let bow = ring(&[[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.5, 0.0]]);
        let at = Vec2::new(0.6, 0.6);
        let [RingFault::SelfIntersection { ring: 0, edges: [0, 2], at: found }] = faults(&[bow])[..] else { panic!() };
        assert!((found - at).norm() < 1e-12);
        // Two arcs cannot cross between two common ends; an arc and its neighbor can.
        let neighbors = ring(&[[0.0, 0.0, -2.0], [1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]]);
        assert!(matches!(faults(&[neighbors])[..], [RingFault::SelfIntersection { .. }]));
        let spike = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 4.0], [2.0, 6.0], [2.0, 4.0], [0.0, 4.0]];
        assert!(matches!(faults(&[ring(&spike.map(|[x, y]| [x, y, 0.0]))])[..], [RingFault::SelfIntersection { .. }]));
    }

    #[test]
    fn holes_must_lie_within_the_outer_ring_and_beside_each_other() {
        let outer = square(0.0, 0.0, 4.0);
        let with =
            |holes: Vec<Vec<Curve>>| faults(&[vec![outer.clone()], holes.into_iter().map(hole).collect()].concat());
        assert!(matches!(with(vec![square(9.0, 9.0, 1.0)])[..], [RingFault::NotContained { hole: 1, .. }]));
        assert!(matches!(with(vec![square(3.0, 3.0, 2.0)])[..], [RingFault::NotContained { hole: 1, .. }]));
        assert!(matches!(with(vec![square(-1.0, -1.0, 9.0)])[..], [RingFault::NotContained { hole: 1, .. }]));
        assert!(matches!(with(vec![square(0.0, 1.0, 1.0)])[..], [RingFault::OnALine { rings: [0, 1], .. }]));
        let pair = |a, b| with(vec![a, b]);
        assert!(matches!(pair(square(1.0, 1.0, 1.0), square(1.5, 1.5, 1.0))[..], [RingFault::OnAnArea { .. }, ..]));
        assert!(matches!(pair(square(1.0, 1.0, 2.0), square(1.5, 1.5, 0.5))[..], [RingFault::OnAnArea { .. }, ..]));
        assert!(matches!(pair(square(1.0, 1.0, 1.0), square(2.0, 1.0, 1.0))[..], [RingFault::OnALine { .. }, ..]));
        assert_eq!(pair(square(1.0, 1.0, 1.0), square(2.5, 1.0, 1.0)), []);
    }

    #[test]
    fn rings_cross_where_each_has_a_part_in_the_other_and_not_where_they_touch_or_nest() {
        let outer = square(0.0, 0.0, 4.0);
        let with = |other: Vec<Curve>| crossing(&[outer.clone(), other]);
        assert_eq!(with(square(9.0, 9.0, 1.0)), None);
        assert_eq!(with(square(1.0, 1.0, 1.0)), None);
        // On a side, at a corner, inside and along a side.
        assert_eq!(with(square(4.0, 1.0, 1.0)), None);
        assert_eq!(with(square(4.0, 4.0, 1.0)), None);
        assert_eq!(with(square(3.0, 1.0, 1.0)), None);
        let (rings, at) = with(square(3.0, 3.0, 2.0)).unwrap();
        assert!(rings == [0, 1] && (at - Vec2::new(4.0, 3.0)).norm() < 1e-12, "{rings:?} {at}");
        assert!(with(hole(square(-1.0, 1.0, 2.0))).is_some());
        // Through vertices only.
        let diamond = ring(&[[4.0, -4.0, 0.0], [8.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 0.0, 0.0]]);
        assert!(with(diamond).is_some());
    }

    #[test]
    fn the_verdict_is_that_of_crate_geo_for_random_polygons() {
        use geo::algorithm::Validation;
        let random = |k: usize| (0.5 + 0.5 * (12.9898 * (k as f64 + 1.0)).sin() * 43758.5453).rem_euclid(1.0);
        let (mut sound, mut faulty) = (0, 0);
        for trial in 0..2000 {
            let outline = |n: usize, seed: usize, center: Vec2, size: f64| -> Vec<[f64; 2]> {
                let at = |k: usize| {
                    let t = std::f64::consts::TAU * (k as f64 + 1.4 * random(seed + k)) / n as f64;
                    (center + size * (0.3 + 0.7 * random(seed + 50 + k)) * Vec2::new(t.cos(), t.sin())).into()
                };
                (0..n).map(at).collect()
            };
            let position = |seed: usize| Vec2::new(random(seed) - 0.5, random(seed + 1) - 0.5);
            let outer = outline(8, 1000 * trial, Vec2::zeros(), 1.0);
            let holes =
                [1, 2].map(|h| outline(4, 1000 * trial + 200 * h, position(1000 * trial + 300 * h) * 0.6, 0.25));
            let line_string = |points: &[[f64; 2]]| geo::LineString::from(points.to_vec());
            let polygon = geo::Polygon::new(line_string(&outer), holes.iter().map(|h| line_string(h)).collect());
            let bulged = |points: &[[f64; 2]]| ring(&points.iter().map(|p| [p[0], p[1], 0.0]).collect::<Vec<_>>());
            let rings: Vec<Vec<Curve>> = std::iter::once(&outer).chain(&holes).map(|r| bulged(r)).collect();
            let is_sound = faults(&rings).is_empty();
            assert_eq!(is_sound, polygon.is_valid(), "{trial} {:?}", faults(&rings));
            if is_sound { sound += 1 } else { faulty += 1 }
        }
        assert!(sound > 100 && faulty > 100, "{sound} {faulty}");
    }
}
