//! The scripts in `postprocess`: on a small folder that they make themselves, and on fresh output of the binary.

mod support;

use std::path::Path;
use std::process::Command;

use support::browser::browser;
use support::program::{assert_code, folder_with_small_case, meniscus};
use support::python::{browser_interpreter, interpreter, root, run};

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
fn the_tables_of_the_validation_pages_are_those_of_stored_results_of_the_present_files() {
    run(
        script("gallery.py").args(["write", "--check"]),
        "no number is edited by hand, and no result is of another case",
    );
}

/// The cheapest run of each study of the documentation whose run takes less than two seconds of processor time.
#[test]
fn the_program_gives_the_stored_results_of_cheap_studies() {
    check_of_stored_results(&["--limit", "2"]);
}

#[test]
#[ignore = "takes minutes: cargo test --release --test postprocess -- --ignored"]
fn the_program_gives_the_stored_results_of_all_studies() {
    check_of_stored_results(&[]);
}

fn check_of_stored_results(more: &[&str]) {
    let mut command = script("gallery.py");
    command.args(["check", "--program", env!("CARGO_BIN_EXE_meniscus")]).args(more);
    println!("{}", run(&mut command, "every measure must be the stored one within its tolerance"));
}

#[test]
fn openpnm_and_porespy_find_the_network_of_the_reference_pack() {
    let mut command = Command::new(interpreter());
    command.args(["-m", "unittest", "discover", "-s"]).arg(root().join("postprocess/tests/network"));
    run(&mut command, "the tests of the scripts for networks must pass");
}

/// Runs of the calibration in docs/numerics/error-bars.md, by another seed than that of its constants: at rest and moving, with and without a depth.
#[test]
fn eight_runs_of_the_calibration_lie_within_two_bars() {
    let (directory, seed) =
        (tempfile::tempdir().unwrap(), std::env::var("MENISCUS_SEED").unwrap_or_else(|_| "6".into()));
    let mut command = script("error_bars.py");
    command.args(["--drawn", &seed, "--runs", "8", "--program", env!("CARGO_BIN_EXE_meniscus"), "--out"]);
    let printed = run(command.arg(directory.path()), "two bars must cover 90 of 100 values");
    assert!(["moving", "plane", "depth"].iter().any(|kind| printed.contains(&format!("\n| {kind} | "))), "{printed}");
}

#[test]
fn fresh_output_keeps_the_contract_and_is_drawn() {
    let directory = folder_with_small_case();
    support::program::assert_code(&meniscus(directory.path(), &["run", "drop.toml", "--out", "out"]), 0);
    let out = directory.path().join("out");
    run(script("check_output.py").arg(&out), "the output must keep the contract");
    for (name, option, file, more) in [
        ("field_picture.py", "--picture", "field.png", &[][..]),
        ("angle_and_saturation.py", "--picture", "angle.png", &[]),
        ("movie.py", "--movie", "movie.gif", &["--size", "320"]),
    ] {
        let target = directory.path().join(file);
        run(script(name).arg(&out).arg(option).arg(&target).args(more), "the figure must be drawn");
        assert!(target.metadata().is_ok_and(|m| m.len() > 2000), "{file} is empty");
    }
    let printed = run(script("small_pieces.py").arg(&out), "the pieces must be counted");
    assert!(printed.contains("\nwetting: small 0, ") && printed.contains("\nnon-wetting: small 0, "), "{printed}");
}

#[test]
fn meshio_pyvista_and_vtk_read_the_same_arrays_of_a_frame() {
    let directory = folder_with_small_case();
    for compression in ["none", "zlib", "lz4"] {
        let choice = format!("--set=output.vtk.compression=\"{compression}\"");
        // Arrays of several blocks.
        let arguments = ["run", "drop.toml", "--set=sph.spacing=8e-6", "--set=time.end=1e-6", &choice, "--out"];
        support::program::assert_code(&meniscus(directory.path(), &[&arguments[..], &[compression]].concat()), 0);
    }
    let usual = ["run", "drop.toml", "--set=sph.spacing=8e-6", "--set=time.end=1e-6", "--out", "usual"];
    support::program::assert_code(&meniscus(directory.path(), &usual), 0);
    let mut compare = Command::new(interpreter());
    compare.arg(root().join("postprocess/tests/same_arrays.py"));
    let folders = ["usual", "none", "zlib", "lz4"].map(|name| directory.path().join(name));
    let printed = run(compare.args(&folders), "all readers must read the same arrays");
    // Two times of three files each, and the solids.
    for (name, by_all) in [("usual", 7), ("none", 7), ("zlib", 7), ("lz4", 0)] {
        assert!(printed.contains(&format!("{name}: 7 files, {by_all} of them by meshio too")), "{printed}");
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

/// A fresh drainage by bursts without trapping, in a folder of its own. Permeabilities are those of all regions: persistence 1.
fn folder_with_drainage() -> tempfile::TempDir {
    let out = tempfile::tempdir().expect("a temporary folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_meniscus"));
    command.arg("run").arg(root().join("cases/network/drainage.toml")).arg("--out").arg(out.path().join("out"));
    command.args(["--set", "network.events=\"burst\"", "--set", "network.trapping=false"]);
    command.args(["--set", "network.persistence=1.0", "--set", "expect=[]"]);
    run(&mut command, "the drainage must run");
    out
}

fn compared(name: &str, folder: &Path) -> String {
    let mut command = Command::new(interpreter());
    let picture = folder.join(name).with_extension("png");
    command.arg(root().join("postprocess").join(name)).arg(folder.join("out")).arg("--picture").arg(&picture);
    let printed = run(&mut command, "the networks must be compared");
    assert!(picture.metadata().is_ok_and(|m| m.len() > 2000), "the picture of {name} is empty");
    println!("{printed}");
    printed
}

#[test]
fn a_fresh_network_keeps_the_contract_and_has_the_permeability_of_openpnm() {
    let directory = folder_with_drainage();
    let out = directory.path().join("out");
    run(script("check_output.py").arg(&out), "the output must keep the contract");
    let tables = run(script("reservoir_tables.py").arg(&out), "the saturation functions must be written");
    let has = |line: &str| tables.lines().any(|found| found.starts_with(line));
    assert!(has("SWOF") && has("SGOF") && has("  1.000000   1.00000000   0.00000000"), "{tables}");
    let mut ratio = Command::new(interpreter());
    ratio.current_dir(root().join("postprocess")).arg("-c").arg(
        "import sys, network_to_openpnm as n; f = n.measure(sys.argv[1]); print(f['permeability'] / f['permeability_ours'])",
    );
    let printed = run(ratio.arg(&out), "the permeabilities must be compared");
    let ratio: f64 = printed.trim().lines().last().and_then(|line| line.parse().ok()).expect("a number");
    // Two solvers of one linear system.
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
    assert!(compared("snow2_compare.py", directory.path()).contains("pores with one of snow2"));
}

#[test]
fn a_fresh_drainage_by_bursts_is_the_invasion_of_openpnm() {
    let printed = compared("network_to_openpnm.py", folder_with_drainage().path());
    let same = printed.lines().find_map(|line| line.strip_prefix("same invaded pores"));
    assert_eq!(same.map(str::trim), Some("yes"), "{printed}");
}

/// Plays the page of a run in a browser.
fn played(folder: &Path, more: &[&str]) {
    let mut command = Command::new(browser_interpreter());
    command.arg(root().join("postprocess/tests/browser/play_page.py")).arg(browser()).arg(folder).args(more);
    println!("{}", run(&mut command, "the page must play"));
}

#[test]
fn the_page_of_a_network_plays_in_a_browser() {
    let folder = tempfile::tempdir().unwrap();
    let cases =
        [("drainage", "chip"), ("films", "films"), ("in-time", "dynamic"), ("by-itself", "spontaneous-imbibition")];
    for (out, case) in cases {
        let case = root().join(format!("cases/network/{case}.toml")).display().to_string();
        assert_code(&meniscus(folder.path(), &["run", &case, "--set", "expect=[]", "--out", out]), 0);
        played(&folder.path().join(out), &[]);
    }
}

#[test]
fn the_page_of_five_thousand_pores_is_light_and_keeps_up_with_the_slider() {
    let folder = tempfile::tempdir().unwrap();
    let pack =
        ["new", "pack.toml", "--pack", "random", "--porosity", "0.6", "--radius-deviation", "0.2", "--seed", "3"];
    assert_code(&meniscus(folder.path(), &[&pack[..], &["--size", "0.0198,0.0198"]].concat()), 0);
    let network = ["network", "pack.toml", "--inlet", "left", "--outlet", "right", "--tension", "0.07", "--out", "out"];
    assert_code(&meniscus(folder.path(), &network), 0);
    let out = folder.path().join("out");
    let size = out.join("network.html").metadata().unwrap().len();
    assert!(size < 2_000_000, "{size} bytes");
    let pores = std::fs::read_to_string(out.join("pores.csv")).unwrap().lines().count() - 1;
    assert!(pores > 5000, "{pores} pores");
    println!("{pores} pores in {size} bytes");
    played(&out, &["--speed"]);
}

#[test]
#[ignore = "builds the site, minutes: cargo test --release --test postprocess -- --ignored"]
fn the_site_is_whole_and_its_pages_play() {
    let mut build = Command::new(env!("CARGO"));
    build.current_dir(root()).args(["run", "--release", "--locked", "--package", "meniscus-site"]);
    let printed = run(&mut build, "the site must be built");
    let site = printed.trim().strip_prefix("the site is in ").unwrap_or_else(|| panic!("no folder in {printed}"));
    let mut read = Command::new(browser_interpreter());
    read.arg(root().join("postprocess/tests/browser/read_site.py")).arg(browser()).arg(site);
    println!("{}", run(&mut read, "the site must hold together"));
}
