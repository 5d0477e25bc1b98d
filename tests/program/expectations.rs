//! Expectations: a case can expect what its run measures, and nothing else.

use std::collections::BTreeSet;

use meniscus_case::load;
use meniscus_case::measures::offers;
use meniscus_core::input::Overrides;

use crate::support::program::{assert_code, folder_with_small_case, meniscus, report};
use crate::support::python::root;

#[test]
fn a_report_has_the_measures_that_its_case_can_expect_and_no_other() {
    let folder = folder_with_small_case();
    let case = load(&folder.path().join("drop.toml"), &Overrides::default()).unwrap().case;
    assert_code(&meniscus(folder.path(), &["run", "drop.toml", "--out", "out"]), 0);
    let offered = offers(&case.model, Some(&case.geometry), case.steady.is_some());
    let offered = offered.iter().filter(|offer| offer.is_given).flat_map(|offer| offer.names.iter().copied());
    let report = report(&folder.path().join("out"));
    let there = report["measures"].as_object().unwrap().keys().map(String::as_str);
    assert_eq!(there.collect::<BTreeSet<_>>(), offered.collect());
}

#[test]
fn an_expectation_of_what_the_case_cannot_measure_is_refused_with_what_gives_it() {
    // What the sides and settings of a case give, and what they do not.
    let cases = [
        ("sessile-drop", "smallest-wall-distance-m", None),
        ("sessile-drop", "balance-error", Some("open sides or a given flow")),
        ("sessile-drop", "balance-eror", Some("did you mean `balance-error`?")),
        ("sessile-drop", "inflow-ratio", Some("a velocity or a flow-rate in [sph.sides.open]")),
        ("taylor-green", "smallest-wall-distance-m", Some("a side that is a wall")),
        ("open-channel", "inflow-ratio", None),
        ("open-channel", "driving-pressure-drop-Pa", Some("a given flow through periodic sides")),
        ("open-channel", "burst-pressure-Pa", Some("pressure-steps in [sph.sides.open]")),
        ("burst-pressure", "burst-pressure-Pa", None),
        ("burst-pressure", "asked-inflow-m2-per-s", Some("a velocity or a flow-rate")),
        ("permeability-tensor", "permeability-xy-m2", None),
        ("relative-permeability", "relative-permeability-non-wetting", None),
        ("relative-permeability", "capillary-pressure-Pa", Some("an interface that moves")),
        ("thin-film/slip", "last-particle-position", Some("[thin-film.method.particles]")),
        ("thin-film/partial-wetting", "similarity-error", Some("completely wetting")),
    ];
    for (case, measure, refused) in cases {
        let path = root().join(format!("cases/{case}.toml"));
        let expect = format!("expect=[{{ measure = \"{measure}\", value = 1.0, tolerance = 1.0 }}]");
        let loaded = load(&path, &Overrides::parse(&[expect]).unwrap());
        match (loaded, refused) {
            (Ok(_), None) => {}
            (Err(error), Some(help)) => {
                let told = error.mistakes.iter().map(|it| format!("{} {}", it.message, it.help_text()));
                let told: Vec<String> = told.collect();
                assert!(told.len() == 1 && told[0].contains(measure) && told[0].contains(help), "{case}: {told:?}");
                assert!(!told[0].contains(", `balance-error`"), "{case} offers it: {told:?}");
            }
            (loaded, _) => panic!("{measure} of {case}: {loaded:?}"),
        }
    }
}
