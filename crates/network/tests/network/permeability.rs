//! Permeabilities against direct solutions of the Stokes equations.
//!
//! permeability.json holds random packs, periodic along x and y, and what `postprocess/stokes_permeability.py` finds for them:
//!
//! ```sh
//! meniscus new loose.toml --pack random --seed 1 --porosity 0.7 --radius-deviation 0.2 --gap 1e-5 --size 1.6e-3,1.6e-3 --periodic xy
//! meniscus new middle.toml --pack random --seed 2 --porosity 0.55 --radius-deviation 0.2 --gap 1e-5 --size 1.6e-3,1.2e-3 --periodic xy
//! meniscus new dense.toml --pack random --seed 3 --porosity 0.4 --gap 1e-5 --size 1.1e-3,1.1e-3 --periodic xy
//! python postprocess/stokes_permeability.py loose.toml middle.toml dense.toml --periodic xy --json crates/network/tests/network/permeability.json
//! ```

use meniscus_core::math::{Bounds, Vec2};
use meniscus_network::conductance::conductances;
use meniscus_network::graph::Network;
use meniscus_network::permeability::{Drive, Paths, permeability};
use serde_json::Value;

use crate::scenes::*;

fn along(network: &Network, size: [f64; 2], drive: Drive) -> f64 {
    let (conductance, holds) = (conductances(network), vec![true; network.regions.len()]);
    let domain = Bounds { min: Vec2::zeros(), max: Vec2::new(size[0], size[1]) };
    permeability(network, Paths { conductance: &conductance, holds: &holds }, domain, drive).unwrap()
}

#[test]
fn random_packs_have_the_permeability_of_stokes_flow() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/network/permeability.json");
    let packs: Vec<Value> = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    assert_eq!(packs.len(), 3);
    for pack in packs {
        let number = |value: &Value| value.as_f64().unwrap();
        let numbers = |value: &Value| value.as_array().unwrap().iter().map(number).collect::<Vec<_>>();
        let size = numbers(&pack["max"]);
        let size = [size[0], size[1]];
        let shapes = pack["discs"].as_array().unwrap().iter().map(numbers).map(|d| disc(d[0], d[1], d[2])).collect();
        let geometry = grains(size, shapes).with_periodic([true, true]);
        let network = network(&geometry, CLOSED);
        for axis in [0, 1] {
            let exact = number(&pack[["permeability-x-m2", "permeability-y-m2"][axis]]);
            let error = along(&network, size, Drive::Periodic(axis)) / exact - 1.0;
            // 44 packs at solid fractions of 0.3 to 0.6 are within 5 %.
            assert!(error.abs() < 0.05, "{}, axis {axis}: {error}", pack["shapes"]);
        }
    }
}

#[test]
fn square_posts_have_the_permeability_of_stokes_flow() {
    // stokes_permeability.py on one post in a unit cell, at `--across 4.5`: walls with edges, upright and turned by 45 degrees.
    let post = |side: f64, rotation_deg: f64| {
        let post = meniscus_geometry::spec::Rectangle { center: [0.5; 2], size: [side; 2], rotation_deg };
        grains([1.0; 2], vec![meniscus_geometry::spec::ShapeSpec::Rectangle(post)]).with_periodic([true, true])
    };
    for (side, rotation_deg, exact) in
        [(0.8, 0.0, 7.254e-4), (0.6, 0.0, 6.362e-3), (0.6, 45.0, 2.089e-3), (0.5, 45.0, 8.207e-3)]
    {
        let network = network(&post(side, rotation_deg), CLOSED);
        for axis in [0, 1] {
            let error = along(&network, [1.0; 2], Drive::Periodic(axis)) / exact - 1.0;
            // Lubrication does not see all that flow loses at edges.
            assert!(error.abs() < 0.06, "{side}, {rotation_deg} degrees: {error}");
        }
    }
}
