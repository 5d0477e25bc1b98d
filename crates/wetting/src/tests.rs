//! Properties of every law: the tests run over the list of laws, each with the examples of its parameters.

use std::f64::consts::PI;

use super::law::LineState;
use super::{Bracke, CoxVoinov, Jiang, Kistler, RawWetting, Wetting, laws};
use meniscus_core::input::Checker;

/// The tables, with a placeholder for patches.
type Tables = RawWetting<bool>;

/// A line of a case file that sets a key.
fn set(key: &str, value: f64) -> String {
    format!("{key} = {value:?}\n")
}

/// Every law with the static angle (degrees) and the examples of its other parameters.
fn models(degrees: f64) -> Vec<Wetting> {
    let model = |law: super::LawTable| {
        let angles = law.angles();
        let line = |(key, rule): &(String, super::Key)| match angles.contains(&key.as_str()) {
            true => set(key, degrees),
            false => format!("{}\n", rule.example.unwrap()),
        };
        let text = format!("[{}]\n{}", law.key, law.keys.iter().map(line).collect::<String>());
        let tables: Tables = toml::from_str(&text).unwrap_or_else(|error| panic!("{text}{error}"));
        assert_eq!(tables.given(), std::slice::from_ref(&law.key));
        let mut checker = Checker::default();
        let model = tables.checked(&mut checker, "sph.wetting");
        model.unwrap_or_else(|| panic!("{text}{:?}", checker.problems))
    };
    laws().into_iter().map(model).collect()
}

fn line(speed: f64) -> LineState {
    LineState {
        present: 1.3,
        speed,
        tension: 0.02,
        viscosity: 1.0e-3,
        other_viscosity: 1.0e-3,
        length: 1.0e-4,
        slip_length: 1.0e-4,
    }
}

/// [Kistler1993; Jiang1979, Eq. 7; Bracke1989; Voinov1976; Cox1986, Eq. 8.3]
#[test]
fn angles_are_the_published_ones() {
    let (contact_angle_deg, length) = (46.8, 1e-4);
    // For a logarithm of ten.
    let voinov = CoxVoinov { contact_angle_deg, slip_length: length / 10_f64.exp() };
    // On a liquid that wets completely the cosine is 1 less 4 roots of the capillary number.
    let degrees = |cosine: f64| cosine.acos().to_degrees();
    let bracke = [(1e-4, 0.96), (1e-2, 0.6), (0.0625, 0.0), (0.25, -1.0), (1.0, -1.0)];
    for (model, angles, tolerance) in [
        (Wetting::Kistler(Kistler { contact_angle_deg }), vec![(1e-4, 47.03), (1e-3, 49.04), (1e-2, 64.12)], 0.006),
        (Wetting::Jiang(Jiang { contact_angle_deg }), vec![(1e-4, 47.81), (1e-3, 51.75), (1e-2, 68.95)], 0.006),
        (Wetting::CoxVoinov(voinov), vec![(1e-4, 47.06), (1e-3, 49.25), (1e-2, 64.78)], 0.006),
        (
            Wetting::Bracke(Bracke { contact_angle_deg: 0.0 }),
            bracke.map(|(ca, cos)| (ca, degrees(cos))).to_vec(),
            1e-10,
        ),
    ] {
        for (capillary, expected) in angles {
            let line = LineState { speed: capillary, tension: 1.0, viscosity: 1.0, length, ..line(0.0) };
            let found = model.angle(&line).to_degrees();
            assert!((found - expected).abs() < tolerance, "{model:?}, {capillary}: {found}, expected {expected}");
        }
    }
}

#[test]
fn every_model_has_its_static_angle_at_rest() {
    for degrees in [20.0_f64, 46.8, 90.0, 130.0] {
        for model in models(degrees) {
            let found = model.angle(&line(0.0)).to_degrees();
            // Kistler's function is inverted by bisection, the others in closed form.
            assert!((found - degrees).abs() < 1e-6, "{model:?}: {found}");
            assert!((model.static_angle().to_degrees() - degrees).abs() < 1e-9, "{model:?}");
        }
    }
}

/// [BrochardWyart1992]
#[test]
fn no_model_has_a_smaller_angle_at_a_higher_speed_and_all_stay_between_0_and_180_degrees() {
    for model in models(57.3) {
        let angles: Vec<f64> = (-40..=40).map(|i| model.angle(&line(0.1 * f64::from(i)))).collect();
        assert!(angles.iter().all(|angle| (0.0..=PI).contains(angle)), "{model:?}: {angles:?}");
        assert!(angles.windows(2).all(|pair| pair[0] <= pair[1]), "{model:?}: {angles:?}");
        assert_eq!(model.is_dynamic(), angles[0] < angles[80], "{model:?}");
    }
}

#[test]
fn the_report_has_angles_in_radians_and_temperatures_in_kelvin() {
    let json = |key: &str| {
        let model = models(60.0).into_iter().find(|model| model.table().key == key).unwrap();
        serde_json::to_string(&model).unwrap()
    };
    let angle = 60.0_f64.to_radians();
    assert_eq!(json("young"), format!("{{\"young\":{{\"contact_angle\":{angle:?}}}}}"));
    assert_eq!(json("tadmor"), format!("{{\"tadmor\":{{\"advancing\":{angle:?},\"receding\":{angle:?}}}}}"));
    let molecular = json("molecular-kinetic");
    assert!(molecular.ends_with("\"jump_length\":1e-9,\"temperature\":293.15}}"), "{molecular}");
}

#[test]
fn every_model_is_written_as_it_is_read() {
    for model in models(40.0) {
        let written = toml::to_string(&Tables::of(&model, None)).unwrap();
        let read: Tables = toml::from_str(&written).unwrap();
        assert_eq!(read.checked(&mut Checker::default(), "sph.wetting"), Some(model), "{written}");
    }
}

#[test]
fn every_model_names_each_key_that_is_missing_or_out_of_range() {
    for law in laws() {
        let text = format!("[{}]\n", law.key);
        let mut checker = Checker::default();
        let none: Tables = toml::from_str(&text).unwrap();
        assert_eq!(none.checked(&mut checker, "sph.wetting"), None);
        let required = law.keys.iter().filter(|(_, rule)| rule.is_required());
        for ((key, rule), problem) in required.clone().zip(&checker.problems) {
            assert_eq!(problem.path, format!("sph.wetting.{}.{key}", law.key));
            assert_eq!(problem.message, format!("missing key `{key}` in [sph.wetting.{}]", law.key));
            assert!(rule.example.unwrap().starts_with(&format!("{key} = ")), "{rule:?}");
        }
        assert_eq!(checker.problems.len(), required.count());
        let mut checker = Checker::default();
        let all = text + &law.keys.iter().map(|(key, _)| set(key, -1000.0)).collect::<String>();
        assert_eq!(toml::from_str::<Tables>(&all).unwrap().checked(&mut checker, "sph.wetting"), None);
        for ((key, rule), problem) in law.keys.iter().zip(&checker.problems) {
            assert_eq!(problem.path, format!("sph.wetting.{}.{key}", law.key));
            assert_eq!(problem.message, format!("expected {} {}, found -1000.0", rule.what, rule.range.unwrap()));
        }
        assert_eq!(checker.problems.len(), law.keys.len());
    }
}

#[test]
fn every_model_has_an_angle_and_tells_its_source() {
    for law in laws() {
        assert!(!law.angles().is_empty(), "{law:?}");
        let (what, source) = law.what_and_source();
        assert!(!what.is_empty() && source.ends_with(|c: char| c.is_ascii_digit()), "{law:?}");
    }
}

#[test]
fn the_angles_of_a_patch_replace_those_of_the_model_and_nothing_else() {
    for model in models(40.0) {
        let law = model.table();
        let angles: Vec<(&str, Option<f64>)> = law.angles().into_iter().map(|key| (key, Some(50.0))).collect();
        let patch = model.with_angles(&mut Checker::default(), "sph.wetting.patches[0]", &angles).unwrap();
        for (key, _) in &law.keys {
            let expected = if law.angles().contains(&key.as_str()) { Some(50.0) } else { model.parameter(key) };
            assert_eq!(patch.parameter(key), expected, "{model:?}");
        }
        let mut checker = Checker::default();
        assert_eq!(model.with_angles(&mut checker, "sph.wetting.patches[0]", &[]), None);
        assert_eq!(checker.problems.len(), law.angles().len());
    }
}
