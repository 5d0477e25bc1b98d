//! Relative permeability beside a frozen interface: against exact flows, and what it must not depend on.

use std::path::Path;

use meniscus_core::math::Vec2;
use meniscus_core::solver::Solver;
use meniscus_geometry::interface::depth::{duct_factor, profile_factor};
use meniscus_sph::particles::Phase;

use crate::support::flow::solver;
use crate::support::program::{assert_code, meniscus, report};

/// Measures by name of a shipped case with `overrides`.
fn measures_of(case: &str, overrides: &[&str]) -> impl Fn(&str) -> f64 + use<> {
    let folder = tempfile::tempdir().unwrap();
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(case);
    let mut arguments = vec!["run", case.to_str().unwrap(), "--out", "out", "--threads", "1", "--set", "expect=[]"];
    arguments.extend(overrides.iter().flat_map(|config| ["--set", config]));
    assert_code(&meniscus(folder.path(), &arguments), 0);
    let report = report(&folder.path().join("out"));
    move |measure| report["measures"][measure]["value"].as_f64().unwrap_or_else(|| panic!("no {measure} in {report:#}"))
}

fn measures(overrides: &[&str]) -> impl Fn(&str) -> f64 + use<> {
    measures_of("relative-permeability.toml", overrides)
}

/// Eight and twelve particles across the layers.
const COARSE: [&str; 3] = ["sph.spacing=5.0e-5", "geometry.max=[1.0e-3, 1.0e-3]", WIDE];
const WIDE: &str = "sph.initial.wetting=[{ rectangle = { center = [5.0e-4, 2.0e-4], size = [1.0e-3, 4.0e-4] } }]";

/// Plane Poiseuille flow in each layer: the cube of its share of the gap, and a twelfth of the square of the gap for the whole.
#[test]
fn layers_between_plates_have_the_cubes_of_their_shares() {
    let found = measures(&COARSE);
    // The error falls with the square of the particles across: 8, 12 and 20.
    for (name, exact, tolerance) in [
        ("permeability-m2", 1e-6 / 12.0, 0.015),
        ("relative-permeability-wetting", 0.064, 0.05),
        ("relative-permeability-non-wetting", 0.216, 0.026),
    ] {
        assert!((found(name) / exact - 1.0).abs() < tolerance, "{name}: {}, not {exact}", found(name));
    }
    assert!((found("saturation") - 0.4).abs() < 1e-12, "{}", found("saturation"));
    assert!(found("unsteady-share") < 1e-3, "{}", found("unsteady-share"));
}

/// The depth-averaged flow of a duct of the width `ratio` b by the factor `profile` of the profile over the depth, over b²/12.
fn averaged(ratio: f64, profile: f64) -> f64 {
    let z = ratio * (3.0 / profile).sqrt();
    1.0 - z.tanh() / z
}

/// Ducts: there are no throats, so that the profile is that of a duct as wide as the whole gap.
#[test]
fn layers_in_a_chip_have_the_relative_permeability_of_ducts() {
    for depth in [2e-4, 1e-3] {
        let found = measures(&[&COARSE[..], &[&format!("geometry.depth={depth:e}")]].concat());
        let ratio = 1e-3 / depth;
        let profile = profile_factor(ratio);
        let layer = |share: f64| share * averaged(share * ratio, profile) / averaged(ratio, profile);
        for (name, exact, tolerance) in [
            ("permeability-m2", depth * depth / 12.0 * duct_factor(ratio), 0.025),
            ("relative-permeability-wetting", layer(0.4), 0.05),
            ("relative-permeability-non-wetting", layer(0.6), 0.024),
        ] {
            assert!((found(name) / exact - 1.0).abs() < tolerance, "{depth} {name}: {}, not {exact}", found(name));
        }
    }
}

/// Exact by postprocess/stokes_permeability.py at `--across 10`. Eight spacings between disc and drop leave 4.5 % (docs/validation/viscous-flow.md).
#[test]
fn trapped_drops_hold_the_flow_back_as_solids_do_and_carry_nothing() {
    let found = measures_of("relative-permeability-array.toml", &[]);
    let (k, other) = (found("permeability-m2"), found("relative-permeability-non-wetting"));
    assert!((k / 3.1838e-9 - 1.0).abs() < 0.02, "{k}");
    assert!((other / 0.12225 - 1.0).abs() < 0.055, "{other}");
    assert!(found("relative-permeability-wetting").abs() < 1e-3, "{}", found("relative-permeability-wetting"));
}

/// A cap on the floor of a channel: particles that follow its interface hold the flow as well as those that follow the surface of a solid.
#[test]
fn a_cap_on_a_wall_holds_the_flow_back_as_a_solid_one_does() {
    const CAP: &str = "disc = { center = [5.0e-4, -1.0e-4], radius = 3.0e-4 }";
    let wetting = format!("sph.initial.wetting=[{{ {CAP} }}]");
    let channel = ["geometry.max=[1.0e-3, 5.0e-4]", "sph.spacing=2.0e-5", "sph.gravity=[0.1, 0.0]"];
    let beside = measures(&[&channel[..], &[&wetting, "time.end=0.09"]].concat());
    let solid = format!("geometry.shapes=[{{ {CAP} }}]");
    let walls = ["sph.sides.bottom=\"wall\"", "sph.sides.top=\"wall\"", "time.end=0.03"];
    let past = measures_of("permeability-tensor.toml", &[&channel[..], &walls, &[&solid]].concat());
    let ratio = beside("permeability-m2") * beside("relative-permeability-non-wetting") / past("permeability-xx-m2");
    assert!((ratio - 1.0).abs() < 2e-3, "{ratio}");
}

/// A slow flow has the same permeability with any fluid, and the interface does not move.
#[test]
fn neither_the_other_fluid_nor_its_tension_or_angle_changes_a_bit() {
    for depth in [&[][..], &["geometry.depth=2e-4"]] {
        no_fluid_changes_a_bit(depth);
    }
}

fn no_fluid_changes_a_bit(depth: &[&str]) {
    let short = [&["time.end=3.0e-3"], depth].concat();
    let found = measures(&[&COARSE[..], &short].concat());
    let other = [
        "sph.phases.non-wetting={ density = 1.2, viscosity = 1.8e-5 }",
        "sph.interface.tension=0.07",
        "sph.wetting.young.contact-angle-deg=30.0",
    ];
    let of_other = measures(&[&COARSE[..], &short, &other].concat());
    for name in ["permeability-m2", "relative-permeability-wetting", "relative-permeability-non-wetting"] {
        assert_eq!(found(name), of_other(name), "{name}");
    }
}

/// A solid disc in a periodic cell and a drop beside it, which reaches over the corner of the cell.
const DROP: &str = r#"
format = 1
title = "a drop over the corner of a cell"
[geometry]
min = [0.0, 0.0]
max = [4.0e-4, 4.0e-4]
shapes = [{ disc = { center = [2.0e-4, 2.0e-4], radius = 1.0e-4 } }]
[sph]
spacing = 2.0e-5
gravity = [1.0, 0.0]
[sph.phases.wetting]
density = 1000.0
viscosity = 0.01
[sph.phases.non-wetting]
density = 1000.0
viscosity = 0.01
[sph.interface]
tension = 0.01
[sph.sides]
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
[[sph.initial.wetting]]
disc = { center = [0.0, 0.0], radius = 1.0e-4 }
[sph.measure.relative-permeability]
[time]
end = 1.5e-3
"#;

fn run_to(solver: &mut dyn Solver, until: f64) {
    while solver.time() < until {
        solver.step(until).unwrap();
    }
}

#[test]
fn each_phase_flows_with_the_other_one_as_a_wall() {
    let mut solver = solver(DROP);
    let count = |solver: &meniscus_sph::solver::SphSolver, phase: Phase| {
        solver.flow.state.particles.phase.iter().filter(|own| **own == phase).count()
    };
    let area = |phase| count(&solver, phase) as f64 * 4.0e-10;
    let disc = std::f64::consts::PI * 1e-8;
    assert!((area(Phase::Wetting) / disc - 1.0).abs() < 0.03, "{}", area(Phase::Wetting));
    assert!((area(Phase::NonWetting) / (16e-8 - 2.0 * disc) - 1.0).abs() < 0.03, "{}", area(Phase::NonWetting));
    let wetting = count(&solver, Phase::Wetting);
    run_to(&mut solver, 5.0e-4);
    solver.step(6.0e-4).unwrap();
    // The drop alone, over all four corners; outside of it there is solid.
    assert_eq!((count(&solver, Phase::Wetting), count(&solver, Phase::NonWetting)), (wetting, 0));
    let wall = &solver.flow.config.wall;
    for (x, distance) in [([0.0, 3.5e-4], 5.0e-5), ([3.2e-4, 0.0], 2.0e-5), ([1.5e-4, 0.0], -5.0e-5)] {
        let (found, normal) = wall(Vec2::from(x));
        assert!((found - distance).abs() < 1e-12, "{x:?}: {found}");
        assert!((normal.norm() - 1.0).abs() < 1e-12);
    }
    // Around it: drop and disc are solid.
    run_to(&mut solver, 1.0e-3);
    solver.step(1.1e-3).unwrap();
    assert_eq!(count(&solver, Phase::Wetting), 0);
    let wall = &solver.flow.config.wall;
    for (x, distance) in [([0.0, 3.5e-4], -5.0e-5), ([2.0e-4, 3.2e-4], 2.0e-5), ([1.5e-4, 0.0], 5.0e-5)] {
        assert!((wall(Vec2::from(x)).0 - distance).abs() < 1e-12, "{x:?}: {}", wall(Vec2::from(x)).0);
    }
    let p = &solver.flow.state.particles;
    assert!(p.velocity[p.fluids..].iter().all(|v| *v == Vec2::zeros()));
    assert!(p.velocity[0].norm() > 0.0);
}

#[test]
fn a_run_resumed_in_any_of_its_flows_takes_the_same_steps() {
    for resumed_at in [2.0e-4, 5.0e-4, 8.0e-4, 1.2e-3] {
        let (mut whole, mut first, mut second) = (solver(DROP), solver(DROP), solver(DROP));
        run_to(&mut first, resumed_at);
        run_to(&mut whole, resumed_at);
        second.restore(&first.state()).unwrap();
        run_to(&mut whole, 1.5e-3);
        run_to(&mut second, 1.5e-3);
        assert_eq!(whole.flow.state, second.flow.state, "resumed at {resumed_at} s");
    }
}
