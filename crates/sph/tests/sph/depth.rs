//! Direct simulation between a floor and a lid: ducts, drops at rest, the entry of a throat, and the plane as the depth grows.

use std::collections::BTreeMap;
use std::path::Path;

use meniscus::run::setup;
use meniscus_case::load;
use meniscus_core::input::Overrides;
use meniscus_core::solver::{Series, Solver};
use meniscus_geometry::interface::depth::{Depth, duct_factor};
use meniscus_sph::particles::{Particles, Phase};

use crate::support::flow::solver;

/// The measures of a case of `cases/` with changes, at `end` (s).
fn at_the_end(name: &str, set: &[&str], end: f64) -> BTreeMap<String, f64> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../cases/{name}.toml"));
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

/// [GondretRabaud1997]
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
        assert!((found - 1.0).abs() < 5e-4, "{angle}: {found}");
    }
}

/// [ParkHomsy1984]
#[test]
fn a_flat_bubble_has_the_pressure_of_the_exact_surface_of_revolution() {
    // Radii of the contact line of 2 and 10 depths, as in studies/validation/flat-bubble.toml. The formula is made for flat bubbles.
    for (angle, depth, exact, tolerance) in [(30.0, 1.816412e-4, 233.471, 2.3e-3), (60.0, 3.964123e-5, 552.356, 3e-4)] {
        let (model, depth) =
            (format!("sph.wetting.young.contact-angle-deg={angle}"), format!("geometry.depth={depth:e}"));
        let found = at_the_end("flat-bubble", &[&model, &depth], 2e-3)["capillary-pressure-Pa"];
        assert!((found / exact - 1.0).abs() < tolerance, "{angle}: {found}");
    }
}

#[test]
fn a_throat_is_entered_at_the_pressure_of_the_chip() {
    // Where the meniscus has its largest pressure, as in studies/validation/throat-entry-depth.toml.
    for (angle, place) in [(30.0, 1.228697e-3), (60.0, 1.359524e-3), (90.0, 1.694152e-3)] {
        let model = format!("sph.wetting.young.contact-angle-deg={angle}");
        let start = format!("sph.initial.wetting[0].rectangle.center=[{place:e}, 0.0]");
        let set = [model.as_str(), &start, "geometry.depth=5.0e-4", "sph.spacing=6.25e-5"];
        let found = at_the_end("throat-entry", &set, 0.02);
        assert!((found["entry-pressure-ratio"] - 1.0).abs() < 1e-3, "{angle}: {}", found["entry-pressure-ratio"]);
        let transverse = Depth::new(5e-4, f64::to_radians(angle), [f64::to_radians(angle); 2]).curvature(0.0);
        assert!(found["entry-pressure-Pa"] > 0.025 * transverse);
    }
}

/// Slope and value at 0 of the line through points.
fn line(points: &[(f64, f64)]) -> [f64; 2] {
    let n = points.len() as f64;
    let [x, y] = [points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n];
    let [xx, xy] = points.iter().fold([0.0; 2], |[xx, xy], p| [xx + (p.0 - x).powi(2), xy + (p.0 - x) * (p.1 - y)]);
    [xy / xx, y - xy / xx * x]
}

/// Slopes of the pressure in Pa/m on both sides of the meniscus of a duct 0.2 mm by 1.2 mm, and its jump in Pa.
fn pressures(particles: &Particles) -> [f64; 3] {
    let (width, length) = (2.0e-4, 1.2e-3);
    let phase = &particles.phase[..particles.fluids];
    let meniscus = length * phase.iter().filter(|phase| **phase == Phase::Wetting).count() as f64 / phase.len() as f64;
    let [left, right] = [Phase::Wetting, Phase::NonWetting].map(|side| {
        let inside = |a: &usize| {
            let x = particles.position[*a].x;
            phase[*a] == side && (x - meniscus).abs() > width && x > width && x < length - width
        };
        let at = |a: usize| (particles.position[a].x - meniscus, particles.pressure[a]);
        line(&(0..phase.len()).filter(inside).map(at).collect::<Vec<_>>())
    });
    [left[0], right[0], right[1] - left[1]]
}

#[test]
fn a_driven_meniscus_adds_both_curvatures_to_the_friction_of_both_fluids() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/duct-meniscus.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let (width, depth, tension, speed) = (2.0e-4, 1.0e-4, 0.03, 6.0e-3);
    for thinner in [5.0e-3, 1.0e-3] {
        let (before, after) = text.split_at(text.find("[sph.phases.non-wetting]").unwrap());
        let after = after.replace("viscosity = 5.0e-3", &format!("viscosity = {thinner:e}"));
        let mut solver = solver(&format!("{before}{after}"));
        let mut found = Vec::new();
        while solver.time() < 0.012 {
            solver.step(0.012).unwrap();
            if solver.time() > 0.003 {
                found.push(pressures(&solver.flow.state.particles));
            }
        }
        let mean = |i: usize| found.iter().map(|pressures| pressures[i]).sum::<f64>() / found.len() as f64;
        let friction = |viscosity: f64| -12.0 * viscosity * speed / (depth * depth * duct_factor(width / depth));
        for (i, viscosity) in [5.0e-3, thinner].into_iter().enumerate() {
            // The flow swings, and its inertia is the same in both fluids.
            let error = (mean(i) - friction(viscosity)) / friction(5.0e-3);
            assert!(error.abs() < 0.05, "{thinner} {i}: {error}");
        }
        let exact = tension * 2.0 * f64::to_radians(60.0).cos() * (1.0 / width + 1.0 / depth);
        assert!((mean(2) / exact - 1.0).abs() < 0.01, "{thinner}: {}", mean(2) / exact);
    }
}
