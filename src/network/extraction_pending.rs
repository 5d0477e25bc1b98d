//! Stands in for the extraction until it is there: Delaunay triangles of discs.
use super::graph::{Edge, Network, Opening, Pores, Region, Throat, WallPiece};
use crate::geometry::Geometry;
use crate::geometry::curve::Curve;
use crate::math::Vec2;

/// No network.
#[derive(Debug, thiserror::Error)]
#[error("the extraction is not there yet")]
pub struct ExtractError;

/// The network of a geometry.
///
/// # Errors
/// Always.
pub fn extract(geometry: &Geometry, open: [bool; 4]) -> Result<Network, ExtractError> {
    let mut discs: Vec<(Vec2, f64, u32)> = Vec::new();
    for piece in &geometry.boundary.pieces {
        if let Curve::Arc { center, radius, .. } = piece.curve
            && !discs.iter().rev().take(8).any(|d| d.0 == center)
        {
            discs.push((center, radius, piece.shape));
        }
    }
    let points: Vec<_> = discs.iter().map(|d| delaunator::Point { x: d.0.x, y: d.0.y }).collect();
    let t = delaunator::triangulate(&points);
    let mut network = Network::default();
    let bounds = geometry.bounds();
    for tri in 0..t.triangles.len() / 3 {
        let ids = [0, 1, 2].map(|k| t.triangles[3 * tri + k]);
        let mut edges = Vec::new();
        let mut area = 0.0;
        let c = (discs[ids[0]].0 + discs[ids[1]].0 + discs[ids[2]].0) / 3.0;
        for k in 0..3 {
            let (a, b, p) = (discs[ids[k]], discs[ids[(k + 1) % 3]], discs[ids[(k + 2) % 3]]);
            // at disc a: from direction of p to direction of b
            let from = (p.0 - a.0).normalize();
            let to = (b.0 - a.0).normalize();
            let start = from.y.atan2(from.x);
            let sweep = (from.x * to.y - from.y * to.x).atan2(from.dot(&to));
            let curve = Curve::Arc { center: a.0, radius: a.1, start, sweep };
            edges.push(Edge::Wall(vec![WallPiece { curve, whole: Curve::circle(a.0, a.1), shape: a.2 }]));
            area -= 0.5 * a.1 * a.1 * sweep.abs();
            let half = 3 * tri + k;
            let (f, g) = (a.0 + to * a.1, b.0 - to * b.1);
            let twin = t.halfedges[half];
            if twin == delaunator::EMPTY {
                let m = 0.5 * (f + g);
                let d = [m.x - bounds.min.x, bounds.max.x - m.x, m.y - bounds.min.y, bounds.max.y - m.y];
                let side = (0..4).min_by(|&i, &j| d[i].total_cmp(&d[j])).unwrap_or(0);
                if open[side] {
                    edges.push(Edge::Opening { opening: network.openings.len(), from: f, to: g });
                    network.openings.push(Opening { side, ends: [f, g], region: tri });
                }
            } else {
                let throat = network.throats.len();
                edges.push(Edge::Throat { throat, end: usize::from(twin < half), from: f, to: g });
                if half < twin {
                    network.throats.push(Throat {
                        width: (g - f).norm(),
                        contacts: [f, g],
                        shapes: [a.2, b.2],
                        curvatures: [1.0 / a.1, 1.0 / b.1],
                        regions: [tri, twin / 3],
                        shift: Vec2::zeros(),
                    });
                }
            }
        }
        let e1 = discs[ids[1]].0 - discs[ids[0]].0;
        let e2 = discs[ids[2]].0 - discs[ids[0]].0;
        area += 0.5 * (e1.x * e2.y - e1.y * e2.x).abs();
        let radius = ids.iter().map(|&i| (discs[i].0 - c).norm() - discs[i].1).fold(f64::INFINITY, f64::min);
        network.regions.push(Region { center: c, radius, edges, area, wall_length: 0.0, centroid: c });
    }
    Ok(network)
}

impl Pores {
    /// Regions as pores.
    #[must_use]
    pub fn merged(network: &Network, persistence: f64) -> Self {
        let count = network.regions.len();
        Self {
            persistence,
            pore_of: (0..count).collect(),
            main_region: (0..count).collect(),
            area: network.regions.iter().map(|region| region.area).collect(),
            throats: (0..network.throats.len()).collect(),
        }
    }
}
