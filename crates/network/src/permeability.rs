//! Permeability of a network: one pressure per region, flow g Δp/μ through each throat, sum of flows zero in every region.
//!
//! K in m² from the dissipation: Σ g Δp² = K G² A, with the mean pressure gradient G and the area A of the domain. The matrix is a graph
//! Laplacian, factored by Cholesky. Parts of the network that do not connect both sides carry no flow.
//! All regions count, whatever the persistence ratio of pores: a passage without a neck conducts well.

use crate::conductance::opening_conductances;
use crate::graph::Network;
use crate::laplacian::{Conductor, Edge, FlowError, Laplacian, parts};
use meniscus_core::math::{Bounds, root};

/// The drive of the flow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// From the openings of the low side (left or bottom) to those of the high side of an axis: 0 along x, 1 along y.
    Sides(usize),
    /// A mean gradient along an axis with periodic sides.
    Periodic(usize),
}

/// The part of a network accessible to a fluid.
#[derive(Debug, Clone, Copy)]
pub struct Paths<'a> {
    /// Conductance of each throat in m²; 0 where it is closed to the fluid.
    pub conductance: &'a [f64],
    /// Whether the fluid is in each region: openings of others are closed to it.
    pub holds: &'a [bool],
}

/// Conductors beside the throats, such as corner films; their nodes follow those of the regions.
#[derive(Debug, Clone, Default)]
pub(crate) struct Beside {
    /// Number of their nodes.
    pub(crate) nodes: usize,
    pub(crate) conductors: Vec<(Edge, Conductor)>,
}

/// Rounding error of the dissipation, over that of equal pressures in all regions: below it nothing flows.
const ROUNDING: f64 = 1e-24;

/// The permeability in m² of the domain of a network; 0 without a path through it.
pub fn permeability(network: &Network, paths: Paths, domain: Bounds, drive: Drive) -> Result<f64, FlowError> {
    with_films(network, paths, &Beside::default(), domain, drive)
}

/// The same of the wetting phase, which flows along films too.
pub(crate) fn with_films(
    network: &Network,
    paths: Paths,
    films: &Beside,
    domain: Bounds,
    drive: Drive,
) -> Result<f64, FlowError> {
    let (mut edges, mut conductors) = conductors(network, paths, domain, drive);
    edges.extend(films.conductors.iter().map(|(edge, _)| edge));
    conductors.extend(films.conductors.iter().map(|(_, conductor)| conductor));
    if matches!(drive, Drive::Sides(_)) && !leads_through(network.regions.len() + films.nodes, &edges, &conductors) {
        return Ok(0.0);
    }
    let flow = Laplacian::new(network.regions.len() + films.nodes, edges)?.solve(&conductors, &[])?;
    let dissipation: f64 = flow.through.iter().zip(&conductors).map(|(q, c)| q * q / c.conductance).sum();
    // The flow minimizes the dissipation among all pressures with this drive.
    let most: f64 = conductors.iter().map(|c| c.conductance * c.jump * c.jump).sum();
    Ok(if dissipation > ROUNDING * most { dissipation / domain.area() } else { 0.0 })
}

/// Whether conductors join given pressures that differ.
fn leads_through(nodes: usize, edges: &[Edge], conductors: &[Conductor]) -> bool {
    let mut parent = parts(nodes, edges.iter().map(|edge| edge.ends));
    let mut pressure_of = vec![None; nodes];
    edges.iter().zip(conductors).filter(|(edge, _)| edge.ends.1.is_none()).any(|(edge, conductor)| {
        *pressure_of[root(&mut parent, edge.ends.0)].get_or_insert(conductor.jump) != conductor.jump
    })
}

/// The conductors under a mean gradient of 1.
fn conductors(network: &Network, paths: Paths, domain: Bounds, drive: Drive) -> (Vec<Edge>, Vec<Conductor>) {
    let axis = match drive {
        Drive::Sides(axis) | Drive::Periodic(axis) => axis,
    };
    let most = paths.conductance.iter().filter(|&&conductance| conductance > 0.0).count() + network.openings.len();
    let (mut edges, mut conductors) = (Vec::with_capacity(most), Vec::with_capacity(most));
    for (throat, &conductance) in network.throats.iter().zip(paths.conductance) {
        let [from, to] = throat.regions;
        if conductance > 0.0 {
            // The pressure drops by the gradient times the period between periodic images.
            let jump = if matches!(drive, Drive::Periodic(_)) { -throat.shift[axis] } else { 0.0 };
            edges.push(Edge { ends: (from, Some(to)), is_good: false });
            conductors.push(Conductor { conductance, jump });
        }
    }
    if matches!(drive, Drive::Sides(_)) {
        for (opening, conductance) in network.openings.iter().zip(opening_conductances(network)) {
            let is_low = opening.side == 2 * axis;
            let is_held = paths.holds.get(opening.region).copied().unwrap_or(false);
            if !is_held || !(is_low || opening.side == 2 * axis + 1) {
                continue;
            }
            let pressure = if is_low { domain.size()[axis] } else { 0.0 };
            edges.push(Edge { ends: (opening.region, None), is_good: false });
            conductors.push(Conductor { conductance, jump: -pressure });
        }
    }
    (edges, conductors)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::conductance::conductances;
    use crate::extract::extract;
    use crate::graph::{Edge, Opening, Region, Throat, WallPiece};
    use meniscus_core::math::Vec2;
    use meniscus_geometry::Geometry;
    use meniscus_geometry::curve::Curve;
    use meniscus_geometry::spec::{Disc, GeometrySpec, ShapeSpec, SolidSide};

    fn wall(curve: Curve) -> Edge {
        Edge::Wall([WallPiece::part_of(&curve, curve, 0)].into())
    }

    fn region(center: Vec2, radius: f64, edges: Vec<Edge>) -> Region {
        Region { center, radius, edges, area: 1.0, wall_length: 1.0, centroid: center }
    }

    /// A square array of discs of period 1: one region, a throat to itself over each side.
    fn square_array(radius: f64) -> Network {
        let shapes = vec![ShapeSpec::Disc(Disc { center: [0.0; 2], radius })];
        let spec = GeometrySpec { min: [0.0; 2], max: [1.0; 2], solid: SolidSide::Inside, shapes };
        extract(&Geometry::new(&spec).unwrap().with_periodic([true, true]), [false; 4]).unwrap()
    }

    const UNIT: Bounds = Bounds { min: Vec2::new(0.0, 0.0), max: Vec2::new(1.0, 1.0) };

    #[test]
    fn square_arrays_have_the_permeability_of_exact_flow_within_two_percent() {
        // Drag of Sangani and Acrivos (1982); K = 1/F. Arcs miss a sixth of the effect of the slope of walls.
        for (solid, drag) in [(0.6, 1763.6), (0.5, 532.548), (0.4, 217.894), (0.3, 102.881), (0.2, 51.527)] {
            let network = square_array((solid / PI).sqrt());
            let values = conductances(&network);
            for axis in [0, 1] {
                let paths = Paths { conductance: &values, holds: &[true] };
                let k = permeability(&network, paths, UNIT, Drive::Periodic(axis)).unwrap();
                assert!((k * drag - 1.0).abs() < 0.02, "{solid}: {}", k * drag - 1.0);
            }
        }
    }

    /// A slit along x, divided into regions by throats at `cuts`.
    fn slit(length: f64, width: f64, cuts: &[f64]) -> Network {
        let v = Vec2::new;
        let mut stops = vec![0.0];
        stops.extend(cuts);
        stops.push(length);
        let last = stops.len() - 2;
        let regions = stops.windows(2).enumerate().map(|(i, pair)| {
            let (a, b) = (pair[0], pair[1]);
            let at = |x: f64, index: usize, up: bool, is_opening: bool, end: usize| {
                let (from, to) = if up { (v(x, 0.0), v(x, width)) } else { (v(x, width), v(x, 0.0)) };
                if is_opening {
                    Edge::Opening { opening: index, from, to }
                } else {
                    Edge::Throat { throat: index, end, from, to }
                }
            };
            let edges = vec![
                at(a, if i == 0 { 0 } else { i - 1 }, true, i == 0, 1),
                wall(Curve::Segment { a: v(a, width), b: v(b, width) }),
                at(b, if i == last { 1 } else { i }, false, i == last, 0),
                wall(Curve::Segment { a: v(b, 0.0), b: v(a, 0.0) }),
            ];
            region(v(0.5 * (a + b), 0.5 * width), 0.5 * width, edges)
        });
        let throats = cuts.iter().enumerate().map(|(i, &x)| Throat {
            width,
            contacts: [v(x, width), v(x, 0.0)],
            shapes: [0, 1],
            curvatures: [0.0; 2],
            regions: [i, i + 1],
            shift: Vec2::zeros(),
        });
        let opening = |side, x, region| Opening { side, ends: [v(x, 0.0), v(x, width)], region };
        Network {
            regions: regions.collect(),
            throats: throats.collect(),
            openings: vec![opening(0, 0.0, 0), opening(1, length, last)],
            depth: None,
        }
    }

    #[test]
    fn a_slit_has_a_twelfth_of_its_width_squared_however_it_is_cut() {
        let (length, width) = (3.0, 0.2);
        let domain = Bounds { min: Vec2::zeros(), max: Vec2::new(length, width) };
        for cuts in [vec![], vec![1.0], vec![0.5, 1.7, 2.9]] {
            let network = slit(length, width, &cuts);
            let values = conductances(&network);
            let holds = vec![true; network.regions.len()];
            let paths = Paths { conductance: &values, holds: &holds };
            let k = permeability(&network, paths, domain, Drive::Sides(0)).unwrap();
            assert!((k * 12.0 / (width * width) - 1.0).abs() < 1e-9, "{cuts:?}: {k}");
            // Nothing flows across, nor without an opening for the fluid.
            assert_eq!(permeability(&network, paths, domain, Drive::Sides(1)).unwrap(), 0.0);
            let mut dry = holds.clone();
            dry[0] = false;
            let k = permeability(&network, Paths { holds: &dry, ..paths }, domain, Drive::Sides(0)).unwrap();
            assert_eq!(k, 0.0);
        }
    }

    #[test]
    fn parts_without_a_way_through_carry_nothing() {
        let mut network = slit(2.0, 0.5, &[0.7, 1.2]);
        let holds = [true; 3];
        let domain = Bounds { min: Vec2::zeros(), max: Vec2::new(2.0, 0.5) };
        let of = |network: &Network, conductance: &[f64]| {
            permeability(network, Paths { conductance, holds: &holds }, domain, Drive::Sides(0)).unwrap()
        };
        assert!(of(&network, &[0.1, 0.2]) > 0.0);
        // A closed throat leaves one component on each side.
        assert_eq!(of(&network, &[0.1, 0.0]), 0.0);
        network.openings.clear();
        assert_eq!(of(&network, &[0.1, 0.2]), 0.0);
    }
}
