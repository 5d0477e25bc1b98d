//! Direct simulation between a floor and a lid: ducts, drops at rest, the entry of a throat, and the plane as the depth grows.

use std::collections::BTreeMap;
use std::path::Path;

use meniscus::case::load;
use meniscus::input::Overrides;
use meniscus::interface::depth::{Depth, duct_factor};
use meniscus::run::setup;
use meniscus::solver::{Series, Solver};

use crate::support::flow::solver;

/// The measures of a case of `cases/` with changes, at `end` (s).
fn at_the_end(name: &str, set: &[&str], end: f64) -> BTreeMap<String, f64> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/{name}.toml"));
    let case = load(&path, &Overrides::parse(set).unwrap()).unwrap_or_else(|error| panic!("{}", error.render()));
    let mut solver = setup::build(&case.case).unwrap();
    while solver.time() < end {
        solver.step(end).unwrap();
    }
    solver.measures(&Series::default()).into_iter().map(|measure| (measure.name, measure.value)).collect()
}

/// A duct 1 mm wide of a fluid with the kinematic viscosity 1e-6 m2/s; `depth` is a line of `[geometry]`.
fn duct(depth: &str, step: &str) -> String {
    format!(
        "format = 1\ntitle = \"A duct\"\n[geometry]\nmin = [0.0, 0.0]\nmax = [5.0e-4, 1.0e-3]\n{depth}\n[sph]\nspacing = 5.0e-5\n\
         gravity = [0.01, 0.0]\nnumerics.viscous-step = \"{step}\"\nsides = {{ left = \"periodic\", right = \"periodic\" }}\n[time]\nend = 1.0\n\
         [sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n"
    )
}

/// The mean velocity in m/s of a duct once it is steady.
fn mean_velocity(case: &str, end: f64) -> f64 {
    let mut solver = solver(case);
    while solver.time() < end {
        solver.step(end).unwrap();
    }
    let p = &solver.flow.state.particles;
    p.velocity[..p.fluids].iter().map(|v| v.x).sum::<f64>() / p.fluids as f64
}

#[test]
fn ducts_have_their_flow() {
    for ratio in [0.25, 1.0, 3.0] {
        let depth = 1e-3 / ratio;
        let found = mean_velocity(&duct(&format!("depth = {depth:e}"), "implicit"), 1.0);
        let exact = 0.01 * 1000.0 / 1e-3 * depth * depth / 12.0 * duct_factor(ratio);
        // At 20 spacings the plane flow is as far off.
        assert!((found / exact - 1.0).abs() < 0.01, "{ratio}: {}", found / exact);
    }
}

#[test]
fn friction_of_floor_and_lid_does_not_depend_on_the_step_and_vanishes_in_a_deep_chip() {
    let [implicit, explicit] = ["implicit", "explicit"].map(|step| mean_velocity(&duct("depth = 1.0e-3", step), 0.5));
    assert!((implicit / explicit - 1.0).abs() < 1e-3, "{implicit} {explicit}");
    let [deep, plane] = ["depth = 1.0", ""].map(|depth| mean_velocity(&duct(depth, "implicit"), 1.0));
    assert!((deep / plane - 1.0).abs() < 1e-3, "{deep} {plane}");
}

#[test]
fn a_flat_drop_has_the_pressure_of_both_curvatures() {
    // The measure compares with them; a drop of the phase that does not wet floor and lid.
    for (angle, depth) in [(120.0, 2e-4), (150.0, 1e-4)] {
        let model = format!("sph.wetting.young.contact-angle-deg={angle}");
        let depth = format!("geometry.depth={depth:e}");
        let found = at_the_end("laplace-drop", &[&model, &depth, "sph.spacing=4.0e-5"], 5e-3)["laplace-jump-ratio"];
        assert!((found - 1.0).abs() < 0.01, "{angle}: {found}");
    }
}

#[test]
fn a_throat_is_entered_at_the_pressure_of_the_chip() {
    for angle in [30.0, 60.0] {
        let model = format!("sph.wetting.young.contact-angle-deg={angle}");
        let set = [model.as_str(), "geometry.depth=5.0e-4", "sph.spacing=6.25e-5"];
        let found = at_the_end("throat-entry", &set, 0.02);
        assert!((found["entry-pressure-ratio"] - 1.0).abs() < 0.03, "{angle}: {}", found["entry-pressure-ratio"]);
        let transverse = Depth::new(5e-4, f64::to_radians(angle), [f64::to_radians(angle); 2]).curvature(0.0);
        assert!(found["entry-pressure-Pa"] > 0.025 * transverse);
    }
}
