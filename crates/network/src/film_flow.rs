//! Flow of the wetting phase along the corner films of a chip, for relative permeabilities.
//!
//! In a region that the non-wetting phase fills, the films along each stretch of wall between two chords are a node; half of the resistance of a stretch lies
//! on either side of it. Films continue along their wall past a chord, and open into the wetting phase that fills the region there, and into open sides.

use super::films::FilmTerms;
use super::graph::{Edge, Network, Region, WallPiece};
use super::laplacian::{Conductor, Edge as Between};
use super::permeability::{Beside, Drive};
use meniscus_core::math::Bounds;
use meniscus_geometry::interface::film_flow::conductance;

/// A node at a chord, and the resistance up to there in 1/m².
type At = Option<(usize, f64)>;

/// Flow along the films of walls with these angles in rad at unit radius, over the depth (m), times viscosity over pressure gradient.
pub(crate) fn of_walls(depth: f64, angles: &[f64], plates: [f64; 2]) -> Vec<f64> {
    let mut known: Vec<(f64, f64)> = Vec::new();
    let mut of = |wall: f64| {
        if let Some(&(_, found)) = known.iter().find(|(angle, _)| *angle == wall) {
            return found;
        }
        let found = plates.iter().map(|&plate| conductance(wall, plate)).sum::<f64>() / depth;
        known.push((wall, found));
        found
    };
    angles.iter().map(|&wall| of(wall)).collect()
}

/// Films as conductors.
#[derive(Default)]
pub(crate) struct FilmFlow(pub(crate) Beside);

impl FilmFlow {
    /// Whether no film conducts.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.conductors.is_empty()
    }

    /// The films at an applied (p_n - p_w)/σ of `curvature` (1/m) in all regions that the wetting phase does not hold.
    pub(crate) fn new(
        network: &Network,
        holds: &[bool],
        terms: &FilmTerms,
        curvature: f64,
        (domain, drive): (Bounds, Drive),
    ) -> Self {
        let mut found = Self::default();
        let first = network.regions.len();
        // By throat: at both ends of its chord, on both sides of it.
        let mut at_throats: Vec<[[At; 2]; 2]> = vec![Default::default(); network.throats.len()];
        for (index, region) in network.regions.iter().enumerate() {
            let radius = radius(region, terms, curvature);
            let edges = stretches(region);
            let halves: Vec<At> = edges
                .iter()
                .map(|(wall, _)| {
                    if holds[index] {
                        return Some((index, 0.0));
                    }
                    let resistance: f64 = wall
                        .iter()
                        .map(|piece| piece.curve.length() / (terms.conductances[piece.shape as usize] * radius.powi(4)))
                        .sum();
                    found.0.nodes += 1;
                    resistance.is_finite().then_some((first + found.0.nodes - 1, 0.5 * resistance))
                })
                .collect();
            for (k, (_, crossing)) in edges.iter().enumerate() {
                let beside = [halves[k], halves[(k + 1) % edges.len()]];
                match crossing {
                    Edge::Throat { throat, end, .. } => {
                        // The wall before the chord on one side is that after it on the other side.
                        at_throats[*throat][0][*end] = beside[*end];
                        at_throats[*throat][1][*end] = beside[1 - *end];
                    }
                    Edge::Opening { opening, .. } if !holds[index] => {
                        found.open(network.openings[*opening].side, beside, domain, drive);
                    }
                    _ => {}
                }
            }
        }
        let axis = match drive {
            Drive::Sides(axis) | Drive::Periodic(axis) => axis,
        };
        for (throat, ends) in network.throats.iter().zip(at_throats) {
            let jump = if matches!(drive, Drive::Periodic(_)) { -throat.shift[axis] } else { 0.0 };
            for [from, to] in ends {
                if let (Some((from, near)), Some((to, far))) = (from, to)
                    && near + far > 0.0
                {
                    let edge = Between { ends: (from, Some(to)), is_good: false };
                    found.0.conductors.push((edge, Conductor { conductance: 1.0 / (near + far), jump }));
                }
            }
        }
        found
    }

    /// Connects films to an open side.
    fn open(&mut self, side: usize, beside: [At; 2], domain: Bounds, drive: Drive) {
        let Drive::Sides(axis) = drive else { return };
        if side / 2 != axis {
            return;
        }
        let jump = if side == 2 * axis { -domain.size()[axis] } else { 0.0 };
        for (node, resistance) in beside.into_iter().flatten().filter(|(_, resistance)| *resistance > 0.0) {
            let edge = Between { ends: (node, None), is_good: false };
            self.0.conductors.push((edge, Conductor { conductance: 1.0 / resistance, jump }));
        }
    }
}

/// The radius of films in a region in m, at most that at which they meet on its walls or, on average, on its plates.
fn radius(region: &Region, terms: &FilmTerms, applied: f64) -> f64 {
    let pieces = region.edges.iter().flat_map(|edge| if let Edge::Wall(pieces) = edge { &pieces[..] } else { &[][..] });
    let (largest, curvature) = (terms.largest_radius(pieces, region.area), applied + terms.head(region.center));
    if curvature > 0.0 { (1.0 / curvature).min(largest) } else { largest }
}

/// The stretches of wall of a region, each with the chord or opening after it.
fn stretches(region: &Region) -> Vec<(Vec<WallPiece>, &Edge)> {
    let count = region.edges.len();
    let Some(last) = region.edges.iter().position(|edge| !matches!(edge, Edge::Wall(_))) else { return Vec::new() };
    let (mut found, mut wall) = (Vec::new(), Vec::new());
    for k in 1..=count {
        match &region.edges[(last + k) % count] {
            Edge::Wall(pieces) => wall.extend_from_slice(pieces),
            crossing => found.push((std::mem::take(&mut wall), crossing)),
        }
    }
    found
}
