//! The surface of united bodies: the parts of their curves that no other body covers, and a fast nearest-point search.
//!
//! Every curve is split at its intersections with other bodies, and a part is kept if its midpoint is outside all other bodies. Of two coincident surfaces
//! one is kept if both solids lie on the same side, and none if the solids touch. Hence the depth within overlapping solids is the distance to the true
//! surface, not the minimum over the bodies.

use crate::body::{Body, Location};
use crate::curve::{ClosestPoint, Curve};
use crate::intersect::intersections;
use crate::tree::Tree;
use meniscus_core::math::{Bounds, Vec2};
use rayon::prelude::*;

/// Up to this many pieces a plain loop is faster than the tree.
const TREE_FROM: usize = 16;

/// A piece of the surface, solid on the left.
#[derive(Debug, Clone, Copy)]
pub struct Piece {
    pub curve: Curve,
    /// Index of its shape.
    pub shape: u32,
}

/// The nearest point of the surface.
#[derive(Debug, Clone, Copy)]
pub struct Nearest {
    /// Index of the piece.
    pub piece: usize,
    /// The point on it.
    pub closest: ClosestPoint,
}

/// Pieces with a search structure.
#[derive(Clone)]
pub struct Boundary {
    pub(crate) pieces: Vec<Piece>,
    /// For the start and end of each piece: the mean outward normal of the two pieces that join there; empty where it is not needed.
    pub(crate) corners: Vec<[Option<Vec2>; 2]>,
    /// The tree over the boxes of the pieces.
    pub(crate) tree: Tree,
}

/// The parts of `curve` between its intersections with `others`.
pub(crate) fn split<'a>(curve: &Curve, others: impl Iterator<Item = &'a Curve>, tolerance: f64) -> Vec<Curve> {
    let near = curve.bounds().grown(tolerance);
    let mut parameters = Vec::new();
    for other in others {
        if near.overlaps(&other.bounds()) {
            intersections(curve, other, tolerance, &mut parameters);
        }
    }
    if parameters.is_empty() {
        return vec![*curve];
    }
    divided(curve, parameters, tolerance).into_iter().map(|[from, to]| curve.part(from, to)).collect()
}

/// The intervals between parameters of a curve that are longer than `tolerance` (m).
pub(crate) fn divided(curve: &Curve, mut parameters: Vec<f64>, tolerance: f64) -> Vec<[f64; 2]> {
    parameters.sort_by(f64::total_cmp);
    if let Some(&first) = parameters.first().filter(|_| curve.is_closed()) {
        // Starting at the first intersection keeps an arc across the circle's start in one piece.
        parameters.push(first + 1.0);
    } else {
        parameters.insert(0, 0.0);
        parameters.push(1.0);
    }
    let shortest = tolerance / curve.length();
    let (mut found, mut from) = (Vec::new(), parameters[0]);
    for &to in &parameters[1..] {
        if to - from > shortest {
            found.push([from, to]);
            from = to;
        }
    }
    found
}

/// Whether a part with this outward normal remains in a union with one other body.
fn stays(location: Location, normal: Vec2, is_first: bool) -> bool {
    match location {
        Location::In => false,
        Location::Out => true,
        Location::On(other) => is_first && other.dot(&normal) > 0.0,
    }
}

/// Bodies with a search by position.
struct Bodies<'a> {
    all: &'a [&'a Body],
    tree: Tree,
    tolerance: f64,
}

impl<'a> Bodies<'a> {
    fn new(all: &'a [&'a Body], tolerance: f64) -> Self {
        Self { all, tree: Tree::over(all.iter().map(|body| body.bounds)), tolerance }
    }

    /// The parts of `curve` between its intersections with the bodies, except that of index `but`.
    fn split(&self, curve: &Curve, but: Option<usize>) -> Vec<Curve> {
        let near = curve.bounds().grown(self.tolerance);
        let others = self.tree.near_in_order(near).into_iter().filter(|&j| Some(j) != but);
        split(curve, others.flat_map(|j| self.all[j].curves.near(near)), self.tolerance)
    }

    /// Indices of the bodies that may contain `x`; it is outside all others.
    fn around(&self, x: Vec2) -> impl Iterator<Item = usize> {
        // Twice the tolerance: rounding must not hide a body whose box ends at it.
        self.tree.near(Bounds { min: x, max: x }.grown(2.0 * self.tolerance))
    }
}

/// The surface of the union of bodies.
pub fn union(bodies: &[&Body], tolerance: f64) -> Vec<Piece> {
    let all = Bodies::new(bodies, tolerance);
    let is_kept = |i: usize, part: &Curve| {
        let (middle, normal) = (part.point(0.5), part.normal(0.5));
        let mut others = all.around(middle).filter(|&j| j != i);
        others.all(|j| stays(bodies[j].locate(middle, tolerance), normal, i < j))
    };
    let of_body = |(i, body): (usize, &&Body)| {
        let parts = body.curves.iter().flat_map(|curve| all.split(curve, Some(i)));
        let kept = parts.filter(|part| is_kept(i, part));
        kept.map(|curve| Piece { curve, shape: body.shape }).collect::<Vec<_>>()
    };
    bodies.par_iter().enumerate().flat_map_iter(of_body).collect()
}

/// The surface of the solid outside all `pores`, united with the solid `walls`.
pub(crate) fn complement(pores: &[&Body], walls: &[&Body], tolerance: f64) -> Vec<Piece> {
    let (all_pores, all_walls) = (Bodies::new(pores, tolerance), Bodies::new(walls, tolerance));
    let mut pieces = Vec::new();
    for piece in union(pores, tolerance) {
        for part in all_walls.split(&piece.curve.reversed(), None) {
            let (middle, normal) = (part.point(0.5), part.normal(0.5));
            if all_walls.around(middle).all(|j| stays(walls[j].locate(middle, tolerance), normal, true)) {
                pieces.push(Piece { curve: part, shape: piece.shape });
            }
        }
    }
    for piece in union(walls, tolerance) {
        for part in all_pores.split(&piece.curve, None) {
            let middle = part.point(0.5);
            if all_pores.around(middle).any(|j| pores[j].locate(middle, tolerance) == Location::In) {
                pieces.push(Piece { curve: part, shape: piece.shape });
            }
        }
    }
    pieces
}

/// The surface of a body outside the others.
pub fn difference(body: &Body, others: &[&Body], tolerance: f64) -> Vec<Curve> {
    let all = Bodies::new(others, tolerance);
    let mut curves = Vec::new();
    for part in body.curves.iter().flat_map(|curve| all.split(curve, None)) {
        let (middle, normal) = (part.point(0.5), part.normal(0.5));
        let is_kept = all.around(middle).all(|j| match others[j].locate(middle, tolerance) {
            Location::In => false,
            Location::Out => true,
            // Adjacent to it, not in it.
            Location::On(other) => other.dot(&normal) < 0.0,
        });
        curves.extend(is_kept.then_some(part));
    }
    for piece in union(others, tolerance) {
        let near = body.curves.near(piece.curve.bounds().grown(tolerance));
        let parts = split(&piece.curve, near, tolerance).into_iter();
        let inside = parts.filter(|part| body.locate(part.point(0.5), tolerance) == Location::In);
        curves.extend(inside.map(|part| part.reversed()));
    }
    curves
}

/// The surface of the intersection of two bodies.
pub fn intersection(one: &Body, other: &Body, tolerance: f64) -> Vec<Curve> {
    let mut curves = Vec::new();
    for (kept, by, is_first) in [(one, other, true), (other, one, false)] {
        for curve in kept.curves.iter() {
            let near = by.curves.near(curve.bounds().grown(tolerance));
            curves.extend(split(curve, near, tolerance).into_iter().filter(|part| {
                match by.locate(part.point(0.5), tolerance) {
                    Location::In => true,
                    Location::Out => false,
                    Location::On(normal) => is_first && normal.dot(&part.normal(0.5)) > 0.0,
                }
            }));
        }
    }
    curves
}

/// The part of a body within a box, including the sides of the box.
pub fn clip_body(body: &Body, bounds: Bounds, tolerance: f64) -> Body {
    let curves = intersection(body, &Body::of_box(body.shape, bounds), tolerance);
    body.within(bounds, curves)
}

impl Boundary {
    /// Builds the search structure. Ends closer than `tolerance` (m) are joined.
    pub fn new(pieces: Vec<Piece>, tolerance: f64) -> Self {
        let corners = corners(&pieces, tolerance);
        Self { corners, ..Self::of_pieces(pieces) }
    }

    /// The same without normals at corners, which the nearest points of pieces do not need.
    pub fn of_pieces(pieces: Vec<Piece>) -> Self {
        let tree = Tree::over(pieces.iter().map(|piece| piece.curve.bounds()));
        Self { pieces, corners: Vec::new(), tree }
    }

    /// The nearest points to `x` on all pieces within `reach` (m).
    pub(crate) fn within(&self, x: Vec2, reach: f64) -> impl Iterator<Item = Nearest> {
        self.tree.within(x, reach).filter_map(move |piece| {
            let closest = self.pieces.get(piece)?.curve.project(x);
            ((closest.point - x).norm() <= reach).then_some(Nearest { piece, closest })
        })
    }

    /// The nearest point of the surface to `x`; `None` if there is no surface.
    pub fn nearest(&self, x: Vec2) -> Option<Nearest> {
        let squared = |piece: &Piece| (piece.curve.project(x).point - x).norm_squared();
        let piece = if self.pieces.len() <= TREE_FROM {
            let all = self.pieces.iter().map(squared).enumerate();
            all.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
        } else {
            self.tree.nearest(x, |piece| squared(&self.pieces[piece])).map(|(piece, _)| piece)
        }?;
        Some(Nearest { piece, closest: self.pieces[piece].curve.project(x) })
    }
}

/// For each piece the one that starts at its end, if exactly two ends meet; else `None`.
pub fn followers(pieces: &[Piece], tolerance: f64) -> Vec<Option<usize>> {
    // Start and end of every open piece, sorted into grid cells: all near ones lie in the nine cells around.
    let cell = |v: f64| (v / tolerance).floor() as i64;
    let mut ends: Vec<([i64; 2], Vec2, usize, bool)> = Vec::new();
    for (i, piece) in pieces.iter().enumerate().filter(|(_, piece)| !piece.curve.is_closed()) {
        for (point, is_start) in [(piece.curve.point(0.0), true), (piece.curve.point(1.0), false)] {
            ends.push(([cell(point.x), cell(point.y)], point, i, is_start));
        }
    }
    ends.sort_by_key(|end| end.0);
    let mut next = vec![None; pieces.len()];
    for (k, &([x, y], point, i, _)) in ends.iter().enumerate().filter(|(_, end)| !end.3) {
        let around = [x.saturating_sub(1), x, x.saturating_add(1)].into_iter().flat_map(|column| {
            let first = ends.partition_point(|end| end.0 < [column, y.saturating_sub(1)]);
            let last = [column, y.saturating_add(1)];
            ends[first..].iter().zip(first..).take_while(move |(end, _)| end.0 <= last)
        });
        let mut met = around.filter(|(end, j)| *j != k && (end.1 - point).norm() <= tolerance);
        if let (Some((&(_, _, j, true), _)), None) = (met.next(), met.next()) {
            next[i] = Some(j);
        }
    }
    next
}

/// The pieces in the order in which they follow each other, and whether the chain is closed.
pub fn chains(pieces: &[Piece], next: &[Option<usize>]) -> Vec<(Vec<usize>, bool)> {
    let mut has_before = vec![false; pieces.len()];
    next.iter().flatten().for_each(|&j| has_before[j] = true);
    let mut done = vec![false; pieces.len()];
    let mut chains = Vec::new();
    // Open chains first, from their start; the remaining ones are closed.
    let open = (0..pieces.len()).filter(|&i| !has_before[i]);
    for first in open.chain(0..pieces.len()) {
        let mut chain = Vec::new();
        let mut at = Some(first);
        while let Some(i) = at.filter(|&i| !done[i]) {
            done[i] = true;
            chain.push(i);
            at = next[i];
        }
        if !chain.is_empty() {
            chains.push((chain, at == Some(first) || pieces[first].curve.is_closed()));
        }
    }
    chains
}

fn corners(pieces: &[Piece], tolerance: f64) -> Vec<[Option<Vec2>; 2]> {
    // Below this sum of two unit normals the corner is a cusp whose mean normal is meaningless.
    const CUSP: f64 = 1e-3;
    let mut corners = vec![[None; 2]; pieces.len()];
    for (i, next) in followers(pieces, tolerance).into_iter().enumerate() {
        let Some(j) = next else { continue };
        let sum = pieces[i].curve.normal(1.0) + pieces[j].curve.normal(0.0);
        if let Some(mean) = sum.try_normalize(CUSP) {
            corners[i][1] = Some(mean);
            corners[j][0] = Some(mean);
        }
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_across_a_side_of_a_box_is_cut_there_whatever_the_rounding_of_its_radius() {
        let domain = Bounds { min: Vec2::repeat(-2.0), max: Vec2::repeat(2.0) };
        let frame = Body::of_box(0, domain);
        for k in 0..1000 {
            let circle = Curve::circle(Vec2::new(-1.9, -0.5), 0.1 + 1e-4 * f64::from(k));
            let parts = split(&circle, frame.curves.iter(), 4e-9);
            let inside = parts.iter().filter(|p| frame.locate(p.point(0.5), 4e-9) == Location::In).count();
            assert_eq!(inside, 1, "{k} {parts:?}");
        }
    }
}
