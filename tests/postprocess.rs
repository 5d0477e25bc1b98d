//! The scripts in `postprocess`: on a small folder that they make themselves, and on fresh output of the binary.

mod support;

use std::path::{Path, PathBuf};
use std::process::Command;

use support::python::{interpreter, root, run};

/// A drop on a floor, coarse and short: enough for every kind of file.
const CASE: &str = r#"
format = 1
title = "A small drop for the checks of the scripts"

[geometry]
min = [0.0, 0.0]        # m
max = [1.0e-3, 6.0e-4]  # m

[sph]
spacing = 4.0e-5        # m

[sph.phases.wetting]
density = 800.0         # kg/m3
viscosity = 8.0e-3      # Pa s

[sph.phases.non-wetting]
density = 800.0         # kg/m3
viscosity = 8.0e-3      # Pa s

[sph.interface]
tension = 0.02          # N/m

[sph.surface-force.csf]

[sph.wetting.young]
contact-angle-deg = 60.0

[sph.sides]
left = "periodic"
right = "periodic"
bottom = "wall"
top = "wall"

[[sph.initial.wetting]]
disc = { center = [5.0e-4, 0.0], radius = 2.8e-4 }

[time]
end = 2.0e-4            # s

[output.vtk]
every-time = 1.0e-4     # s
"#;

/// Runs the binary on [`CASE`] and returns the output folder.
fn fresh_output(directory: &Path) -> PathBuf {
    let case = directory.join("small-drop.toml");
    std::fs::write(&case, CASE).expect("the case can be written");
    let out = directory.join("out");
    let mut command = Command::new(env!("CARGO_BIN_EXE_meniscus"));
    command.arg("run").arg(&case).arg("--out").arg(&out);
    run(&mut command, "the small case must run");
    out
}

fn script(name: &str) -> Command {
    let mut command = Command::new(interpreter());
    command.arg(root().join("postprocess").join(name));
    command
}

#[test]
fn the_scripts_pass_their_own_tests() {
    let mut command = Command::new(interpreter());
    command.args(["-m", "unittest", "discover", "-s"]).arg(root().join("postprocess/tests"));
    run(&mut command, "the tests of the scripts must pass");
}

#[test]
fn fresh_output_keeps_the_contract_and_is_drawn() {
    let directory = tempfile::tempdir().expect("a temporary folder");
    let out = fresh_output(directory.path());
    run(script("check_output.py").arg(&out), "the output must keep the contract");
    for (name, option, file) in [
        ("field_picture.py", "--picture", "field.png"),
        ("angle_and_saturation.py", "--picture", "angle.png"),
        ("movie.py", "--movie", "movie.gif"),
    ] {
        let target = directory.path().join(file);
        run(script(name).arg(&out).arg(option).arg(&target), "the figure must be drawn");
        assert!(target.metadata().is_ok_and(|m| m.len() > 2000), "{file} is empty");
    }
}

#[test]
fn a_fresh_thin_film_keeps_the_contract_and_is_drawn() {
    let directory = tempfile::tempdir().expect("a temporary folder");
    let out = directory.path().join("out");
    let mut command = Command::new(env!("CARGO_BIN_EXE_meniscus"));
    command.arg("run").arg(root().join("cases/thin-film/partial-wetting.toml")).arg("--out").arg(&out);
    command.args(["--set", "time.end=0.1", "--set", "expect=[]"]);
    run(&mut command, "the film must run");
    run(script("check_output.py").arg(&out), "the output must keep the contract");
    let picture = directory.path().join("film.png");
    run(script("film_profiles.py").arg(&out).arg("--picture").arg(&picture), "the figure must be drawn");
    assert!(picture.metadata().is_ok_and(|m| m.len() > 2000), "the figure is empty");
}
