//! All walls of the pore space as chains of pieces, cut at menisci: the parts of them in contact with the invading phase.
//!
//! Along a wall with the pore on its right, the invading phase lies before the left end of a meniscus and the defending phase after it; at
//! a right end the order is reversed. So left and right ends alternate along each chain, unless arcs cross.

use super::mesh::Mesh;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::boundary::{Boundary, Piece};
use meniscus_geometry::curve::Curve;

/// Largest distance of a contact from its wall, over the longer side of the domain.
const ON_WALL: f64 = 1e-8;

/// A part of a piece of wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Side {
    /// The piece.
    pub(crate) piece: usize,
    /// Parameter of its start.
    pub(crate) from: f64,
    /// Parameter of its end.
    pub(crate) to: f64,
}

/// The walls in chains.
pub(super) struct WallChains {
    /// The pieces in m, pore on the right, each in the frame of its element.
    pub(crate) curves: Vec<Curve>,
    /// Whether the element of a piece holds the invading phase.
    is_invaded: Vec<bool>,
    /// The chains, and whether the last piece leads back to the first.
    chains: Vec<(Vec<usize>, bool)>,
    /// For each piece its chain and its index in it.
    indices: Vec<(usize, usize)>,
    /// The pieces moved into the domain, for searching.
    boundary: Boundary,
    bounds: Bounds,
    periodic: [bool; 2],
}

/// The walls in contact with the invading phase.
pub(super) struct Traced {
    /// Parts of walls.
    pub(crate) sides: Vec<Side>,
    /// Indices of menisci whose ends do not alternate.
    pub(crate) crossed: Vec<usize>,
}

/// An end of a meniscus on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Contact {
    chain: usize,
    index: usize,
    pub u: f64,
    is_left: bool,
    meniscus: usize,
    advance: f64,
}

impl WallChains {
    /// The walls of all elements; `is_invaded` is given for each loop.
    pub(crate) fn new(mesh: &Mesh, is_invaded: &[bool], bounds: Bounds, periodic: [bool; 2]) -> Self {
        let mut first = Vec::new();
        let (mut curves, mut tags) = (Vec::new(), Vec::new());
        for (part, invaded) in mesh.loops.iter().zip(is_invaded) {
            let mut of_walls = Vec::new();
            for wall in &part.walls {
                of_walls.push(curves.len());
                curves.extend(wall.iter().map(|piece| piece.curve));
                tags.resize(curves.len(), *invaded);
            }
            first.push(of_walls);
        }
        let mut next = vec![None; curves.len()];
        for (index, part) in mesh.loops.iter().enumerate() {
            for (wall, pieces) in part.walls.iter().enumerate().filter(|(_, pieces)| !pieces.is_empty()) {
                let from = first[index][wall];
                (0..pieces.len() - 1).for_each(|k| next[from + k] = Some(from + k + 1));
                let follower = following(mesh, index, wall);
                next[from + pieces.len() - 1] = follower.map(|(index, wall)| first[index][wall]);
            }
        }
        let chains = chains(&next);
        let mut indices = vec![(0, 0); curves.len()];
        for (chain, (pieces, _)) in chains.iter().enumerate() {
            pieces.iter().enumerate().for_each(|(index, &piece)| indices[piece] = (chain, index));
        }
        let moved = |curve: &Curve| {
            let middle = curve.point(0.5);
            Piece { curve: curve.shifted(wrapped(middle, bounds, periodic) - middle), shape: 0 }
        };
        let boundary = Boundary::of_pieces(curves.iter().map(moved).collect());
        Self { curves, is_invaded: tags, chains, indices, boundary, bounds, periodic }
    }

    /// Cuts the walls at the left and right ends of menisci, each with its length of wall from its gate.
    pub(crate) fn traced(&self, ends: &[[(Vec2, f64); 2]]) -> Traced {
        let mut crossed = Vec::new();
        let mut contacts: Vec<Vec<Contact>> = vec![Vec::new(); self.chains.len()];
        for (meniscus, both) in ends.iter().enumerate() {
            for (&(point, advance), is_left) in both.iter().zip([true, false]) {
                match self.locate(point) {
                    Some((piece, u)) => {
                        let (chain, index) = self.indices[piece];
                        contacts[chain].push(Contact { chain, index, u, is_left, meniscus, advance });
                    }
                    None => crossed.push(meniscus),
                }
            }
        }
        let mut sides = Vec::new();
        for (chain, contacts) in contacts.iter_mut().enumerate() {
            self.order(contacts);
            let disordered = self.out_of_order(chain, contacts);
            if !disordered.is_empty() {
                crossed.extend(disordered);
                continue;
            }
            let wet = self.wet(chain, contacts);
            // For valid menisci the phase differs from that of the elements only between gates and contacts.
            let allowed: f64 = contacts.iter().map(|contact| contact.advance.abs()).sum();
            let slack = ON_WALL * self.bounds.size().max() * (1 + contacts.len()) as f64;
            if !contacts.is_empty() && self.flipped(chain, &wet) > allowed + slack {
                crossed.extend(contacts.iter().map(|contact| contact.meniscus));
            }
            sides.extend(wet);
        }
        crossed.sort_unstable();
        crossed.dedup();
        Traced { sides, crossed }
    }

    /// The piece on which a point lies, and its parameter there.
    fn locate(&self, x: Vec2) -> Option<(usize, f64)> {
        let (x, size) = (wrapped(x, self.bounds, self.periodic), self.bounds.size());
        let shifts = |axis: usize| if self.periodic[axis] { &[0.0, -1.0, 1.0][..] } else { &[0.0][..] };
        let mut best: Option<(f64, usize, f64)> = None;
        for (i, j) in shifts(0).iter().flat_map(|&i| shifts(1).iter().map(move |&j| (i, j))) {
            let x = x + Vec2::new(i * size.x, j * size.y);
            let Some(nearest) = self.boundary.nearest(x) else { continue };
            let distance = (nearest.closest.point - x).norm();
            if best.is_none_or(|(least, ..)| distance < least) {
                best = Some((distance, nearest.piece, nearest.closest.u));
            }
        }
        best.filter(|(distance, ..)| *distance <= ON_WALL * size.max()).map(|(_, piece, u)| (piece, u))
    }

    /// Sorts contacts along their chain, coincident ones so that left and right ends alternate.
    fn order(&self, contacts: &mut [Contact]) {
        contacts.sort_by(|a, b| a.index.cmp(&b.index).then(a.u.total_cmp(&b.u)).then(a.meniscus.cmp(&b.meniscus)));
        let point = |contact: &Contact| self.curves[self.chains[contact.chain].0[contact.index]].point(contact.u);
        let same = ON_WALL * self.bounds.size().max();
        for k in 1..contacts.len().saturating_sub(1) {
            let is_tie = (point(&contacts[k]) - point(&contacts[k + 1])).norm() <= same;
            if contacts[k].is_left == contacts[k - 1].is_left && is_tie {
                contacts.swap(k, k + 1);
            }
        }
    }

    /// The menisci of contacts that follow a contact of the same end.
    fn out_of_order(&self, chain: usize, contacts: &[Contact]) -> Vec<usize> {
        let is_closed = self.chains[chain].1;
        let pairs =
            (0..contacts.len()).map(|k| (k, (k + 1) % contacts.len())).filter(|(k, next)| next > k || is_closed);
        let same = pairs.filter(|&(k, next)| contacts[k].is_left == contacts[next].is_left);
        same.flat_map(|(k, next)| [contacts[k].meniscus, contacts[next].meniscus]).collect()
    }

    /// The parts of a chain in contact with the invading phase.
    fn wet(&self, chain: usize, contacts: &[Contact]) -> Vec<Side> {
        let (pieces, is_closed) = &self.chains[chain];
        let end = (pieces.len() - 1, 1.0);
        if contacts.is_empty() {
            // A grain between merged menisci is surrounded by the invading phase.
            let is_wet = pieces.iter().any(|&piece| self.is_invaded[piece]);
            return if is_wet { self.between(chain, (0, 0.0), end) } else { Vec::new() };
        }
        let mut sides = Vec::new();
        let mut from = None;
        for contact in contacts {
            let here = (contact.index, contact.u);
            if contact.is_left {
                sides.extend(self.between(chain, from.take().unwrap_or((0, 0.0)), here));
            } else {
                from = Some(here);
            }
        }
        sides.extend(from.into_iter().flat_map(|from| self.between(chain, from, end)));
        // A closed chain that starts within the invading phase had its start included with the first left end; otherwise it ends outside.
        debug_assert!(!is_closed || contacts.len().is_multiple_of(2));
        sides
    }

    /// The pieces of a chain between two positions on it.
    fn between(&self, chain: usize, (i, u): (usize, f64), (j, v): (usize, f64)) -> Vec<Side> {
        let ends = |index: usize| (if index == i { u } else { 0.0 }, if index == j { v } else { 1.0 });
        let side = |index: usize| {
            let (from, to) = ends(index);
            Side { piece: self.chains[chain].0[index], from, to }
        };
        (i..=j).map(side).filter(|side| side.to > side.from).collect()
    }

    /// Length of a chain in m on which the phase differs from that of the elements.
    fn flipped(&self, chain: usize, wet: &[Side]) -> f64 {
        let pieces = &self.chains[chain].0;
        let invaded = pieces.iter().filter(|&&piece| self.is_invaded[piece]).map(|&piece| self.curves[piece].length());
        let length = |side: &Side| (side.to - side.from) * self.curves[side.piece].length();
        let both: f64 = wet.iter().filter(|side| self.is_invaded[side.piece]).map(length).sum();
        invaded.sum::<f64>() + wet.iter().map(length).sum::<f64>() - 2.0 * both
    }
}

/// The stretch of wall that follows one, across the crossing between them; `None` at an opening.
fn following(mesh: &Mesh, mut index: usize, mut wall: usize) -> Option<(usize, usize)> {
    // Stretches between crossings that share a point are empty.
    for _ in 0..=mesh.loops.len() {
        if mesh.loops[index].crossings.is_empty() {
            return Some((index, wall));
        }
        let (beyond, twin, _) = mesh.twin(index, wall)?;
        (index, wall) = (beyond, (twin + 1) % mesh.loops[beyond].walls.len());
        if !mesh.loops[index].walls[wall].is_empty() {
            return Some((index, wall));
        }
    }
    None
}

/// The pieces in order, and whether the last leads back to the first.
fn chains(next: &[Option<usize>]) -> Vec<(Vec<usize>, bool)> {
    let mut has_before = vec![false; next.len()];
    next.iter().flatten().for_each(|&piece| has_before[piece] = true);
    let mut is_done = vec![false; next.len()];
    let mut chains = Vec::new();
    let open: Vec<usize> = (0..next.len()).filter(|&piece| !has_before[piece]).collect();
    for first in open.into_iter().chain(0..next.len()) {
        let (mut chain, mut at) = (Vec::new(), Some(first));
        while let Some(piece) = at.filter(|&piece| !is_done[piece]) {
            is_done[piece] = true;
            chain.push(piece);
            at = next[piece];
        }
        if !chain.is_empty() {
            chains.push((chain, at == Some(first)));
        }
    }
    chains
}

/// `x` (m) moved into the domain by whole periods.
fn wrapped(x: Vec2, bounds: Bounds, periodic: [bool; 2]) -> Vec2 {
    let (mut y, size) = (x, bounds.size());
    for axis in (0..2).filter(|&axis| periodic[axis]) {
        y[axis] -= size[axis] * ((x[axis] - bounds.min[axis]) / size[axis]).floor();
    }
    y
}
