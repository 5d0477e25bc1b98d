//! Hydraulic conductance of throats and openings: the flow per depth is g Δp/μ, g in m².
//!
//! 1/g is the resistance between two pore centers, by lubrication along arcs that meet both walls at right angles (`channel.rs`), for round
//! or straight walls and corners of any curvature. There are no fitted parameters.
//!
//! Left out: turning and junction of flows in pores.

use crate::channel::{Channel, Wall};
use crate::graph::{Edge, Network, Region, WallPiece};
use meniscus_core::math::{Vec2, perpendicular};
use rayon::prelude::*;

/// Least distance of a pore center from a chord, in widths, so that conductances are finite.
const SHORTEST: f64 = 1e-6;

/// Least resistance of a throat, times its squared width.
pub(super) const LEAST_RESISTANCE: f64 = 12.0 * SHORTEST;

/// The conductances of all throats in m².
pub fn conductances(network: &Network) -> Vec<f64> {
    let of = |(throat, halves): (usize, [f64; 2])| finite(halves[0] + halves[1], network.throats[throat].width);
    resistances(network).into_iter().enumerate().map(of).collect()
}

/// The resistances of all throats in 1/m², from the chord to the center of the first and of the second region.
pub fn resistances(network: &Network) -> Vec<[f64; 2]> {
    let of = |region, index, edge: &Edge| match *edge {
        Edge::Throat { throat, end, from, to } => {
            Some((throat, end.min(1), resistance(network, region, index, [from, to])))
        }
        _ => None,
    };
    let mut resistances = vec![[0.0; 2]; network.throats.len()];
    for (throat, end, resistance) in of_edges(network, of) {
        if let Some(halves) = resistances.get_mut(throat) {
            halves[end] += resistance;
        }
    }
    resistances
}

/// The conductances of all openings in m², from the side to the center of the region behind it.
pub(crate) fn opening_conductances(network: &Network) -> Vec<f64> {
    opening_resistances(network).into_iter().map(|resistance| 1.0 / resistance).collect()
}

/// The resistances of all openings in 1/m², from the side to the center of the region behind it.
pub(crate) fn opening_resistances(network: &Network) -> Vec<f64> {
    let of = |region, index, edge: &Edge| match *edge {
        Edge::Opening { opening, from, to } => {
            Some((opening, 1.0 / finite(resistance(network, region, index, [from, to]), (to - from).norm())))
        }
        _ => None,
    };
    let mut found = vec![f64::INFINITY; network.openings.len()];
    for (opening, resistance) in of_edges(network, of) {
        if let Some(found) = found.get_mut(opening) {
            *found = resistance;
        }
    }
    found
}

/// What `of` finds at the edges of all regions, in order, given the region, the number of the edge in it, and the edge.
fn of_edges<T: Send>(network: &Network, of: impl Fn(usize, usize, &Edge) -> Option<T> + Sync) -> Vec<T> {
    let of = &of;
    let of_region = |(region, it): (usize, &Region)| {
        it.edges.iter().enumerate().filter_map(move |(index, edge)| of(region, index, edge)).collect::<Vec<_>>()
    };
    network.regions.par_iter().enumerate().flat_map_iter(of_region).collect()
}

fn finite(resistance: f64, width: f64) -> f64 {
    1.0 / resistance.max(LEAST_RESISTANCE / (width * width))
}

/// The resistance in 1/m² from an edge of a region without a wall to the center of the region.
fn resistance(network: &Network, region: usize, index: usize, [from, to]: [Vec2; 2]) -> f64 {
    let region = &network.regions[region];
    let Some(across) = (to - from).try_normalize(0.0) else { return 0.0 };
    // The pore lies on the right of the loop.
    let along = -perpendicular(across);
    let chain = Chain::around(&region.edges, index);
    let backwards = |piece: WallPiece| WallPiece { curve: piece.curve.reversed(), ..piece };
    let behind: Vec<WallPiece> = chain.wall_behind(index).into_iter().rev().map(backwards).collect();
    let walls = [Wall::new(&behind, -1.0, from, along), Wall::new(&chain.wall_ahead(index), 1.0, to, along)];
    Channel { walls, along, depth: network.depth }.resistance(chain.image_near(region.center, 0.5 * (from + to)))
}

/// The edges of a region that continue each other. Around a periodic domain they run through a whole period, and a side that is open over it is a chain of its
/// own; around grains in a pore that is open on all sides they close.
struct Chain<'a> {
    edges: &'a [Edge],
    first: usize,
    last: usize,
    /// Whether the first edge follows the last one although it is not the next one of the region.
    closes: bool,
    /// From the start of the first to the end of the last: a period of the domain, or zero.
    period: Vec2,
}

fn ends(edge: &Edge) -> Option<[Vec2; 2]> {
    match edge {
        Edge::Wall(pieces) => Some([pieces.first()?.curve.point(0.0), pieces.last()?.curve.point(1.0)]),
        Edge::Throat { from, to, .. } | Edge::Opening { from, to, .. } => Some([*from, *to]),
    }
}

impl<'a> Chain<'a> {
    /// The chain of an edge that is not an empty wall.
    fn around(edges: &'a [Edge], index: usize) -> Self {
        const ROUNDING: f64 = 1e-6;
        let count = edges.len();
        let points: Vec<Option<[Vec2; 2]>> = edges.iter().map(ends).collect();
        let origin = points[index].map_or_else(Vec2::zeros, |[from, _]| from);
        let size = points.iter().flatten().map(|[from, _]| (from - origin).norm()).fold(0.0, f64::max);
        // The next edge that continues this one, or is continued by it, if it is not the edge itself.
        let joined = |at: usize, step: usize| {
            let other = (1..count).map(|k| (at + k * step) % count).find(|&k| points[k].is_some())?;
            let (before, after) = if step == 1 { (at, other) } else { (other, at) };
            let gap = points[after]?[0] - points[before]?[1];
            (gap.norm() <= ROUNDING * size).then_some(other)
        };
        let end = |step: usize| {
            let mut at = index;
            while let Some(next) = joined(at, step).filter(|&next| next != index) {
                at = next;
            }
            at
        };
        let (first, last) = (end(count - 1), end(1));
        let closes = joined(last, 1).is_none();
        let period = points[last].zip(points[first]).map(|(last, first)| last[1] - first[0]);
        let period = period.filter(|period| closes && period.norm() > ROUNDING * size).unwrap_or_default();
        Self { edges, first, last, closes, period }
    }

    /// The wall after an edge; after the last one, the first of the next period.
    fn wall_ahead(&self, index: usize) -> Vec<WallPiece> {
        if index == self.last && self.closes {
            return self.wall(self.first, self.period);
        }
        self.wall((index + 1) % self.edges.len(), Vec2::zeros())
    }

    /// The wall before an edge; before the first one, the last of the previous period.
    fn wall_behind(&self, index: usize) -> Vec<WallPiece> {
        if index == self.first && self.closes {
            return self.wall(self.last, -self.period);
        }
        self.wall((index + self.edges.len() - 1) % self.edges.len(), Vec2::zeros())
    }

    fn wall(&self, index: usize, shift: Vec2) -> Vec<WallPiece> {
        match &self.edges[index] {
            Edge::Wall(pieces) => pieces.iter().map(|piece| piece.shifted(shift)).collect(),
            Edge::Throat { .. } | Edge::Opening { .. } => Vec::new(),
        }
    }

    /// The image of a point of the region that is nearest to `x`.
    fn image_near(&self, point: Vec2, x: Vec2) -> Vec2 {
        if self.period == Vec2::zeros() {
            return point;
        }
        point + self.period * ((x - point).dot(&self.period) / self.period.norm_squared()).round()
    }
}
