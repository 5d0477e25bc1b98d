//! Cases of thin films: all methods agree, resumed runs give the same bits, scaled and SI units too; known laws are measured.

use std::path::{Path, PathBuf};

use crate::support::{advance, loaded, named};
use meniscus::run::setup;
use meniscus_case::load;
use meniscus_core::input::Overrides;
use meniscus_core::solver::Series;

fn near(found: f64, known: f64, tolerance: f64) {
    assert!((found - known).abs() < tolerance, "found {found}, known {known}");
}

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/thin-film");
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

#[test]
fn the_cases_load_and_their_resolved_form_is_the_same_case() {
    for path in cases() {
        let first = loaded(&path, &[]);
        let folder = tempfile::tempdir().unwrap();
        let copy = folder.path().join("case.toml");
        std::fs::write(&copy, &first.resolved).unwrap();
        assert_eq!(loaded(&copy, &[]).resolved, first.resolved);
        assert!(std::fs::read_to_string(&path).unwrap().lines().count() <= 60);
    }
}

#[test]
fn a_film_of_a_tiny_angle_spreads_from_its_first_steps_on_and_its_early_end_is_told() {
    let wide = [
        "geometry={ min = [-1.0e-2, 0.0], max = [1.0e-2, 2.0e-4] }",
        "thin-film.wetting.partial.contact-angle-deg=0.1",
        "thin-film.spacing=1e-5",
        "time.end=1.0",
    ];
    let case = loaded(&named("partial-wetting"), &wide).case;
    let mut solver = setup::build(&case).unwrap();
    advance(solver.as_mut(), &[1.0]);
    // With steps of 1/200 of the time and a spacing of half the size: 1.2746 mm.
    let found = solver.sample().into_iter().find(|sample| sample.name == "contact_line_position_m").unwrap();
    near(found.value, 1.2746e-3, 1.0e-5);
    let notes = setup::warnings(&case, solver.as_ref(), &Series::default());
    assert!(notes.iter().any(|note| note.contains("comes to its contact angle")), "{notes:?}");
}

/// Overrides for each method and option.
const VARIANTS: [&[&str]; 4] = [
    &["thin-film.method={ particles = {} }", "thin-film.spacing=5e-6"],
    &["thin-film.method={ particles = { integrator = \"explicit\" } }", "thin-film.spacing=1e-5"],
    &["thin-film.method={ particles = { lattice-energy = \"taken-off\" } }", "thin-film.spacing=5e-6"],
    &["thin-film.method={ finite-differences = {} }", "thin-film.spacing=1e-5"],
];

#[test]
fn a_film_taken_up_from_a_saved_state_goes_on_with_the_same_bits() {
    let varied = ["complete-wetting", "partial-wetting"].map(named);
    for path in cases() {
        let variants: &[&[&str]] = if varied.contains(&path) { &VARIANTS } else { &[&[]] };
        for variant in variants {
            let case = loaded(&path, variant).case;
            let stops = [1.0e-3, 2.0e-3, 2.0e-2].map(|share| share * case.end);
            let mut unbroken = setup::build(&case).unwrap();
            advance(unbroken.as_mut(), &stops);
            for steps in [1, 7, 20] {
                let mut broken = setup::build(&case).unwrap();
                while broken.steps() < steps {
                    let stop = *stops.iter().find(|&&stop| stop > broken.time()).unwrap();
                    broken.step(stop).unwrap();
                }
                let mut resumed = setup::build(&case).unwrap();
                resumed.restore(&broken.state()).unwrap();
                let rest: Vec<f64> = stops.into_iter().filter(|&stop| stop > resumed.time()).collect();
                advance(resumed.as_mut(), &rest);
                assert!(resumed.state() == unbroken.state(), "{variant:?} after {steps} steps");
            }
            assert!(setup::build(&case).unwrap().restore(b"no state").is_err());
        }
    }
}

#[test]
fn the_methods_agree_on_a_droplet_that_spreads() {
    let path = &named("complete-wetting");
    let mut found = Vec::new();
    for variant in [VARIANTS[2], VARIANTS[3]] {
        let case = loaded(path, variant).case;
        let mut solver = setup::build(&case).unwrap();
        advance(solver.as_mut(), &[1.0, 20.0]);
        let measures = solver.measures(&Series::default());
        let value = |name: &str| measures.iter().find(|measure| measure.name == name).unwrap().value;
        found.push((value("contact-line-position"), value("center-height")));
        // Output that is not finite would spoil the files.
        let sample = solver.sample();
        assert!(sample.iter().all(|s| s.value.is_finite() || s.name == "last_particle_position_m"), "{sample:?}");
        assert_eq!(solver.snapshot().particles.points.len(), solver.statistics().unknowns);
    }
    let [(foot, height), (foot_on_grid, height_on_grid)] = found[..] else { panic!() };
    // Steps of half a percent of the time, of order 1, are the larger error.
    assert!((foot / foot_on_grid - 1.0).abs() < 7.0e-4, "{foot} {foot_on_grid}");
    assert!((height / height_on_grid - 1.0).abs() < 3.0e-4, "{height} {height_on_grid}");
}

#[test]
fn direct_and_recursive_sums_move_particles_alike() {
    let places = |sums: &str| {
        let method = format!("thin-film.method={{ particles = {{ integrator = \"explicit\", sums = \"{sums}\" }} }}");
        let case = loaded(&named("partial-wetting"), &[&method, "thin-film.spacing=2.5e-5"]).case;
        let mut solver = setup::build(&case).unwrap();
        advance(solver.as_mut(), &[1.0e-2]);
        solver.snapshot().particles.points.iter().map(|point| point.x).collect::<Vec<f64>>()
    };
    let (direct, recursive) = (places("direct"), places("recursive"));
    let off = direct.iter().zip(&recursive).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // Sums agree to rounding, but explicit steps at their bound of stability are refused by a hair: the places agree as well as
    // a step, to 1e-7 of a millimeter.
    assert!(direct != recursive && off < 1.0e-10, "{off}");
}

#[test]
fn a_run_keeps_what_its_diagrams_show() {
    let names = |case: &str, set: &[&str], end: f64| {
        let mut solver = setup::build(&loaded(&named(case), set).case).unwrap();
        advance(solver.as_mut(), &[end]);
        let diagrams = solver.diagrams();
        for diagram in &diagrams {
            let svg = meniscus_output::diagram::svg(diagram).unwrap().unwrap();
            // A page shows six of them for each run.
            assert!(!svg.contains("NaN") && svg.len() < 1_000_000, "{case} {}: {}", diagram.name, svg.len());
        }
        diagrams.iter().map(|diagram| diagram.name).collect::<Vec<_>>()
    };
    let spreading = names("complete-wetting", &["thin-film.spacing=5e-6"], 5.0);
    assert_eq!(spreading, ["space-time", "trajectories", "contact-line", "similarity"]);
    let resting = names("partial-wetting", &["thin-film.spacing=1e-5"], 5.0);
    assert_eq!(resting, ["space-time", "contact-line", "rest", "cox-voinov"]);
    assert_eq!(names("axisymmetric", &[], 1.0), ["space-time", "contact-line"]);
}

fn measures_of(case: &meniscus_case::Case, stops: &[f64]) -> impl Fn(&str) -> f64 + use<> {
    let mut solver = setup::build(case).unwrap();
    advance(solver.as_mut(), stops);
    let measures = solver.measures(&Series::default());
    move |name| measures.iter().find(|measure| measure.name == name).unwrap_or_else(|| panic!("no {name}")).value
}

#[test]
fn a_spreading_droplet_has_the_self_similar_shape_and_tanner_s_exponent() {
    let set = ["thin-film.spacing=2.5e-6", "thin-film.method={ particles = { lattice-energy = \"taken-off\" } }"];
    let value = measures_of(&loaded(&named("complete-wetting"), &set).case, &[1.0, 50.0]);
    // Known from another program at this spacing.
    near(value("similarity-curvature"), -1.2416, 3.0e-4);
    assert!(value("similarity-error") < 1.0e-3, "{}", value("similarity-error"));
    near(value("last-particle-exponent"), 0.1412, 2.0e-4);
    near(value("contact-line-exponent"), 0.1290, 2.0e-4);
}

#[test]
fn a_droplet_on_its_way_to_rest_keeps_the_law_of_cox_and_voinov() {
    let set = ["thin-film.spacing=2.5e-6", "thin-film.method={ particles = { lattice-energy = \"taken-off\" } }"];
    let value = measures_of(&loaded(&named("partial-wetting"), &set).case, &[2.0]);
    // 2.953/3 and 0.404 mm in the same window by another program, with other records in it.
    near(value("cox-voinov-ratio"), 0.984, 0.022);
    near(value("cox-voinov-length-m"), 4.04e-4, 6.0e-6);
}

#[test]
fn scaled_and_si_units_give_the_same_droplet() {
    let path = &named("partial-wetting");
    let si = measures_of(&loaded(path, &[]).case, &[1.0]);
    let text = std::fs::read_to_string(path).unwrap();
    let kept = |line: &&str| !line.starts_with("tension") && !line.starts_with("fluid");
    let lines: Vec<&str> = text.lines().filter(kept).collect();
    let folder = tempfile::tempdir().unwrap();
    let copy = folder.path().join("scaled.toml");
    std::fs::write(&copy, lines.join("\n")).unwrap();
    let set = [
        "geometry.min=[-2.0, 0.0]",
        "geometry.max=[2.0, 2.0]",
        "thin-film.spacing=5e-3",
        "thin-film.equation.geometric.smoothing-length=0.05",
        "thin-film.droplets=[{ half-width = 0.5, height = 1.5 }]",
        "thin-film.wetting.partial.contact-angle-deg=45.0",
    ];
    let scaled = measures_of(&loaded(&copy, &set).case, &[1.0]);
    // Millimeters and tenths of them; rounding of the units is all that differs.
    near(si("contact-line-position") / 1.0e-3, scaled("contact-line-position"), 1.0e-9);
    near(si("center-height") / 1.0e-4, scaled("center-height"), 1.0e-9);
}

#[test]
fn equal_droplets_rest_side_by_side_at_their_angle_and_near_ones_become_one() {
    let two = |apart: f64| {
        let droplet = |center: f64| format!("{{ center = {center:e}, half-width = 4e-4, height = 9e-5 }}");
        let droplets = format!("thin-film.droplets=[{}, {}]", droplet(-apart), droplet(apart));
        let wide = ["geometry.min=[-3.0e-3, 0.0]", "geometry.max=[3.0e-3, 1.0e-4]", droplets.as_str(), "expect=[]"];
        measures_of(&loaded(&named("partial-wetting"), &wide).case, &[300.0])
    };
    let apart = two(1.4e-3);
    assert_eq!(apart("droplet-count"), 2.0);
    near(apart("contact-angle-ratio"), 1.0, 3.0e-4);
    // Feet reach out by 0.72 mm: droplets of half the area of the paper's.
    let near_by = two(5.0e-4);
    assert_eq!(near_by("droplet-count"), 1.0);
}

const CASES_AND_METHODS: [(&str, &str); 4] = [
    ("complete-wetting", "particles"),
    ("partial-wetting", "particles"),
    ("complete-wetting", "finite-differences"),
    ("partial-wetting", "finite-differences"),
];

#[test]
fn any_filter_and_number_of_nodes_runs_or_is_refused_with_a_reason() {
    let (mut ran, mut refused) = (0, 0);
    for alpha in [0.2, 0.1, 0.05, 0.02, 0.01, 0.005] {
        for count in [50, 400, 5000, 50_000] {
            for (case, method) in CASES_AND_METHODS {
                let fine = method == "finite-differences";
                let spacing = format!("thin-film.spacing={:e}", 1.0e-3 / f64::from(count));
                let length = format!("thin-film.equation.geometric.smoothing-length={:e}", 1.0e-3 * alpha);
                let method = format!("thin-film.method={{ {method} = {{}} }}");
                let overrides = Overrides::parse(&[spacing, length, method]).unwrap();
                let Ok(loaded) = load(&named(case), &overrides) else {
                    refused += 1;
                    // Coarser than the filter, for particles than half of it, or too fine for fourth differences.
                    let resolution = alpha * f64::from(count);
                    let coarsest = if fine { 1.0 } else { 2.0 };
                    assert!(resolution < coarsest || (resolution > 999.9 && fine), "{alpha} {count}");
                    continue;
                };
                let mut solver = setup::build(&loaded.case).unwrap();
                let steps = if count > 1000 { 3 } else { 30 };
                for _ in 0..steps {
                    solver.step(loaded.case.end).unwrap_or_else(|error| panic!("{alpha} {count}: {error}"));
                }
                ran += 1;
            }
        }
    }
    assert!(ran > 60 && refused > 8, "{ran} {refused}");
}

#[test]
fn steps_on_a_grid_are_counted_ahead() {
    let case = loaded(&named("partial-wetting"), &[]).case;
    let mut solver = setup::build(&case).unwrap();
    let ahead = solver.steps_to(case.end).unwrap();
    advance(solver.as_mut(), &[case.end]);
    // Landing at the end splits a step.
    near(solver.steps() as f64, ahead, 2.0);
}
