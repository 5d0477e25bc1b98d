//! Networks read from tables, drawn ball and stick, and extracted again.

use meniscus_drawings::import::Options;
use meniscus_geometry::Geometry;
use meniscus_network::extract;
use meniscus_network::graph::Pores;

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
