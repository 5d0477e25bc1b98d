//! The surface of united bodies: the parts of their curves that no other body covers, and a fast search for the nearest.
//!
//! Every curve is split where it meets another body, and a part is kept where its middle lies in no other body. Where two
//! surfaces run together, one of them is kept if both solids lie on the same side and none if the solids touch. So depth
//! within overlapping solids is the distance to the true surface, not the least depth over the bodies.

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy};

use crate::geometry::body::{Body, Place};
use crate::geometry::curve::{Curve, Foot};
use crate::geometry::intersect::meeting_places;
use crate::math::{Bounds, Vec2};

/// Up to this many pieces a plain loop is faster than the tree.
const TREE_FROM: usize = 16;

/// A piece of the surface, solid on the left.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    /// Where it runs.
    pub curve: Curve,
    /// Index of its shape.
    pub shape: u32,
}

/// The nearest point of the surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nearest {
    /// Index of the piece.
    pub piece: usize,
    /// The point on it.
    pub foot: Foot,
}

/// A set of pieces that can be searched.
#[derive(Clone)]
pub(crate) struct Boundary {
    /// The pieces.
    pub pieces: Vec<Piece>,
    /// For the start and end of each piece: the mean outward normal of the two pieces that join there.
    pub corners: Vec<[Option<Vec2>; 2]>,
    tree: Bvh,
}

fn overlap(a: &Bounds, b: &Bounds) -> bool {
    (0..2).all(|i| a.min[i] <= b.max[i] && b.min[i] <= a.max[i])
}

/// The parts of `curve` between its meetings with `others`.
pub(crate) fn split<'a>(curve: &Curve, others: impl Iterator<Item = &'a Curve>, tolerance: f64) -> Vec<Curve> {
    let near = curve.bounds().grown(tolerance);
    let mut places = Vec::new();
    for other in others {
        if overlap(&near, &other.bounds()) {
            meeting_places(curve, other, tolerance, &mut places);
        }
    }
    if places.is_empty() {
        return vec![*curve];
    }
    places.sort_by(f64::total_cmp);
    let shortest = tolerance / curve.length();
    if curve.is_closed() {
        // Starting at the first meeting keeps an arc across the circle's start in one piece.
        places.push(places[0] + 1.0);
    } else {
        places.insert(0, 0.0);
        places.push(1.0);
    }
    let mut parts = Vec::new();
    let mut from = places[0];
    for &to in &places[1..] {
        if to - from > shortest {
            parts.push(curve.part(from, to));
            from = to;
        }
    }
    parts
}

/// Whether a part with this outward normal stays in a union, seen against one other body.
fn stays(place: Place, normal: Vec2, is_first: bool) -> bool {
    match place {
        Place::In => false,
        Place::Out => true,
        Place::On(other) => is_first && other.dot(&normal) > 0.0,
    }
}

/// The surface of the union of bodies.
pub(crate) fn union(bodies: &[Body], tolerance: f64) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (i, body) in bodies.iter().enumerate() {
        for curve in &body.curves {
            let near = curve.bounds().grown(tolerance);
            let others: Vec<usize> =
                (0..bodies.len()).filter(|&j| j != i && overlap(&near, &bodies[j].bounds)).collect();
            for part in split(curve, others.iter().flat_map(|&j| &bodies[j].curves), tolerance) {
                let (middle, normal) = (part.point(0.5), part.normal(0.5));
                if others.iter().all(|&j| stays(bodies[j].place(middle, tolerance), normal, i < j)) {
                    pieces.push(Piece { curve: part, shape: body.shape });
                }
            }
        }
    }
    pieces
}

/// The surface of the solid outside of all `pores` united with the solid `walls`.
pub(crate) fn complement(pores: &[Body], walls: &[Body], tolerance: f64) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for piece in union(pores, tolerance) {
        for part in split(&piece.curve.reversed(), walls.iter().flat_map(|w| &w.curves), tolerance) {
            let (middle, normal) = (part.point(0.5), part.normal(0.5));
            if walls.iter().all(|wall| stays(wall.place(middle, tolerance), normal, true)) {
                pieces.push(Piece { curve: part, shape: piece.shape });
            }
        }
    }
    for piece in union(walls, tolerance) {
        for part in split(&piece.curve, pores.iter().flat_map(|p| &p.curves), tolerance) {
            let middle = part.point(0.5);
            if pores.iter().any(|pore| pore.place(middle, tolerance) == Place::In) {
                pieces.push(Piece { curve: part, shape: piece.shape });
            }
        }
    }
    pieces
}

/// The part of a body within a box, the sides of the box included.
pub(crate) fn clip_body(body: &Body, bounds: Bounds, tolerance: f64) -> Body {
    let frame = Body::of_box(body.shape, bounds);
    let mut curves = Vec::new();
    for (kept, by, is_first) in [(body, &frame, true), (&frame, body, false)] {
        for curve in &kept.curves {
            for part in split(curve, by.curves.iter(), tolerance) {
                let keep = match by.place(part.point(0.5), tolerance) {
                    Place::In => true,
                    Place::Out => false,
                    Place::On(normal) => is_first && normal.dot(&part.normal(0.5)) > 0.0,
                };
                if keep {
                    curves.push(part);
                }
            }
        }
    }
    body.within(bounds, curves)
}

impl Boundary {
    /// Prepares pieces for the search. Ends closer than `tolerance` (m) are joined.
    pub fn new(pieces: Vec<Piece>, tolerance: f64) -> Self {
        let boxes: Vec<Aabb> = pieces
            .iter()
            .map(|piece| {
                let b = piece.curve.bounds();
                Aabb::new(Vector::new(b.min.x, b.min.y), Vector::new(b.max.x, b.max.y))
            })
            .collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        let corners = corners(&pieces, tolerance);
        Self { pieces, corners, tree }
    }

    /// The nearest points to `x` of all pieces within `reach` (m).
    pub fn within(&self, x: Vec2, reach: f64) -> impl Iterator<Item = Nearest> {
        let (low, high) = (x - Vec2::repeat(reach), x + Vec2::repeat(reach));
        let leaves = self.tree.leaves(move |node| {
            let (min, max) = (node.mins(), node.maxs());
            min.x <= high.x && low.x <= max.x && min.y <= high.y && low.y <= max.y
        });
        leaves.filter_map(move |leaf| {
            let piece = leaf as usize;
            let foot = self.pieces.get(piece)?.curve.project(x);
            ((foot.point - x).norm() <= reach).then_some(Nearest { piece, foot })
        })
    }

    /// The nearest point of the surface to `x`; none where there is no surface.
    pub fn nearest(&self, x: Vec2) -> Option<Nearest> {
        let squared = |piece: &Piece| (piece.curve.project(x).point - x).norm_squared();
        let piece = if self.pieces.len() <= TREE_FROM {
            let all = self.pieces.iter().map(squared).enumerate();
            all.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(index, _)| index)
        } else {
            let to_box = |min: Vector, max: Vector| {
                let (dx, dy) = ((min.x - x.x).max(x.x - max.x).max(0.0), (min.y - x.y).max(x.y - max.y).max(0.0));
                dx * dx + dy * dy
            };
            self.tree
                .find_best(
                    f64::MAX,
                    |node, _| to_box(node.mins(), node.maxs()),
                    |leaf, _| self.pieces.get(leaf as usize).map(squared),
                )
                .map(|(leaf, _)| leaf as usize)
        }?;
        Some(Nearest { piece, foot: self.pieces[piece].curve.project(x) })
    }
}

/// For each piece the piece whose start is its end, where exactly two ends meet; `None` elsewhere.
pub(crate) fn followers(pieces: &[Piece], tolerance: f64) -> Vec<Option<usize>> {
    // Start and end of every piece that has ends, sorted along x so that a short window holds all near ones.
    let mut ends: Vec<(Vec2, usize, bool)> = Vec::new();
    for (i, piece) in pieces.iter().enumerate().filter(|(_, piece)| !piece.curve.is_closed()) {
        ends.push((piece.curve.point(0.0), i, true));
        ends.push((piece.curve.point(1.0), i, false));
    }
    ends.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
    let mut next = vec![None; pieces.len()];
    for (k, &(point, i, _)) in ends.iter().enumerate().filter(|(_, end)| !end.2) {
        let before = ends[..k].iter().rev().take_while(|end| point.x - end.0.x <= tolerance);
        let after = ends[k + 1..].iter().take_while(|end| end.0.x - point.x <= tolerance);
        let mut met = before.chain(after).filter(|end| (end.0 - point).norm() <= tolerance);
        if let (Some(&(_, j, true)), None) = (met.next(), met.next()) {
            next[i] = Some(j);
        }
    }
    next
}

/// The pieces in the order in which they follow each other, and whether the last leads back to the first.
pub(crate) fn chains(pieces: &[Piece], next: &[Option<usize>]) -> Vec<(Vec<usize>, bool)> {
    let mut has_before = vec![false; pieces.len()];
    next.iter().flatten().for_each(|&j| has_before[j] = true);
    let mut done = vec![false; pieces.len()];
    let mut chains = Vec::new();
    // Open chains first: they must be entered at their start; what is left then is closed.
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
    // Below this sum of two unit normals the corner is a cusp whose mean normal says nothing.
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
            let inside = parts.iter().filter(|p| frame.place(p.point(0.5), 4e-9) == Place::In).count();
            assert_eq!(inside, 1, "{k} {parts:?}");
        }
    }
}
