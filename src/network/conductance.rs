//! Hydraulic conductance of throats and openings: the flow per depth is g Δp/μ, g in m².
//!
//! 1/g is the resistance between two pore centers, by lubrication along arcs that meet both walls at right angles (`channel.rs`), for round
//! or straight walls and corners of any curvature. There are no fitted parameters.
//!
//! Left out: turning and junction of flows in pores.

use crate::math::{Vec2, perpendicular};
use crate::network::channel::{Channel, Wall};
use crate::network::graph::{Edge, Network, Region, WallPiece};

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
pub(crate) fn resistances(network: &Network) -> Vec<[f64; 2]> {
    let mut resistances = vec![[0.0; 2]; network.throats.len()];
    each_edge(network, |region, index, edge| {
        if let Edge::Throat { throat, end, from, to } = *edge
            && let Some(halves) = resistances.get_mut(throat)
        {
            halves[end.min(1)] += resistance(network, region, index, [from, to]);
        }
    });
    resistances
}

/// The conductances of all openings in m², from the side to the center of the region behind it.
pub(crate) fn opening_conductances(network: &Network) -> Vec<f64> {
    opening_resistances(network).into_iter().map(|resistance| 1.0 / resistance).collect()
}

/// The resistances of all openings in 1/m², from the side to the center of the region behind it.
pub(crate) fn opening_resistances(network: &Network) -> Vec<f64> {
    let mut found = vec![f64::INFINITY; network.openings.len()];
    each_edge(network, |region, index, edge| {
        if let Edge::Opening { opening, from, to } = *edge
            && let Some(found) = found.get_mut(opening)
        {
            *found = 1.0 / finite(resistance(network, region, index, [from, to]), (to - from).norm());
        }
    });
    found
}

fn each_edge(network: &Network, mut f: impl FnMut(usize, usize, &Edge)) {
    for (region, edges) in network.regions.iter().map(|region| &region.edges).enumerate() {
        for (index, edge) in edges.iter().enumerate() {
            f(region, index, edge);
        }
    }
}

fn finite(resistance: f64, width: f64) -> f64 {
    1.0 / resistance.max(LEAST_RESISTANCE / (width * width))
}

/// The resistance in 1/m² from an edge of a region without a wall to the center of the region.
fn resistance(network: &Network, region: usize, index: usize, [from, to]: [Vec2; 2]) -> f64 {
    let region = &network.regions[region];
    let count = region.edges.len();
    let Some(across) = (to - from).try_normalize(0.0) else { return 0.0 };
    // The pore lies on the right of the loop.
    let along = -perpendicular(across);
    let wall = |edge: &Edge| match edge {
        Edge::Wall(pieces) => pieces.clone(),
        Edge::Throat { .. } | Edge::Opening { .. } => Vec::new(),
    };
    let ahead = wall(&region.edges[(index + 1) % count]);
    let backwards = |piece: &WallPiece| WallPiece { curve: piece.curve.reversed(), ..*piece };
    let behind: Vec<WallPiece> = wall(&region.edges[(index + count - 1) % count]).iter().rev().map(backwards).collect();
    let walls = [Wall::new(&behind, -1.0, from, along), Wall::new(&ahead, 1.0, to, along)];
    Channel { walls, along, depth: network.depth }.resistance(image_near(region, 0.5 * (from + to)))
}

/// The image of the center of a region that is nearest to `x`. A region around a periodic domain has one in each period, wherever its boundary begins.
fn image_near(region: &Region, x: Vec2) -> Vec2 {
    let period = seam(&region.edges).unwrap_or_default();
    let images = [0.0, 1.0, -1.0].map(|shift| region.center + period * shift);
    images.into_iter().min_by(|a, b| (a - x).norm().total_cmp(&(b - x).norm())).unwrap_or(region.center)
}

/// The period between the end of the boundary of a region and its start, or between two of its edges.
fn seam(edges: &[Edge]) -> Option<Vec2> {
    const ROUNDING: f64 = 1e-6;
    let ends = |edge: &Edge| match edge {
        Edge::Wall(pieces) => Some([pieces.first()?.curve.point(0.0), pieces.last()?.curve.point(1.0)]),
        Edge::Throat { from, to, .. } | Edge::Opening { from, to, .. } => Some([*from, *to]),
    };
    let ends: Vec<[Vec2; 2]> = edges.iter().filter_map(ends).collect();
    let gaps = (0..ends.len()).map(|k| ends[(k + 1) % ends.len()][0] - ends[k][1]);
    let longest = gaps.max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
    let size = ends.iter().map(|[from, _]| (from - ends[0][0]).norm()).fold(0.0, f64::max);
    (longest.norm() > ROUNDING * size).then_some(longest)
}
