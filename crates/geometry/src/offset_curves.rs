//! Offset curves: lines at a constant depth below the surface of a solid, or above it, on which particles are placed.
//!
//! The surface is followed from piece to piece. Each sample of it is displaced along the normal, and a fan of samples around each corner closes the gap that
//! opens there. A sample is kept if its depth is the nominal one: where bodies overlap, and on the inner side of corners, another part of the surface is
//! nearer, and the line is cut. Straight parts that the caller's lattice fits are omitted. The interface between two phases is the surface of the region
//! filled by one of them.

use rayon::prelude::*;

use crate::boundary::{Nearest, Piece, chains, followers};
use crate::curve::{Curve, cross};
use crate::interface::polyline::Polyline;
use crate::solid::Geometry;
use meniscus_core::math::{Bounds, Vec2};

/// Tolerance of the depth over the distance of samples.
const SAME_DEPTH: f64 = 1e-2;

/// Bisections of the interval in which a line is cut.
const HALVINGS: usize = 12;

/// Number of samples of a part of a curve that is not divided further.
const LEAST_SAMPLES: usize = 16;

/// Ends of a line nearer than this many distances of samples are joined: the two sides of a corner.
const JOINED: f64 = 2.0;

impl Polyline {
    /// Equidistant points along the line, as near to `spacing` (m) as their number allows; an even number on a closed line, which preserves the symmetry of a
    /// disc.
    pub fn every(&self, spacing: f64) -> Vec<Vec2> {
        let share = self.length() / spacing;
        self.divided(if self.closed { 2.0 * (0.5 * share).round() } else { share.round() } as usize)
    }

    /// `count` equidistant points along the line, starting half a spacing from the ends of an open line.
    pub fn divided(&self, count: usize) -> Vec<Vec2> {
        let length = self.length();
        let mut points = Vec::with_capacity(count);
        let mut passed = 0.0;
        for (a, b) in self.segments() {
            let here = (b - a).norm();
            while points.len() < count {
                let next = (points.len() as f64 + 0.5) * length / count as f64;
                if next > passed + here {
                    break;
                }
                points.push(a + (b - a) * ((next - passed) / here));
            }
            passed += here;
        }
        // The last point can be lost to rounding of the length.
        let last = self.points[self.points.len() - 1];
        points.resize(count, last);
        points
    }
}

/// The parts of a geometry's surface that do not fit a lattice: curved, oblique, or between its rows.
pub struct UnfittedSurface<'a> {
    geometry: &'a Geometry,
    /// The domain, extended by its own size: the range of admissible lines.
    near: Bounds,
    is_unfitted: Vec<bool>,
    next: Vec<Option<usize>>,
    before: Vec<Option<usize>>,
    counts: Option<Box<Counts<'a>>>,
}

/// Whether a point of a surface (m) with this normal counts.
type Counts<'a> = dyn Fn(Vec2, Vec2) -> bool + Send + Sync + 'a;

/// The nearest relevant point of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// Signed distance in m, below 0 in the solid.
    pub distance: f64,
    /// Unit normal out of the solid.
    pub normal: Vec2,
    /// Whether the surface does not fit a lattice there; at a corner, whether one of its two sides does not.
    pub is_unfitted: bool,
}

impl<'a> UnfittedSurface<'a> {
    /// The surface near the domain without the straight parts whose ends satisfy `is_on_lattice`.
    pub fn new(geometry: &'a Geometry, reach: f64, is_on_lattice: impl Fn(Vec2, Vec2) -> bool) -> Self {
        let pieces = &geometry.boundary.pieces;
        let near = geometry.bounds().grown(reach);
        let is_unfitted = |piece: &Piece| {
            let on_lattice = matches!(piece.curve, Curve::Segment { a, b } if is_on_lattice(a, b));
            !on_lattice && near.overlaps(&piece.curve.bounds())
        };
        let next = followers(pieces, 10.0 * geometry.tolerance());
        let mut before = vec![None; pieces.len()];
        for (i, j) in next.iter().enumerate().filter_map(|(i, j)| j.map(|j| (i, j))) {
            before[j] = Some(i);
        }
        let is_unfitted = pieces.iter().map(is_unfitted).collect();
        let near = near.grown(geometry.bounds().size().max());
        Self { geometry, near, is_unfitted, next, before, counts: None }
    }

    /// The same surface, restricted to points for which `counts` holds, given their position (m) and normal.
    pub fn restricted(self, counts: impl Fn(Vec2, Vec2) -> bool + Send + Sync + 'a) -> Self {
        Self { counts: Some(Box::new(counts)), ..self }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        !self.is_unfitted.contains(&true)
    }

    /// Whether the part nearest to `x` is one of these; at a corner, whether one of its two sides is.
    pub fn own(&self, x: Vec2) -> bool {
        self.near(x, f64::INFINITY).is_some_and(|near| near.is_unfitted)
    }

    /// The nearest relevant point of the surface within `reach` (m) of `x`.
    pub fn near(&self, x: Vec2, reach: f64) -> Option<Near> {
        let (x, boundary) = (self.geometry.wrapped(x), &self.geometry.boundary);
        let nearest = match &self.counts {
            None => boundary.nearest(x).filter(|nearest| (nearest.closest.point - x).norm() <= reach),
            Some(counts) => {
                let normal = |near: &Nearest| boundary.pieces[near.piece].curve.normal(near.closest.u);
                let counted = boundary.within(x, reach).filter(|near| counts(near.closest.point, normal(near)));
                counted.min_by(|a, b| (a.closest.point - x).norm().total_cmp(&(b.closest.point - x).norm()))
            }
        }?;
        let Nearest { piece, closest } = nearest;
        let beside = match closest.u {
            _ if boundary.pieces[piece].curve.is_closed() => None,
            0.0 => self.before[piece],
            1.0 => self.next[piece],
            _ => None,
        };
        let wall = self.geometry.wall_at(x, nearest);
        let is_unfitted = self.is_unfitted[piece] || beside.is_some_and(|beside| self.is_unfitted[beside]);
        Some(Near { distance: wall.distance, normal: wall.normal, is_unfitted })
    }

    /// The lines at `depth` below the surface, or above it if that is negative, where `within` holds, sampled at intervals `step`; all in m.
    pub fn offset_curves(&self, depth: f64, step: f64, within: impl Fn(Vec2) -> bool + Sync) -> Vec<Polyline> {
        let mut offset_curves = Vec::new();
        for (chain, is_closed) in chains(&self.geometry.boundary.pieces, &self.next) {
            let samples = self.samples(&chain, is_closed, depth, step);
            offset_curves.extend(self.cut(&samples, is_closed, depth, step, &within));
        }
        offset_curves
    }

    /// The samples of a chain displaced to `depth`; those of omitted parts are `None`, and cut the line.
    fn samples(&self, chain: &[usize], is_closed: bool, depth: f64, step: f64) -> Vec<Option<Vec2>> {
        let mut samples = Vec::new();
        for (k, &i) in chain.iter().enumerate() {
            let curve = &self.geometry.boundary.pieces[i].curve;
            if self.is_unfitted[i] {
                let at = |u: f64| curve.point(u) - depth * curve.normal(u);
                self.samples_of(curve, step, &mut |u| samples.push(u.map(at)));
            } else {
                samples.push(None);
            }
            let follower = if k + 1 < chain.len() { Some(chain[k + 1]) } else { is_closed.then(|| chain[0]) };
            if let Some(j) = follower.filter(|&j| !curve.is_closed() && (self.is_unfitted[i] || self.is_unfitted[j])) {
                let (from, to) = (curve.tangent(1.0), self.geometry.boundary.pieces[j].curve.tangent(0.0));
                let angle = cross(from, to).atan2(from.dot(&to));
                // Below a reentrant corner of the solid, and above a convex one.
                let leaves_gap = angle * depth < 0.0;
                if leaves_gap {
                    samples.extend(fan(curve.point(1.0), curve.normal(1.0) * depth, angle, step).map(Some));
                }
            }
        }
        samples
    }

    /// Samples of a curve by parameter, at intervals of at most `step` (m); a single `None` for each part far from the domain, however long.
    fn samples_of(&self, curve: &Curve, step: f64, take: &mut dyn FnMut(Option<f64>)) {
        let count = (curve.length() / step).ceil().max(1.0) as usize;
        let last = if curve.is_closed() { count - 1 } else { count };
        // Stack of the remaining parts, the next one last.
        let mut parts = vec![(0, last)];
        while let Some((from, to)) = parts.pop() {
            let half = (to - from) as f64 * 0.5 * curve.length() / count as f64;
            let middle = curve.point((from + to) as f64 * 0.5 / count as f64);
            if !self.near.grown(half).contains(middle) {
                take(None);
            } else if to - from < LEAST_SAMPLES || self.near.size().max() > half {
                (from..=to).for_each(|s| take(Some(s as f64 / count as f64)));
            } else {
                let cut = from.midpoint(to);
                parts.extend([(cut + 1, to), (from, cut)]);
            }
        }
    }

    /// The parts of a sampled line that have the nominal depth.
    fn cut(
        &self,
        samples: &[Option<Vec2>],
        is_closed: bool,
        depth: f64,
        step: f64,
        within: impl Fn(Vec2) -> bool + Sync,
    ) -> Vec<Polyline> {
        let has_depth = |x: Vec2| {
            let is_at_depth = |near: Near| (near.distance + depth).abs() < SAME_DEPTH * step && near.is_unfitted;
            within(x) && self.near(x, 2.0 * depth.abs()).is_some_and(is_at_depth)
        };
        let good: Vec<bool> = samples.par_iter().map(|x| x.is_some_and(has_depth)).collect();
        let sample = |i: usize| samples[i].unwrap_or_default();
        // The last valid point between a valid and an invalid sample.
        let end = |good: usize, bad: usize| {
            let (mut a, mut b) = (sample(good), samples[bad]?);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (a + b);
                if has_depth(middle) { a = middle } else { b = middle }
            }
            Some(a)
        };
        let n = samples.len();
        let first = if is_closed { good.iter().position(|good| !good) } else { None };
        let Some(first) = first.or((!is_closed).then_some(0)) else {
            return vec![Polyline { points: (0..n).map(sample).collect(), closed: true }];
        };
        let mut lines: Vec<Vec<Vec2>> = Vec::new();
        let mut line: Vec<Vec2> = Vec::new();
        for k in 0..n {
            let i = (first + k) % n;
            let before = if k > 0 || is_closed { Some((i + n - 1) % n) } else { None };
            if good[i] {
                if let Some(before) = before.filter(|&before| !good[before]) {
                    line.extend(end(i, before));
                }
                line.push(sample(i));
            } else if !line.is_empty() {
                line.extend(before.and_then(|before| end(before, i)));
                lines.push(std::mem::take(&mut line));
            }
        }
        if !line.is_empty() {
            // A closed line starts at an invalid sample, which follows its last valid one.
            line.extend(if is_closed { end((first + n - 1) % n, first) } else { None });
            lines.push(line);
        }
        join(lines, is_closed, JOINED * step)
    }
}

/// Samples around a corner: `spoke` from the first one to the corner, rotated by `angle` in total.
fn fan(corner: Vec2, spoke: Vec2, angle: f64, step: f64) -> impl Iterator<Item = Vec2> {
    let count = (angle.abs() * spoke.norm() / step).ceil().max(1.0) as usize;
    (0..=count).map(move |k| corner - nalgebra::Rotation2::new(angle * k as f64 / count as f64) * spoke)
}

/// Joins lines whose ends are within `reach` (m) of the start of the next one; lines shorter than that are dropped.
fn join(lines: Vec<Vec<Vec2>>, is_closed: bool, reach: f64) -> Vec<Polyline> {
    let mut joined: Vec<Vec<Vec2>> = Vec::new();
    for line in lines {
        match joined.last_mut().filter(|last| (last[last.len() - 1] - line[0]).norm() < reach) {
            Some(last) => last.extend(line),
            None => joined.push(line),
        }
    }
    let mut curves: Vec<Polyline> = joined.into_iter().map(|points| Polyline { points, closed: false }).collect();
    if is_closed {
        close(&mut curves, reach);
    }
    curves.retain(|line| line.points.len() > 1 && line.length() > reach);
    curves
}

/// Joins the last line of a closed chain to the first one if it continues into it.
fn close(curves: &mut Vec<Polyline>, reach: f64) {
    let Some(last) = curves.pop() else { return };
    let end = last.points[last.points.len() - 1];
    match curves.first_mut() {
        None => {
            let closed = (end - last.points[0]).norm() < reach;
            curves.push(Polyline { closed, ..last });
        }
        Some(first) if (end - first.points[0]).norm() < reach => {
            first.points = last.points.into_iter().chain(std::mem::take(&mut first.points)).collect();
        }
        Some(_) => curves.push(last),
    }
}
