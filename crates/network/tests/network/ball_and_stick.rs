//! Networks read from tables, drawn ball and stick, and extracted again.

use std::collections::BTreeMap;

use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use meniscus_geometry::Geometry;
use meniscus_network::extract;
use meniscus_network::graph::Pores;

use crate::cases::{loaded, named, to_the_end};
use crate::drawings::contents::imported;
use crate::drawings::files::file;

#[test]
fn every_pore_and_throat_of_a_network_of_openpnm_is_found_again() {
    let spec = imported("network-openpnm.csv", &Options::default()).spec;
    let geometry = Geometry::new(&spec).unwrap().with_wall_sides([false, false, true, true]);
    let network = extract(&geometry, [true, true, false, false]).unwrap();
    // An opening as wide as its pore is a level passage beside it.
    let pores = Pores::merged(&network, 0.95);
    let text = std::fs::read_to_string(file("network-openpnm.csv")).unwrap();
    // The first column is that of the diameters of throats.
    let mut expected: Vec<f64> = text.lines().skip(1).filter_map(|line| line.split(',').next()?.parse().ok()).collect();
    let mut found: Vec<f64> = pores.throats.iter().map(|&throat| network.throats[throat].width).collect();
    expected.sort_by(f64::total_cmp);
    found.sort_by(f64::total_cmp);
    assert_eq!((pores.main_region.len(), network.openings.len(), found.len()), (24, 8, 38));
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
}

#[test]
fn a_network_that_is_read_back_has_its_throats_again() {
    let solver = to_the_end(&loaded(&named("drainage"), &[]));
    let folder = tempfile::tempdir().unwrap();
    for table in solver.results().tables {
        meniscus_output::table::write(folder.path(), &table()).unwrap();
    }
    let mut reader = csv::Reader::from_path(folder.path().join("throats.csv")).unwrap();
    let rows = reader.deserialize().map(|row| row.unwrap()).collect::<Vec<BTreeMap<String, String>>>();
    let widths: Vec<f64> = rows.iter().map(|row| row["width_m"].parse().unwrap()).collect();
    for name in ["openpnm.csv", "pores.csv"] {
        let spec = load(&folder.path().join(name), &Options::default()).unwrap().spec;
        let geometry = Geometry::new(&spec).unwrap().with_wall_sides([false, false, true, true]);
        let network = extract(&geometry, [true, true, false, false]).unwrap();
        let is_found = |width: &&f64| network.throats.iter().any(|it| (it.width / **width - 1.0).abs() < 1e-9);
        let found = widths.iter().filter(is_found).count();
        assert_eq!((found, network.openings.len() > 1), (widths.len(), true), "{name}");
    }
}
