//! Droplets at rest: the method that a case gets by default has the angle asked for, whatever start, spacing and filter; what cannot have it says so.

use std::path::{Path, PathBuf};

use crate::support::{advance, loaded};
use meniscus::run::setup;
use meniscus_case::load;
use meniscus_case::{Case, Model};
use meniscus_core::input::Overrides;
use meniscus_core::solver::{Series, Solver};

fn input(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/film/inputs/{name}.toml"))
}

/// A droplet of 2.4e-7 m² on the wall of `tfp15.toml`.
fn droplet(half_width: f64) -> String {
    let height = 0.75 * 2.4e-7 / half_width;
    format!("thin-film.droplets=[{{ half-width = {half_width:e}, height = {height:e} }}]")
}

/// A scaled time of the case in s, and the case, which ends then.
fn until(set: &[String], name: &str, scaled: f64) -> Case {
    let set: Vec<&str> = set.iter().map(String::as_str).collect();
    let mut case = loaded(&input(name), &set).case;
    let Model::ThinFilm(film) = &case.model else { panic!("a film") };
    case.end = scaled * film.scales()[2];
    case
}

fn run(case: &Case) -> Box<dyn Solver> {
    let mut solver = setup::build(case).unwrap();
    advance(solver.as_mut(), &[case.end]);
    solver
}

fn value(solver: &dyn Solver, name: &str) -> f64 {
    solver.measures(&Series::default()).iter().find(|measure| measure.name == name).unwrap().value
}

fn warnings(case: &Case, solver: &dyn Solver) -> String {
    setup::warnings(case, solver, &Series::default()).join("\n")
}

#[test]
fn the_default_method_rests_at_the_angle_asked_for() {
    // Angle in degrees, spacing, filter length and half width at the start in m.
    for (angle, spacing, filter, half_width) in [
        (15.0, 1.0e-5, 3.0e-5, 6.0e-4),
        (15.0, 1.0e-5, 1.0e-5, 6.0e-4),
        (25.0, 7.5e-6, 4.0e-5, 4.0e-4),
        (8.0, 1.5e-5, 6.0e-5, 9.0e-4),
    ] {
        let set = [
            format!("thin-film.wetting.partial.contact-angle-deg={angle:?}"),
            format!("thin-film.spacing={spacing:e}"),
            format!("thin-film.equation.geometric.smoothing-length={filter:e}"),
            droplet(half_width),
        ];
        let case = until(&set, "tfp15", 60.0);
        let solver = run(&case);
        let what = format!("{angle} {spacing:e} {filter:e} {half_width:e}");
        let ratio = value(solver.as_ref(), "contact-angle-ratio");
        assert!((ratio - 1.0).abs() < 0.003, "{what}: {ratio}");
        assert_eq!(value(solver.as_ref(), "droplet-count"), 1.0, "{what}");
        assert_eq!(warnings(&case, solver.as_ref()), "", "{what}");
    }
}

#[test]
fn particles_that_rest_at_another_angle_say_at_which_before_the_run() {
    for (angle, per_filter, half_width) in
        [(5.0, 10.0, 6.0e-4), (15.0, 3.0, 6.0e-4), (15.0, 6.0, 6.0e-4), (40.0, 2.0, 5.0e-4)]
    {
        let set = [
            format!("thin-film.wetting.partial.contact-angle-deg={angle:?}"),
            format!("thin-film.spacing={:e}", 3.0e-5 / per_filter),
            "thin-film.method={ particles = {} }".to_owned(),
            droplet(half_width),
        ];
        let case = until(&set, "tfp15", 60.0);
        let Model::ThinFilm(film) = &case.model else { panic!("a film") };
        let told = film.slope_at_rest_on_lattice().unwrap().atan().to_degrees();
        let solver = run(&case);
        let found = value(solver.as_ref(), "contact-angle-deg");
        // Beyond 40 degrees the lattice is a smaller part of the slope.
        assert!((found / told - 1.0).abs() < 0.02 && found > 1.05 * angle, "{angle} {per_filter}: {found}, {told}");
        let warned = warnings(&case, solver.as_ref());
        assert!(warned.contains(&format!("comes to rest at {told:.1} degrees instead of {angle:.1}")), "{warned}");
    }
}

#[test]
fn films_on_a_fine_grid_rest_as_long_as_the_case_wants() {
    for (angle, spacing, film) in [(12.0, 2.0e-6, 7.5e-7), (20.0, 4.0e-6, 2.0e-6), (12.0, 4.0e-6, 1.0e-6)] {
        let set = [
            format!("thin-film.wetting.partial.contact-angle-deg={angle:?}"),
            format!("thin-film.spacing={spacing:e}"),
            format!("thin-film.equation.precursor.film-height={film:e}"),
            "thin-film.method={ finite-differences = { step-share = 0.05 } }".to_owned(),
            "geometry={ min = [-0.0016, 0.0], max = [0.0016, 7.5e-4] }".to_owned(),
        ];
        let solver = run(&until(&set, "tfpre12b", 1000.0));
        let what = format!("{angle} {spacing:e} {film:e}");
        let rejected = solver.statistics().counts.iter().find(|(name, _)| *name == "rejected-steps").unwrap().1;
        // A few at the start, where the droplet is far from rest.
        assert!(rejected <= 10.0, "{what}: {rejected}");
        assert!((value(solver.as_ref(), "cap-angle-ratio") - 1.0).abs() < 0.03, "{what}");
    }
}

#[test]
fn a_contact_line_lies_in_the_domain_or_there_is_none() {
    let complete = "thin-film.wetting={ complete = {} }".to_owned();
    for (equation, half) in [
        ("{ geometric = { smoothing-length = 3e-5 } }", 7.0e-4),
        ("{ geometric = { smoothing-length = 3e-5 } }", 1.5e-3),
        ("{ slip = { slip-length = 2e-6 } }", 1.0e-3),
    ] {
        let set = [
            complete.clone(),
            format!("thin-film.equation={equation}"),
            "thin-film.method={ finite-differences = { step-share = 0.05 } }".to_owned(),
            format!("geometry={{ min = [-{half:e}, 0.0], max = [{half:e}, 7.5e-4] }}"),
            "thin-film.spacing=1e-5".to_owned(),
        ];
        let case = until(&set, "tfp15", 3.0e4);
        let solver = run(&case);
        let position = value(solver.as_ref(), "contact-line-position");
        assert!(position.is_nan() || position <= half, "{equation}: {position}");
        let is_told = warnings(&case, solver.as_ref()).contains("covers the wall");
        assert_eq!(position.is_nan(), is_told, "{equation}: {position}");
        assert!(position.is_nan(), "{equation}: {position}");
    }
}

#[test]
fn a_droplet_that_recedes_far_in_a_geometric_film_is_told_of_what_it_leaves_behind() {
    for (half_width, is_far) in [(9.0e-4, false), (1.2e-3, false), (1.8e-3, true), (2.4e-3, true)] {
        let case = until(&[droplet(half_width), "thin-film.spacing=1e-5".to_owned()], "tfp15", 60.0);
        let solver = run(&case);
        let short = 1.0 - value(solver.as_ref(), "contact-line-position") / 9.697e-4;
        assert_eq!(short > 0.01, is_far, "{half_width:e}: {short}");
        assert_eq!(warnings(&case, solver.as_ref()).contains("recedes"), is_far, "{half_width:e}");
    }
}

/// Whether the input loads with these values.
fn loads(set: &[String]) -> bool {
    load(&input("tfp15"), &Overrides::parse(set).unwrap()).is_ok()
}

#[test]
fn every_bound_between_two_keys_is_closed_and_met_within_rounding() {
    let grid = "thin-film.method={ finite-differences = {} }".to_owned();
    let particles = "thin-film.method={ particles = {} }".to_owned();
    let complete = "thin-film.wetting={ complete = {} }".to_owned();
    let geometric = |length: f64| format!("thin-film.equation={{ geometric = {{ smoothing-length = {length:e} }} }}");
    let film = |film: f64| format!("thin-film.equation={{ precursor = {{ film-height = {film:e} }} }}");
    let slip = |slip: f64| format!("thin-film.equation={{ slip = {{ slip-length = {slip:e} }} }}");
    for i in 1..=60 {
        // Half widths whose parts have no exact binary form.
        let r = 1.0e-5 * (f64::from(i) + 0.1 * f64::from(i % 7));
        let domain = format!("geometry={{ min = [{:e}, 0.0], max = [{:e}, {r:e}] }}", -20.0 * r, 20.0 * r);
        let drop = |height: f64| format!("thin-film.droplets=[{{ half-width = {r:e}, height = {height:e} }}]");
        let spacing = |spacing: f64| format!("thin-film.spacing={spacing:e}");
        let base = |spaced: f64, height: f64, equation: String, method: &String, wetting: &[String]| {
            let mut set = vec![domain.clone(), spacing(spaced), drop(height), equation, method.clone()];
            set.extend(wetting.iter().cloned());
            loads(&set)
        };
        let steps = [(1.0, true), (1.001, false)];
        for (beyond, is_in) in steps {
            let wet = std::slice::from_ref(&complete);
            let found = [
                base(r / 10.0 * beyond, 0.1 * r, geometric(0.3 * r), &grid, wet),
                base(r / 50.0, 5.0 * r * beyond, geometric(0.1 * r), &grid, wet),
                base(r / 50.0, 0.1 * r, geometric(0.4 * r * beyond), &grid, wet),
                base(0.1 * r / 3.0, 0.1 * r, geometric(0.1 * r / 3.0 / beyond), &grid, wet),
                base(0.1 * r / 3.0, 0.1 * r, geometric(0.2 * r / 3.0 / beyond), &particles, wet),
                base(r / 50.0, 0.1 * r, film(0.2 * (0.1 * r) * beyond), &grid, wet),
                base(r / 50.0, 0.3 * r, slip(0.5 * (0.3 * r) * beyond), &grid, wet),
            ];
            assert!(found.iter().all(|&loads| loads == is_in), "{i} {beyond}: {found:?}");
        }
    }
}
