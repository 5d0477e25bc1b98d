//! Tests of the complexity of geometry: the work grows as n log n with the number of shapes and vertices, never as its square.
//!
//! Work is counted, not timed: bounding boxes and nearest points of curves, which every search and every cut needs. Four times as many curves then take four
//! times the work, and a little more where a tree is a level deeper; testing all pairs would take sixteen times the work.

use std::f64::consts::TAU;

use crate::curve::work;
use crate::solid::Geometry;
use crate::spec::{CurvedPolygon, Disc, GeometrySpec, Polygon, ShapeSpec, SolidSide};

/// Range of the ratio of work for four times as many curves.
const GROWTH: std::ops::Range<f64> = 3.0..6.0;

fn spec(solid: SolidSide, size: f64, shapes: Vec<ShapeSpec>) -> GeometrySpec {
    GeometrySpec { min: [-0.5; 2], max: [size; 2], solid, shapes }
}

/// Discs on a square lattice, each overlapping its neighbors where `radius` is above 1/2.
fn discs(side: usize, radius: f64) -> Vec<ShapeSpec> {
    let disc = |k: usize| Disc { center: [(k % side) as f64, (k / side) as f64], radius };
    (0..side * side).map(|k| ShapeSpec::Disc(disc(k))).collect()
}

/// A gear with half as many teeth, about as deep as wide, shifted by `x`. (The bounding boxes of long oblique edges side by side overlap, against which no
/// tree of boxes helps.)
fn gear(teeth: usize, x: f64) -> Vec<[f64; 2]> {
    let depth = TAU / teeth as f64;
    let at = |k: usize| (TAU * k as f64 / teeth as f64, if k.is_multiple_of(2) { 1.0 - depth } else { 1.0 });
    (0..teeth).map(at).map(|(angle, radius)| [x + radius * angle.cos(), radius * angle.sin()]).collect()
}

fn polygon(outer: Vec<[f64; 2]>) -> ShapeSpec {
    ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 })
}

fn curved(outer: Vec<[f64; 2]>) -> ShapeSpec {
    let outer = outer.into_iter().map(|[x, y]| [x, y, 0.1]).collect();
    ShapeSpec::CurvedPolygon(CurvedPolygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 })
}

/// All quantities of the command `geometry` except throats.
fn measured(spec: &GeometrySpec) -> u64 {
    let all = || {
        let geometry = Geometry::new(spec).unwrap().with_sides([true, false], [false, false, true, true]);
        assert!(geometry.porosity().value > 0.0 && geometry.specific_surface() > 0.0);
        assert!(!geometry.outline().lines.is_empty());
    };
    // The work of one thread is counted.
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    alone.install(|| work::of(all))
}

fn assert_grows_slowly(name: &str, of: impl Fn(usize) -> GeometrySpec) {
    let (few, many) = (measured(&of(1)) as f64, measured(&of(4)) as f64);
    assert!(GROWTH.contains(&(many / few)), "{name}: {few} and {many} for four times as many curves");
}

#[test]
fn discs_cost_the_same_each_however_many_there_are() {
    for (radius, solid) in [(0.4, SolidSide::Inside), (0.55, SolidSide::Inside), (0.55, SolidSide::Outside)] {
        let side = |share: usize| 16 * if share == 4 { 2 } else { 1 };
        assert_grows_slowly("discs", |share| spec(solid, side(share) as f64 - 0.5, discs(side(share), radius)));
    }
}

#[test]
fn edges_cost_the_same_each_however_long_their_ring_is() {
    assert_grows_slowly("polygon", |share| spec(SolidSide::Inside, 0.8, vec![polygon(gear(1000 * share, 0.0))]));
    assert_grows_slowly("arcs", |share| spec(SolidSide::Inside, 0.8, vec![curved(gear(1000 * share, 0.0))]));
    // Two rings that cross: intersections and inside tests of one in the edges of the other.
    assert_grows_slowly("two rings", |share| {
        let rings = vec![curved(gear(1000 * share, 0.0)), polygon(gear(1000 * share, 0.5))];
        spec(SolidSide::Inside, 1.2, rings)
    });
}

#[test]
fn ends_on_one_line_cost_the_same_each() {
    // A comb: half of its ends have the same x.
    assert_grows_slowly("comb", |share| {
        let teeth = 500 * share;
        let at = |k: usize| [if k.is_multiple_of(2) { 0.2 } else { 0.4 }, (k / 2) as f64 / teeth as f64];
        let mut ring: Vec<[f64; 2]> = (0..2 * teeth).map(at).collect();
        ring.extend([[0.2, 1.0], [0.0, 1.0], [0.0, 0.0]]);
        ring.reverse();
        let is_counter_clockwise = crate::validate::ring_area(&ring) > 0.0;
        if !is_counter_clockwise {
            ring.reverse();
        }
        spec(SolidSide::Inside, 1.5, vec![polygon(ring)])
    });
}
