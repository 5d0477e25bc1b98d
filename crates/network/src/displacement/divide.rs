//! Division of a loop between more than three walls.
//!
//! A meniscus that advances through a gate moves along two walls and may touch a third one. For each such event to have its own element, a pore region with
//! more than three stretches of wall on its loop is divided by the shortest segments from wall to wall inside it (for discs mostly the Delaunay edges of
//! neighbors without a throat), until each part has three stretches of wall or no segment is left. The parts tile the region.
//!
//! The region along a side of a pack of n posts has as many walls as the side has posts. Of a divided loop the larger part keeps the pairs of walls that are
//! left, so that a division costs as much as the smaller part and the two new walls have pairs.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::loops::{Loop, WallPoint};
use crate::graph::WallPiece;
use meniscus_core::math::Vec2;
use meniscus_geometry::closest::closest_points as closest;
use meniscus_geometry::curve::{Curve, cross};
use meniscus_geometry::intersect::intersections;

/// Relative tolerance of equal lengths.
const SAME_LENGTH: f64 = 1e-9;

/// A pair of walls that a segment may join, by the distance between them.
#[derive(Clone, Copy)]
struct Pair {
    length: f64,
    /// The numbers of both walls, not their places in the loop.
    walls: [u32; 2],
}

impl PartialEq for Pair {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Pair {}

impl PartialOrd for Pair {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Pair {
    /// The shortest is the greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.length.total_cmp(&self.length).then(other.walls.cmp(&self.walls))
    }
}

/// A segment from wall `a` to wall `b` of a loop.
#[derive(Clone, Copy)]
struct Segment {
    length: f64,
    a: usize,
    b: usize,
    p: WallPoint,
    q: WallPoint,
    pair: Pair,
}

/// A part of a loop, with numbers for its walls and pairs of walls; walls of other parts are left in the pairs.
struct Part {
    ring: Loop,
    numbers: Vec<u32>,
    /// The first number that no wall has had.
    free: u32,
    pairs: BinaryHeap<Pair>,
}

impl Part {
    fn new(ring: Loop) -> Self {
        let count = ring.walls.len();
        let mut part =
            Self { numbers: (0..count as u32).collect(), free: count as u32, ring, pairs: BinaryHeap::new() };
        // Between at most three walls nothing is divided.
        if count > 3 {
            let all = (0..count).flat_map(|a| (a + 2..count).map(move |b| (a, b)));
            part.pairs = all.filter_map(|(a, b)| part.pair(a, b)).collect::<Vec<_>>().into();
        }
        part
    }

    /// The pair of the walls at two places, the first one before the second; `None` for neighbors.
    fn pair(&self, a: usize, b: usize) -> Option<Pair> {
        let walls = &self.ring.walls;
        if a + 1 >= b || (a == 0 && b + 1 == walls.len()) {
            return None;
        }
        let (p, q) = closest_points(&walls[a], &walls[b])?;
        Some(Pair { length: (p.point - q.point).norm(), walls: [self.numbers[a], self.numbers[b]] })
    }

    /// The two parts on both sides of the shortest dividing segment; `None` if there is none. Segments of equal length that cross each other, as the diagonals
    /// of a square array, are not used.
    fn divided(&mut self, segment: usize) -> Option<[Self; 2]> {
        let mut place = vec![None; self.free as usize];
        self.numbers.iter().enumerate().for_each(|(k, &number)| place[number as usize] = Some(k));
        let curves = self.ring.curves();
        let ends = |it: &Segment| [it.p.point, it.q.point];
        let mut unused = Vec::new();
        let mut equal: Vec<Segment> = Vec::new();
        let chosen = loop {
            let next = self.next_segment(&place, &curves);
            let is_longer =
                |next: &Segment| equal.first().is_some_and(|it| next.length > it.length * (1.0 + SAME_LENGTH));
            match next {
                Some(next) if !is_longer(&next) => {
                    equal.push(next);
                    continue;
                }
                Some(next) => self.pairs.push(next.pair),
                None if equal.is_empty() => break None,
                None => {}
            }
            equal.sort_by(|x, y| x.length.total_cmp(&y.length).then((x.a, x.b).cmp(&(y.a, y.b))));
            let is_free = |one: &&Segment| equal.iter().all(|other| !do_cross(ends(one), ends(other)));
            let chosen = equal.iter().find(is_free).copied();
            unused.extend(equal.drain(..).map(|it| it.pair));
            if chosen.is_some() {
                break chosen;
            }
        };
        let Segment { a, b, p, q, .. } = chosen?;
        self.pairs.extend(unused);
        let rings = self.ring.cut((a, p), (b, q), segment);
        let (free, numbers) = (self.free, &self.numbers);
        let kept = [numbers[a + 1..b].to_vec(), [&numbers[b + 1..], &numbers[..a]].concat()];
        let larger = usize::from(kept[1].len() > kept[0].len());
        let mut pairs = Some(std::mem::take(&mut self.pairs));
        let mut number = 0;
        Some(rings.map(|ring| {
            let (kept, is_larger) = (&kept[number], number == larger);
            number += 1;
            match pairs.take_if(|_| is_larger) {
                Some(pairs) if ring.walls.len() > 3 => {
                    let numbers = [&[free], &kept[..], &[free + 1]].concat();
                    let mut part = Self { ring, numbers, free: free + 2, pairs };
                    let last = part.numbers.len() - 1;
                    let with_new = (0..last).map(|b| (0, b)).chain((1..last).map(|a| (a, last)));
                    let new: Vec<Pair> = with_new.filter_map(|(a, b)| part.pair(a, b)).collect();
                    part.pairs.extend(new);
                    part
                }
                _ => Self::new(ring),
            }
        }))
    }

    /// The shortest segment left between two walls of this part that lies inside it; `place` is that of each number.
    fn next_segment(&mut self, place: &[Option<usize>], curves: &[Curve]) -> Option<Segment> {
        while let Some(pair) = self.pairs.pop() {
            let [Some(one), Some(other)] = pair.walls.map(|number| place[number as usize]) else { continue };
            let (a, b) = (one.min(other), one.max(other));
            let Some((p, q)) = closest_points(&self.ring.walls[a], &self.ring.walls[b]) else { continue };
            // The walls after the first one are most likely in the way.
            let first: usize = self.ring.walls[..=a].iter().map(|wall| wall.len() + 1).sum();
            if holds_segment(curves, first % curves.len().max(1), p.point, q.point) {
                return Some(Segment { length: (p.point - q.point).norm(), a, b, p, q, pair });
            }
        }
        None
    }
}

/// Divides a loop until each part has at most three stretches of wall or no dividing segment is left. Segments are numbered from
/// `segments` on, which is advanced.
pub(super) fn divide(whole: Loop, segments: &mut usize) -> Vec<Loop> {
    // The position of the seam is arbitrary, and segments must not depend on it.
    if whole.has_seam {
        return vec![whole];
    }
    // Around the grains of a domain whose sides are all open: no segment has the loop around it.
    if whole.area() < 0.0 {
        return vec![whole];
    }
    let (mut open, mut done) = (vec![Part::new(whole)], Vec::new());
    while let Some(mut part) = open.pop() {
        match if part.ring.walls.len() > 3 { part.divided(*segments) } else { None } {
            Some(parts) => {
                *segments += 1;
                open.extend(parts);
            }
            None => done.push(part.ring),
        }
    }
    done
}

/// Whether two segments cross each other strictly between their ends.
fn do_cross([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    let slack = SAME_LENGTH * (b - a).norm() * (d - c).norm();
    let are_apart = |one: f64, other: f64| one.min(other) < -slack && one.max(other) > slack;
    are_apart(cross(b - a, c - a), cross(b - a, d - a)) && are_apart(cross(d - c, a - c), cross(d - c, b - c))
}

/// Whether the segment between two points on the walls of a loop lies inside it without meeting any of its curves in between, of which the one of number
/// `first` is tried first.
pub(super) fn holds_segment(curves: &[Curve], first: usize, p: Vec2, q: Vec2) -> bool {
    // Fraction of the segment at both ends that may meet its own walls.
    const AT_ENDS: f64 = 1e-6;
    // Fraction of the segment within which a curve meets it.
    const WITHIN: f64 = 1e-9;
    let segment = Curve::Segment { a: p, b: q };
    let length = segment.length();
    if !(length > 0.0) {
        return false;
    }
    let near = segment.enclosing_box().grown(2.0 * WITHIN * length);
    let mut parameters = Vec::new();
    for curve in curves[first..].iter().chain(&curves[..first]) {
        if !near.overlaps(&curve.enclosing_box()) {
            continue;
        }
        parameters.clear();
        intersections(&segment, curve, WITHIN * length, &mut parameters);
        if parameters.iter().any(|u| (AT_ENDS..=1.0 - AT_ENDS).contains(u)) {
            return false;
        }
    }
    let middle = 0.5 * (p + q);
    // The pore lies on the right of the loop.
    let winding: f64 = curves.iter().map(|curve| curve.winding(middle)).sum();
    winding < -std::f64::consts::PI
}

fn project(wall: &[WallPiece], x: Vec2) -> Option<WallPoint> {
    let closest = wall.iter().enumerate().map(|(piece, wall)| (piece, wall.curve.project(x)));
    let distance = |point: Vec2| (point - x).norm_squared();
    let found = closest.min_by(|a, b| distance(a.1.point).total_cmp(&distance(b.1.point)));
    found.map(|(piece, closest)| WallPoint::of(piece, closest))
}

/// Number of points, of two, that are ends of their pieces.
fn ends(one: &WallPoint, other: &WallPoint) -> usize {
    // On an arc points as near to its end as this are as near to a facing wall, within rounding of distances.
    const AT_END: f64 = 1e-4;
    [one, other].into_iter().filter(|it| !(AT_END..=1.0 - AT_END).contains(&it.u)).count()
}

/// The closest points of two stretches of wall.
fn closest_points(one: &[WallPiece], other: &[WallPiece]) -> Option<(WallPoint, WallPoint)> {
    // Number of pairs of pieces up to which all are tried.
    const FEW: usize = 256;
    if one.len() * other.len() > FEW {
        return closest_of_many(one, other);
    }
    let mut best: Option<(f64, WallPoint, WallPoint)> = None;
    for (i, a) in one.iter().enumerate() {
        for (j, b) in other.iter().enumerate() {
            let [p, q] = closest(&a.curve, &b.curve);
            let distance = (p.point - q.point).norm();
            let found = (distance, WallPoint::of(i, p), WallPoint::of(j, q));
            // A corner is the end of two pieces; if one of them is parallel to the other wall, the middle of both counts.
            let is_closer = |best: (f64, WallPoint, WallPoint)| {
                let rounding = SAME_LENGTH * distance;
                distance < best.0 - rounding
                    || distance <= best.0 + rounding && ends(&found.1, &found.2) < ends(&best.1, &best.2)
            };
            if best.is_none_or(is_closer) {
                best = Some(found);
            }
        }
    }
    best.map(|(_, p, q)| (p, q))
}

/// The closest points of two stretches of many pieces: from samples, then by alternating projection until convergence.
fn closest_of_many(one: &[WallPiece], other: &[WallPiece]) -> Option<(WallPoint, WallPoint)> {
    const SAMPLES: usize = 16;
    const MOST_STEPS: usize = 60;
    let stride = one.len().div_ceil(SAMPLES).max(1);
    let mut best: Option<(f64, WallPoint, WallPoint)> = None;
    for (piece, wall) in one.iter().enumerate().step_by(stride) {
        for u in [0.0, 0.5, 1.0] {
            let p = WallPoint { piece, u, point: wall.curve.point(u) };
            let Some(q) = project(other, p.point) else { continue };
            let distance = (p.point - q.point).norm();
            if best.is_none_or(|(least, ..)| distance < least) {
                best = Some((distance, p, q));
            }
        }
    }
    let (mut distance, mut p, mut q) = best?;
    for _ in 0..MOST_STEPS {
        let Some(next) = project(one, q.point) else { break };
        let Some(facing) = project(other, next.point) else { break };
        let closer = (next.point - facing.point).norm();
        if closer >= distance {
            break;
        }
        let rests = distance - closer <= 1e-15 * distance;
        (distance, p, q) = (closer, next, facing);
        if rests {
            break;
        }
    }
    Some((p, q))
}
