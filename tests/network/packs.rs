//! Random packs of every kind of grain and side.

#[path = "../support/packs.rs"]
mod packs;

use meniscus::network::extract;

use crate::invariants::{assert_distances, violations};
use crate::scenes::*;
use packs::{Grains, Pack};

#[test]
fn a_thousand_random_packs_have_a_network_with_all_its_invariants() {
    let mut failures = Vec::new();
    for seed in 0..1000_u64 {
        let kind = |k: u64, of: u64| ((seed / k) % of) as usize;
        let grains_of = [Grains::Discs, Grains::Polygons, Grains::Bars, Grains::Mixed][kind(1, 4)];
        let sides = kind(4, 6);
        // Overlapping, nearly touching, tight and loose.
        let gap = [-0.15, 0.001, 0.02, 0.2][kind(24, 4)];
        let (side, count) = [(3.0, 3), (4.0, 10), (7.0, 30)][kind(96, 3)];
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
