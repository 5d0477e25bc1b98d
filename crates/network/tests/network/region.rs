//! Saturations and the porosity of a region, and what a table of events begins with.

use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;

use meniscus::run::execute::Mode;
use meniscus::run::simulation::Unwatched;
use meniscus_case::Loaded;
use meniscus_network::setup::build_quasi_static;

use crate::cases::{loaded, measures, named, run, to_the_end};

/// The chip of the tutorial with manifolds at both sides.
fn chip(set: &[&str]) -> Loaded {
    loaded(&named("chip"), &[&["expect=[]"], set].concat())
}

/// The text of a file that a run leaves.
fn file(case: &Loaded, name: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    run(case, folder.path(), Mode::New, &AtomicBool::new(false), &mut Unwatched);
    std::fs::read_to_string(folder.path().join(name)).unwrap()
}

/// A column of a table that a run leaves.
fn column(text: &str, name: &str) -> Vec<String> {
    let place = text.lines().next().unwrap().split(',').position(|column| column == name).unwrap();
    text.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().to_owned()).collect()
}

#[test]
fn in_the_pack_saturations_begin_at_one_and_the_displacement_is_the_same() {
    let (whole, pack) = (chip(&[]), chip(&["network.region.extent=\"pack\""]));
    let (one, other) = (file(&whole, "events.csv"), file(&pack, "events.csv"));
    for name in ["event", "throat", "capillary_pressure_Pa"] {
        assert_eq!(column(&one, name), column(&other, name), "{name}");
    }
    let saturations: Vec<f64> = column(&other, "saturation").iter().map(|text| text.parse().unwrap()).collect();
    assert_eq!(column(&other, "event")[0], "beginning");
    assert_eq!(saturations[0], 1.0);
    assert!(column(&one, "saturation")[0].parse::<f64>().unwrap() < 0.95);
    assert!(saturations.windows(2).all(|pair| pair[1] <= pair[0]));
    // What is trapped lies between the grains, so that it is more of a smaller pore space.
    let found = [&whole, &pack].map(|case| measures(to_the_end(case).as_ref()));
    let of = |name: &str| [found[0][name], found[1][name]];
    let [all, within] = of("trapped-saturation");
    assert!(within > all + 0.05, "{all} {within}");
    let [all, within] = of("porosity");
    assert!(within < all - 0.02, "{all} {within}");
    assert_eq!(found[0]["breakthrough-pressure-Pa"], found[1]["breakthrough-pressure-Pa"]);
}

#[test]
fn the_halves_of_a_domain_hold_what_all_of_it_holds() {
    let half = |min: f64, max: f64| {
        let corners = [format!("network.region.min=[{min}, 0.0]"), format!("network.region.max=[{max}, 8e-3]")];
        measures(to_the_end(&chip(&[&corners[0], &corners[1]])).as_ref())
    };
    let (left, right, all) = (half(0.0, 5e-3), half(5e-3, 12e-3), measures(to_the_end(&chip(&[])).as_ref()));
    let mean = (5.0 * left["porosity"] + 7.0 * right["porosity"]) / 12.0;
    assert!((mean - all["porosity"]).abs() < 1e-12, "{mean}");
    assert_ne!(left["final-wetting-saturation"], right["final-wetting-saturation"]);
}

#[test]
fn a_region_without_a_pore_is_refused() {
    let error = |set: &[&str]| {
        let case = chip(set).case;
        let meniscus_case::Model::Network(network) = &case.model else { panic!("network") };
        build_quasi_static(&case, network).err().map(|error| error.to_string())
    };
    // Within a disc of 0.8 mm about (4.17, 6.68) mm.
    let found = error(&["network.region.min=[4.0e-3, 6.5e-3]", "network.region.max=[4.2e-3, 6.8e-3]"]).unwrap();
    assert!(found.contains("no pore space in the region") && found.contains("network.region"), "{found}");
    // In the manifold.
    assert!(error(&["network.region.min=[0.0, 0.0]", "network.region.max=[3e-4, 1e-3]"]).is_some());
}

#[test]
fn events_begin_with_what_is_filled_before_them() {
    let cycle = loaded(&named("cycle"), &["expect=[]"]);
    let text = file(&cycle, "events.csv");
    let of = |name: &str| column(&text, name);
    let rows: Vec<[String; 4]> = of("half_cycle")
        .into_iter()
        .zip(of("sequence"))
        .zip(of("event"))
        .zip(of("capillary_pressure_Pa"))
        .map(|(((half, sequence), event), pressure)| [half, sequence, event, pressure])
        .collect();
    let first = rows.iter().filter(|row| row[2] == "beginning").map(|row| row[0].as_str()).collect::<Vec<_>>();
    assert_eq!(first, ["1", "2", "3", "4"]);
    let numbers: BTreeMap<&str, &str> = rows.iter().map(|row| (row[1].as_str(), row[2].as_str())).collect();
    assert_eq!(numbers["0"], "beginning");
    assert!(rows.iter().all(|row| (row[2] == "beginning") == row[3].is_empty()));
    let dynamic = loaded(&named("dynamic"), &["expect=[]"]);
    let text = file(&dynamic, "events.csv");
    assert_eq!((column(&text, "event")[0].as_str(), column(&text, "time_s")[0].parse()), ("beginning", Ok(0.0)));
}
