//! Shapes, geometries and tables of networks for these tests.

use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{CurvedPolygon, Disc, GeometrySpec, Polygon, Rectangle, ShapeSpec, SolidSide};
use meniscus_network::extract;
use meniscus_network::graph::Network;

pub const CLOSED: [bool; 4] = [false; 4];
pub const LEFT_RIGHT: [bool; 4] = [true, true, false, false];
pub const TOP_BOTTOM: [bool; 4] = [false, false, true, true];

/// Grains in a domain that begins at the origin; its sides are neither walls nor periodic.
pub fn grains(size: [f64; 2], shapes: Vec<ShapeSpec>) -> Geometry {
    Geometry::new(&GeometrySpec { min: [0.0; 2], max: size, solid: SolidSide::Inside, shapes }).unwrap()
}

/// Pores in a solid domain that begins at the origin.
pub fn pores(size: [f64; 2], shapes: Vec<ShapeSpec>) -> Geometry {
    Geometry::new(&GeometrySpec { min: [0.0; 2], max: size, solid: SolidSide::Outside, shapes }).unwrap()
}

pub fn disc(x: f64, y: f64, radius: f64) -> ShapeSpec {
    ShapeSpec::Disc(Disc { center: [x, y], radius })
}

pub fn rectangle(center: [f64; 2], size: [f64; 2]) -> ShapeSpec {
    ShapeSpec::Rectangle(Rectangle { center, size, rotation_deg: 0.0 })
}

pub fn polygon(outer: Vec<[f64; 2]>) -> ShapeSpec {
    ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 })
}

/// A polygon with bulges.
pub fn curved(outer: Vec<[f64; 3]>) -> ShapeSpec {
    ShapeSpec::CurvedPolygon(CurvedPolygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 })
}

/// The network of a geometry whose sides are open where the table says so; all invariants are asserted.
pub fn network(geometry: &Geometry, open: [bool; 4]) -> Network {
    let network = extract(geometry, open).unwrap();
    crate::invariants::assert_all(geometry, &network);
    network
}

/// Inscribed radii, the smallest first.
pub fn radii(network: &Network) -> Vec<f64> {
    sorted(network.regions.iter().map(|region| region.radius))
}

/// Areas of regions, the smallest first.
pub fn areas(network: &Network) -> Vec<f64> {
    sorted(network.regions.iter().map(|region| region.area))
}

/// Widths of throats, the smallest first.
pub fn widths(network: &Network) -> Vec<f64> {
    sorted(network.throats.iter().map(|throat| throat.width))
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Asserts that a list holds the expected values, up to rounding.
#[track_caller]
pub fn assert_values(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-9 * b.abs(), "{found:?} {expected:?}");
    }
}
