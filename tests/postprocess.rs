//! The scripts in `postprocess`: on a small folder that they make themselves, and on fresh output of the binary.

#[path = "support/program.rs"]
mod program;
mod support;

use std::process::Command;

use program::{folder_with_small_case, meniscus};
use support::python::{interpreter, network_interpreter, root, run};

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
fn openpnm_and_porespy_find_the_network_of_the_reference_pack() {
    let mut command = Command::new(network_interpreter());
    command.args(["-m", "unittest", "discover", "-s"]).arg(root().join("postprocess/tests/network"));
    run(&mut command, "the tests of the scripts for networks must pass");
}

#[test]
fn fresh_output_keeps_the_contract_and_is_drawn() {
    let directory = folder_with_small_case();
    program::assert_code(&meniscus(directory.path(), &["run", "drop.toml", "--out", "out"]), 0);
    let out = directory.path().join("out");
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
