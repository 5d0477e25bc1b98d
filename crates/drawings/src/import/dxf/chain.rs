//! Lines and arcs joined at their ends into closed rings.
//!
//! Ends within a gap coincide. Duplicate pieces count once. Chains with a dead end are open. Where more than two pieces meet, they are followed in file order.

use std::collections::BTreeMap;

use crate::import::contour::Piece;
use crate::import::nodes::Nodes;
use meniscus_core::math::Vec2;

/// Result of joining.
#[derive(Debug, Default)]
pub(crate) struct Chains {
    /// Rings, each by its pieces in order and in the same direction, with the index of its first piece.
    pub(crate) rings: Vec<(usize, Vec<Piece>)>,
    /// Pieces that belong to no ring.
    pub(crate) open: usize,
    /// Their free ends, each with the index of its piece.
    pub(crate) free: Vec<(Vec2, usize)>,
    /// Number of duplicate pieces.
    pub(crate) doubled: usize,
    /// Number of points where more than two pieces meet.
    pub(crate) branches: usize,
}

/// The chains of pieces; ends within `gap` are joined.
pub(crate) fn chains(pieces: &[Piece], gap: f64) -> Chains {
    let mut chains = Chains::default();
    let mut nodes = Nodes::new(gap);
    let mut middles = Nodes::new(gap);
    let mut known = BTreeMap::new();
    // The ends of each piece that is used.
    let mut ends: Vec<Option<[usize; 2]>> = Vec::with_capacity(pieces.len());
    for piece in pieces {
        let [a, b] = piece.ends().map(|end| nodes.number(end));
        let is_new = known.insert([a.min(b), a.max(b), middles.number(piece.middle())], ()).is_none();
        chains.doubled += usize::from(!is_new);
        chains.open += usize::from(is_new && a == b);
        ends.push((is_new && a != b).then_some([a, b]));
    }
    let mut at_node: Vec<Vec<usize>> = vec![Vec::new(); nodes.points.len()];
    for (piece, [a, b]) in ends.iter().enumerate().filter_map(|(piece, ends)| Some((piece, (*ends)?))) {
        at_node[a].push(piece);
        at_node[b].push(piece);
    }
    let is_free = |node: usize| at_node[node].len() == 1;
    let both = ends.iter().enumerate().filter_map(|(piece, ends)| Some((piece, (*ends)?)));
    let free = both.flat_map(|(piece, ends)| ends.map(|node| (node, piece))).filter(|(node, _)| is_free(*node));
    chains.free = free.map(|(node, piece)| (nodes.points[node], piece)).collect();
    chains.open += prune(&mut ends, &at_node);
    chains.branches =
        at_node.iter().filter(|here| here.iter().filter(|&&piece| ends[piece].is_some()).count() > 2).count();
    let mut cursor = vec![0; at_node.len()];
    for first in 0..pieces.len() {
        let Some([start, mut at]) = ends[first].take() else { continue };
        let mut ring = vec![pieces[first].clone()];
        while at != start {
            // Pieces before the cursor are already used.
            while at_node[at].get(cursor[at]).is_some_and(|&piece| ends[piece].is_none()) {
                cursor[at] += 1;
            }
            let Some(&piece) = at_node[at].get(cursor[at]) else { break };
            let Some([a, b]) = ends[piece].take() else { break };
            ring.push(if a == at { pieces[piece].clone() } else { pieces[piece].reversed() });
            at = if a == at { b } else { a };
        }
        if at == start {
            chains.rings.push((first, ring));
        } else {
            chains.open += ring.len();
        }
    }
    chains
}

/// Removes pieces with a free end until there are none; returns their number.
fn prune(ends: &mut [Option<[usize; 2]>], at_node: &[Vec<usize>]) -> usize {
    let mut degree: Vec<usize> = at_node.iter().map(Vec::len).collect();
    let mut free: Vec<usize> = (0..degree.len()).filter(|&node| degree[node] == 1).collect();
    let mut number = 0;
    while let Some(node) = free.pop() {
        for &piece in &at_node[node] {
            let Some([a, b]) = ends[piece].take_if(|_| degree[node] == 1) else { continue };
            number += 1;
            for end in [a, b] {
                degree[end] -= 1;
                if degree[end] == 1 {
                    free.push(end);
                }
            }
        }
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(a: [f64; 2], b: [f64; 2]) -> Piece {
        Piece::Line([a.into(), b.into()])
    }

    #[test]
    fn lines_in_any_order_and_direction_close_to_a_ring_and_the_rest_is_counted() {
        let pieces = [
            line([0.0, 0.0], [1.0, 0.0]),
            line([1.0, 1.0], [1.0, 1e-9]),
            line([1.0, 1.0], [0.0, 1.0]),
            line([0.0, 0.0], [0.0, 1.0]),
            // The same piece twice, reversed; a tail of two; a distant one.
            line([1.0, 0.0], [0.0, 0.0]),
            line([1.0, 1.0], [2.0, 2.0]),
            line([2.0, 2.0], [3.0, 2.0]),
            line([8.0, 8.0], [9.0, 8.0]),
        ];
        let chains = chains(&pieces, 1e-6);
        assert_eq!((chains.rings.len(), chains.open, chains.doubled, chains.branches), (1, 3, 1, 0));
        let (first, ring) = &chains.rings[0];
        assert_eq!((*first, ring.len()), (0, 4));
        for (piece, next) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            assert!((piece.ends()[1] - next.ends()[0]).norm() < 1e-6);
        }
    }

    #[test]
    fn rings_that_touch_in_a_point_stay_two_and_are_told() {
        let triangle = |s: f64| [line([0.0, 0.0], [s, 0.0]), line([s, 0.0], [s, s]), line([s, s], [0.0, 0.0])];
        let chains = chains(&[triangle(1.0), triangle(-1.0)].concat(), 1e-6);
        assert_eq!((chains.rings.len(), chains.open, chains.branches), (2, 0, 1));
    }

    #[test]
    fn a_long_tail_is_pruned_without_recursion() {
        let pieces: Vec<Piece> = (0..10_000).map(|i| line([f64::from(i), 0.0], [f64::from(i + 1), 0.0])).collect();
        let chains = chains(&pieces, 1e-6);
        assert_eq!((chains.rings.len(), chains.open), (0, 10_000));
    }
}
