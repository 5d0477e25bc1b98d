//! What holds for every network: areas, widths, closed boundaries, the number of throats.

use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_network::graph::{Edge, Network};

/// Asserts all that must hold whatever the shapes are.
#[track_caller]
pub fn assert_all(geometry: &Geometry, network: &Network) {
    let violations = violations(geometry, network);
    assert!(violations.is_empty(), "{violations:#?}");
}

/// What does not hold.
pub fn violations(geometry: &Geometry, network: &Network) -> Vec<String> {
    let mut found = Vec::new();
    let domain = geometry.bounds();
    let pore_area = geometry.porosity().value * domain.area();
    let sum: f64 = network.regions.iter().map(|region| region.area).sum();
    if (sum - pore_area).abs() > 1e-12 * domain.area() {
        found.push(format!("areas sum to {sum} and not to {pore_area}"));
    }
    let mut uses = vec![[0; 2]; network.throats.len()];
    for (number, region) in network.regions.iter().enumerate() {
        if !(region.area > 0.0) {
            found.push(format!("region {number} has area {}", region.area));
        }
        if !domain.grown(1e-9 * domain.size().max()).contains(region.center) {
            found.push(format!("region {number} has its center outside of the domain"));
        }
        let length: f64 = walls(&region.edges).map(|piece| piece.curve.length()).sum();
        if (length - region.wall_length).abs() > 1e-12 * (length + domain.size().max()) {
            found.push(format!("region {number} has a wall length of {}, not {length}", region.wall_length));
        }
        for edge in &region.edges {
            if let Edge::Throat { throat, end, from, to } = edge {
                uses[*throat][*end] += 1;
                let other = &network.throats[*throat];
                if other.regions[*end] != number {
                    found.push(format!("throat {throat} does not know region {number}"));
                }
                let shift = if *end == 0 { Vec2::zeros() } else { other.shift };
                let contacts = other.contacts.map(|contact| contact + shift);
                let (p, q) = if *end == 0 { (contacts[0], contacts[1]) } else { (contacts[1], contacts[0]) };
                if (p - from).norm() + (q - to).norm() > 1e-9 * domain.size().max() {
                    found.push(format!("throat {throat} has its chord elsewhere than region {number}"));
                }
            }
        }
        found.extend(gaps(&region.edges, 1e-7 * domain.size().max()).map(|gap| format!("region {number}: {gap}")));
    }
    for (number, throat) in network.throats.iter().enumerate() {
        if uses[number] != [1, 1] {
            found.push(format!("throat {number} is used {:?} times", uses[number]));
        }
        if throat.regions.iter().any(|&region| 0.5 * throat.width > network.regions[region].radius * (1.0 + 1e-7)) {
            found.push(format!("throat {number} is wider than a pore"));
        }
    }
    found
}

/// The pieces of wall of a boundary.
fn walls(edges: &[Edge]) -> impl Iterator<Item = &meniscus_network::graph::WallPiece> {
    edges.iter().flat_map(|edge| match edge {
        Edge::Wall(pieces) => &pieces[..],
        _ => &[],
    })
}

/// Where a boundary is not closed. A region around which an open side runs that no wall meets has two lines; others have one.
fn gaps(edges: &[Edge], slack: f64) -> impl Iterator<Item = String> {
    let mut ends: Vec<[Vec2; 2]> = Vec::new();
    for edge in edges {
        match edge {
            Edge::Wall(pieces) => ends.extend(pieces.iter().map(|piece| [0.0, 1.0].map(|u| piece.curve.point(u)))),
            Edge::Throat { from, to, .. } | Edge::Opening { from, to, .. } => ends.push([*from, *to]),
        }
    }
    let open: Vec<[Vec2; 2]> = (0..ends.len())
        .map(|k| [ends[k][1], ends[(k + 1) % ends.len()][0]])
        .filter(|[a, b]| (a - b).norm() > slack)
        .collect();
    let is_two_lines = open.len() == 2 && edges.iter().any(|edge| matches!(edge, Edge::Opening { .. }));
    open.into_iter().filter(move |_| !is_two_lines).map(|[a, b]| format!("its boundary jumps from {a:?} to {b:?}"))
}

/// Asserts that inscribed radii and widths are those of the wall distance, for domains without open sides.
#[track_caller]
pub fn assert_distances(geometry: &Geometry, network: &Network) {
    let slack = 1e-9 * geometry.bounds().size().max();
    for region in &network.regions {
        let d = geometry.signed_distance(region.center);
        assert!((d - region.radius).abs() <= slack + 1e-8 * d, "{d} {region:?}");
    }
    for throat in &network.throats {
        let d = geometry.signed_distance(0.5 * (throat.contacts[0] + throat.contacts[1]));
        assert!((d - 0.5 * throat.width).abs() <= slack + 1e-8 * d, "{d} {throat:?}");
    }
}
