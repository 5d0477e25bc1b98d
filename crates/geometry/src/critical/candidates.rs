//! Candidate pairs of facing walls, by the Delaunay triangulation of points sampled on them.
//!
//! The samples only select pairs and triples of pieces and starting points; all results computed from them are exact. A sampled triangulation needs no
//! special cases for unequal discs, arcs or vertices, for which triangulations of centers miss pairs.

use std::collections::BTreeSet;

use delaunator::{Point, triangulate};
use rayon::prelude::*;

use crate::critical::shift::{Shift, minus, plus};
use crate::critical::walls::{Link, Walls};
use crate::curve::Curve;
use meniscus_core::math::Vec2;

/// Samples around a full circle. With 12 or more none of 10,000 loops of a random pack fails its certificate.
const PER_CIRCLE: f64 = 24.0;

/// Corners of triangles that are looked at together.
const BLOCK: usize = 3 * 4096;

/// Minimum number of samples on a piece.
const PER_PIECE: usize = 2;

/// Two pieces that may face each other: the first one unshifted, the second one shifted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Indices of the pieces.
    pub(crate) walls: [usize; 2],
    /// Periodic image of the second one; the first one is the base piece.
    pub(crate) shift: Shift,
    /// A point between them in m.
    pub(crate) between: Vec2,
}

/// A point that may be near a maximum, with the three pieces around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Triple {
    /// The pieces and their images.
    pub(crate) walls: [(usize, Shift); 3],
    /// For a piece that stands for one of its ends alone, the parameter of that. Both ends of a concave arc may be nearest wall points, of which the arc
    /// itself offers only one.
    pub(crate) ends: [Option<f64>; 3],
    /// Starting point in m.
    pub(crate) start: Vec2,
}

/// Samples of all pieces, and their density.
pub struct Samples {
    /// Parameters on each base piece.
    pub(crate) along: Vec<Vec<f64>>,
}

impl Samples {
    /// Samples of all walls; `density` multiplies the number on each piece.
    pub fn new(walls: &Walls, density: &[f64]) -> Self {
        let along = (0..walls.walls.len()).into_par_iter().map(|k| sampled(walls, k, density[k])).collect();
        Self { along }
    }

    /// Samples of some of the walls alone.
    pub fn of(walls: &Walls, density: &[f64], some: &BTreeSet<usize>) -> Self {
        let mut along = vec![Vec::new(); walls.walls.len()];
        some.iter().for_each(|&k| along[k] = sampled(walls, k, density[k]));
        Self { along }
    }

    /// Number of samples.
    pub fn count(&self) -> usize {
        self.along.iter().map(Vec::len).sum()
    }
}

/// Parameters along a piece: equidistant, and denser near other walls.
fn sampled(walls: &Walls, k: usize, density: f64) -> Vec<f64> {
    let wall = &walls.walls[k];
    let turning = match wall.curve {
        Curve::Segment { .. } => 0.0,
        Curve::Arc { sweep, .. } => (PER_CIRCLE * sweep.abs() / std::f64::consts::TAU * density).ceil(),
    };
    let least = if is_finely_cut(walls, k) { 1 } else { PER_PIECE };
    let count = (turning as usize).max((least as f64 * density) as usize).max(least);
    let mut found = Vec::with_capacity(count + 1);
    for i in 0..count {
        divide(walls, k, [i as f64 / count as f64, (i + 1) as f64 / count as f64], density, &mut found);
    }
    if wall.next.is_none() && !wall.curve.is_closed() {
        found.push(1.0);
    }
    found
}

/// Whether a segment is one of many that approximate a curve: its ends then sample that as densely as a circle.
fn is_finely_cut(walls: &Walls, k: usize) -> bool {
    // Neighbors on an approximated curve have similar lengths.
    const LONGER: f64 = 4.0;
    let wall = &walls.walls[k];
    let is_like = |link: Option<Link>, turn: f64| {
        let length = link.map_or(0.0, |link| walls.walls[link.wall].curve.length());
        turn.abs() < std::f64::consts::TAU / PER_CIRCLE && wall.curve.length() < LONGER * length
    };
    let turn_at_end = wall.next.map_or(0.0, |link| walls.walls[link.wall].turn);
    matches!(wall.curve, Curve::Segment { .. }) && is_like(wall.before, wall.turn) && is_like(wall.next, turn_at_end)
}

/// Adds the start of an interval, bisected until it is at most twice as long as the distance to another wall.
fn divide(walls: &Walls, k: usize, [from, to]: [f64; 2], density: f64, found: &mut Vec<f64>) {
    let wall = &walls.walls[k];
    let (middle, length) = (0.5 * (from + to), (to - from) * wall.curve.length());
    // Denser samples make no difference to any relevant throat.
    const FLOOR: f64 = 30.0;
    if length > FLOOR * walls.tolerance {
        let (x, normal) = (wall.curve.point(middle), wall.curve.normal(middle));
        let neighbors = [wall.next, wall.before];
        let faces = walls.any_within(x, 0.5 * length * density, |image, closest| {
            let is_neighbor = |link: &Option<Link>| link.is_some_and(|link| (link.wall, link.shift) == image);
            image != (k, [0, 0]) && !neighbors.iter().any(is_neighbor) && (closest - x).dot(&normal) > walls.tolerance
        });
        if faces {
            divide(walls, k, [from, middle], density, found);
            divide(walls, k, [middle, to], density, found);
            return;
        }
    }
    found.push(from);
}

/// A sample of an image of a piece.
#[derive(Clone, Copy)]
struct Sample {
    wall: usize,
    shift: Shift,
    u: f64,
    point: Vec2,
}

/// Pairs and triples of pieces near each other.
pub(crate) fn candidates(walls: &Walls, samples: &Samples) -> (Vec<Pair>, Vec<Triple>) {
    let margin = walls.largest_distance();
    let near = walls.domain.grown(margin * 1.01 + walls.tolerance);
    let mut all: Vec<Sample> = Vec::with_capacity(samples.count());
    for (wall, shift) in walls.images_within(Vec2::repeat(margin)) {
        let curve = walls.curve(wall, shift);
        for &u in &samples.along[wall] {
            let point = curve.point(u);
            let outside = (0..2).any(|i| walls.periodic[i] && (point[i] < near.min[i] || point[i] > near.max[i]));
            if !outside {
                all.push(Sample { wall, shift, u, point });
            }
        }
    }
    // The library merges points below an absolute distance: lengths are scaled to the domain.
    let (center, scale) = (walls.domain.center(), walls.domain.size().max());
    let points: Vec<Point> = all
        .iter()
        .map(|sample| {
            let x = (sample.point - center) / scale;
            Point { x: x.x, y: x.y }
        })
        .collect();
    let triangulation = triangulate(&points);
    drop(points);
    let within = walls.domain.grown(0.5 * margin);
    let of_block = |(block, corners): (usize, &[usize])| {
        let (mut pairs, mut triples) = (Vec::new(), Vec::new());
        for (k, corner) in corners.chunks_exact(3).enumerate() {
            let first = block * BLOCK + 3 * k;
            let samples = [all[corner[0]], all[corner[1]], all[corner[2]]];
            for e in 0..3 {
                let twin = triangulation.halfedges[first + e];
                // Each edge once; those of the hull have no twin.
                if twin > first + e {
                    add_pairs(walls, &samples[e], &samples[(e + 1) % 3], &mut pairs);
                }
            }
            let center = circumcenter(samples.map(|s| s.point));
            // Only maxima within the domain count; those near its sides may move into it.
            if let Some(start) = center.filter(|x| within.contains(*x)) {
                let of = samples.map(|s| (s.wall, s.shift));
                let ends = samples.map(|s| walls.end_of_concave_arc(s.wall, s.u));
                triples.extend(distinct(Triple { walls: of, ends: [None; 3], start }));
                triples.extend(distinct(Triple { walls: of, ends, start }).filter(|_| ends != [None; 3]));
            }
        }
        (pairs, triples)
    };
    let (pairs, triples): (Vec<Vec<Pair>>, Vec<Vec<Triple>>) =
        triangulation.triangles.par_chunks(BLOCK).enumerate().map(of_block).unzip();
    drop((triangulation, all));
    (joined(pairs), joined(triples))
}

/// All items in order; each block is freed once it is copied.
pub(super) fn joined<T>(blocks: Vec<Vec<T>>) -> Vec<T> {
    let mut all = Vec::with_capacity(blocks.iter().map(Vec::len).sum());
    blocks.into_iter().for_each(|block| all.extend(block));
    all
}

/// A triple if its pieces, or their ends, are three.
fn distinct(triple: Triple) -> Option<Triple> {
    let [a, b, c] = [0, 1, 2].map(|k| (triple.walls[k], triple.ends[k]));
    (a != b && b != c && a != c).then_some(triple)
}

/// All pairs of some images of pieces.
pub fn all_pairs(walls: &Walls, images: &[(usize, Shift)]) -> Vec<Pair> {
    let middle = |&(wall, shift): &(usize, Shift)| walls.curve(wall, shift).point(0.5);
    let mut pairs = Vec::new();
    for (k, a) in images.iter().enumerate() {
        images[..k].iter().for_each(|b| pairs.extend(pair(walls, *a, *b, 0.5 * (middle(a) + middle(b)))));
    }
    pairs
}

/// Pairs sorted by their pieces, then by position.
pub(crate) fn sorted(mut pairs: Vec<Pair>) -> Vec<Pair> {
    let key = |pair: &Pair| (pair.walls, pair.shift);
    pairs.par_sort_by(|a, b| {
        let position = a.between.x.total_cmp(&b.between.x).then(a.between.y.total_cmp(&b.between.y));
        key(a).cmp(&key(b)).then(position)
    });
    pairs
}

/// Adds the pairs of pieces represented by two samples: a vertex represents both of its pieces.
fn add_pairs(walls: &Walls, a: &Sample, b: &Sample, pairs: &mut Vec<Pair>) {
    let between = 0.5 * (a.point + b.point);
    for p in pieces(walls, a) {
        pairs.extend(pieces(walls, b).filter_map(|q| pair(walls, p, q, between)));
    }
}

/// The pair of two images of pieces with a point between them; `None` where they are one.
pub(super) fn pair(walls: &Walls, p: (usize, Shift), q: (usize, Shift), between: Vec2) -> Option<Pair> {
    let (first, second) = if (p.0, q.1) <= (q.0, p.1) && p.0 <= q.0 { (p, q) } else { (q, p) };
    let of_first = || Pair {
        walls: [first.0, second.0],
        shift: minus(second.1, first.1),
        between: between - walls.offset(first.1),
    };
    (p != q).then(of_first)
}

fn pieces(walls: &Walls, sample: &Sample) -> impl Iterator<Item = (usize, Shift)> + use<> {
    let before = walls.walls[sample.wall].before.filter(|_| sample.u == 0.0);
    let shift = sample.shift;
    std::iter::once((sample.wall, shift)).chain(before.map(|link| (link.wall, plus(shift, link.shift))))
}

fn circumcenter([a, b, c]: [Vec2; 3]) -> Option<Vec2> {
    let (d, e) = (b - a, c - a);
    let twice = 2.0 * crate::curve::cross(d, e);
    let (bl, cl) = (d.norm_squared(), e.norm_squared());
    let x = Vec2::new(e.y * bl - d.y * cl, d.x * cl - e.x * bl) / twice;
    (x.x.is_finite() && x.y.is_finite()).then_some(a + x)
}
