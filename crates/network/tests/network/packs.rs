//! Random packs of every kind of grain and side.

use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Disc, GeometrySpec, Polygon, Rectangle, ShapeSpec, SolidSide};
use meniscus_network::{ExtractError, extract};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::invariants::{assert_distances, violations};
use crate::scenes::*;
use crate::support::packs as grown;
use grown::{Grains, Pack};

#[test]
fn a_thousand_random_packs_have_a_network_with_all_its_invariants() {
    let mut failures = Vec::new();
    for seed in 0..1000_u64 {
        let kind = |k: u64, of: u64| ((seed / k) % of) as usize;
        let grains_of = [Grains::Discs, Grains::Polygons, Grains::Curves, Grains::Bars, Grains::Mixed][kind(1, 5)];
        let sides = kind(5, 6);
        // Overlapping, nearly touching, tight and loose.
        let gap = [-0.15, 0.001, 0.02, 0.2][kind(30, 4)];
        let (side, count) = [(3.0, 3), (4.0, 10), (7.0, 30)][kind(120, 3)];
        let pack = Pack { side, count, radii: [0.2, 0.6], gap, periodic: sides == 1, grains: grains_of, seed };
        let g = grains([side; 2], pack.shapes());
        let (g, open) = match sides {
            0 => (g.with_wall_sides([true; 4]), CLOSED),
            1 => (g.with_periodic([true, true]), CLOSED),
            2 => (g.with_wall_sides([false, false, true, true]), LEFT_RIGHT),
            3 => (g, [true; 4]),
            4 => (g.with_periodic([true, false]).with_wall_sides([false, false, true, true]), CLOSED),
            _ => (g.with_periodic([false, true]), LEFT_RIGHT),
        };
        match extract(&g, open) {
            Err(error) => failures.push(format!("{pack:?}: {error}")),
            Ok(network) => {
                failures.extend(violations(&g, &network).into_iter().map(|violation| format!("{pack:?}: {violation}")));
                if open == CLOSED {
                    assert_distances(&g, &network);
                }
            }
        }
    }
    assert!(failures.is_empty(), "{} failures: {:#?}", failures.len(), &failures[..failures.len().min(5)]);
}

#[test]
fn separate_grains_obey_the_formula_of_euler() {
    for seed in 0..20 {
        let pack =
            Pack { side: 9.0, count: 40, radii: [0.3, 0.6], gap: 0.05, periodic: true, grains: Grains::Mixed, seed };
        let g = grains([9.0; 2], pack.shapes()).with_periodic([true, true]);
        let n = network(&g, CLOSED);
        // On the torus: pores - throats + grains = 0.
        assert_eq!(n.throats.len(), n.regions.len() + pack.shapes().len());
    }
}

/// Shapes on the sites of a square lattice, which touch along sides, in corners and in points.
fn lattice(kind: usize, size: usize, share: f64, seed: u64) -> Vec<ShapeSpec> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut shapes = Vec::new();
    for site in 0..size * size {
        let center = [(site % size) as f64 + 0.5, (site / size) as f64 + 0.5];
        let mut halves = || 0.5 + 0.5 * (4.0 * rng.random::<f64>()).floor();
        let size = [halves(), halves()];
        if rng.random::<f64>() < share {
            shapes.push(match kind {
                0 => rectangle(center, [1.0, 1.0]),
                1 => rectangle(center, size),
                2 => disc(center[0], center[1], 0.5),
                3 => disc(center[0], center[1], 0.4),
                _ => ShapeSpec::Rectangle(Rectangle { center, size: [0.5_f64.sqrt(); 2], rotation_deg: 45.0 }),
            });
        }
    }
    shapes
}

#[test]
fn grains_on_a_lattice_have_a_network_though_everything_is_level_or_touches() {
    let mut failures = Vec::new();
    let mut count = 0;
    for seed in 0..480_u64 {
        let kind = |k: u64, of: u64| ((seed / k) % of) as usize;
        let (size, share) = ([4, 6, 9][kind(1, 3)], [0.1, 0.25, 0.4, 0.6][kind(3, 4)]);
        let shapes = lattice(kind(12, 5), size, share, seed);
        if shapes.is_empty() {
            continue;
        }
        let g = grains([size as f64; 2], shapes);
        let (g, open) = match kind(60, 4) {
            0 => (g.with_wall_sides([true; 4]), CLOSED),
            1 => (g.with_periodic([true, true]), CLOSED),
            2 => (g.with_wall_sides([false, false, true, true]), LEFT_RIGHT),
            _ => (g, [true; 4]),
        };
        match extract(&g, open) {
            Err(ExtractError::NoWalls { .. }) => {}
            Err(error) => failures.push(format!("{seed}: {error}")),
            Ok(network) => {
                count += 1;
                failures.extend(violations(&g, &network).into_iter().map(|violation| format!("{seed}: {violation}")));
            }
        }
    }
    assert!(failures.is_empty(), "{} failures: {:#?}", failures.len(), &failures[..failures.len().min(5)]);
    assert!(count > 400, "{count}");
}

#[test]
fn a_network_has_the_size_of_its_grains_wherever_they_stand() {
    let pack =
        Pack { side: 6.0, count: 25, radii: [0.3, 0.6], gap: 0.03, periodic: true, grains: Grains::Discs, seed: 3 };
    let polygons = Pack { side: 6.0, count: 8, grains: Grains::Polygons, seed: 4, ..pack };
    let network_of = |scale: f64, origin: f64| {
        let moved = |[x, y]: [f64; 2]| [origin + scale * x, origin + scale * y];
        let shapes = pack.shapes().into_iter().chain(polygons.shapes()).map(|shape| match shape {
            ShapeSpec::Disc(disc) => ShapeSpec::Disc(Disc { center: moved(disc.center), radius: scale * disc.radius }),
            ShapeSpec::Polygon(ring) => {
                let outer = ring.outer.iter().map(|[x, y]| [scale * x, scale * y]).collect();
                ShapeSpec::Polygon(Polygon { outer, position: moved(ring.position), ..ring })
            }
            other => other,
        });
        let (min, max) = (moved([0.0; 2]), moved([6.0; 2]));
        let spec = GeometrySpec { min, max, solid: SolidSide::Inside, shapes: shapes.collect() };
        network(&Geometry::new(&spec).unwrap().with_periodic([true, true]), CLOSED)
    };
    let plain = network_of(1.0, 0.0);
    assert!(plain.throats.len() > 40);
    for (scale, origin) in [(1e-6, 0.0), (1e-6, 1e-4), (1e3, -5e5)] {
        let other = network_of(scale, origin);
        let scaled =
            |values: Vec<f64>, power: i32| values.iter().map(|value| value / scale.powi(power)).collect::<Vec<f64>>();
        assert_eq!(other.throats.len(), plain.throats.len());
        // Positions far from the origin are rounded.
        let rounding = 1e-14 * (1.0 + (origin / scale).abs());
        for (a, b) in scaled(widths(&other), 1).iter().zip(widths(&plain)) {
            assert!((a - b).abs() < rounding, "{a} {b}");
        }
        for (a, b) in scaled(areas(&other), 2).iter().zip(areas(&plain)) {
            assert!((a - b).abs() < 100.0 * rounding, "{a} {b}");
        }
    }
}
