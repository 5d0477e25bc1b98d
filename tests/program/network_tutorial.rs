//! The tutorial of networks: its commands run, one after the other, in a copy of what they name, and leave what the page says.

use std::fs;
use std::path::Path;

use crate::support::program::{assert_code, meniscus, report, stderr};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The command lines of the program in the fences of a page.
fn commands(page: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(Path::new(ROOT).join(page)).unwrap();
    let fences = text.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    let lines = fences.flat_map(str::lines).filter_map(|line| line.strip_prefix("meniscus "));
    lines.map(|line| line.split_whitespace().map(str::to_owned).collect()).collect()
}

fn copy(folder: &str, to: &Path) {
    fs::create_dir_all(to.join(folder)).unwrap();
    for entry in fs::read_dir(Path::new(ROOT).join(folder)).unwrap().map(Result::unwrap) {
        if entry.file_type().unwrap().is_file() {
            fs::copy(entry.path(), to.join(folder).join(entry.file_name())).unwrap();
        }
    }
}

#[test]
fn every_command_of_the_tutorial_runs_and_leaves_what_it_promises() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["geometries", "cases/network", "studies/validation"] {
        copy(name, folder.path());
    }
    let commands = commands("docs/tutorials/network.md");
    assert!(commands.len() >= 8, "{commands:?}");
    for arguments in &commands {
        let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let output = meniscus(folder.path(), &words);
        assert!(output.status.success(), "meniscus {}\n{}", words.join(" "), stderr(&output));
        assert_code(&output, 0);
    }

    let out = |name: &str| folder.path().join("out").join(name);
    for file in ["picture.png", "diagram-capillary-pressure.svg", "events.csv", "pores.csv", "throats.csv"] {
        assert!(out("chip-drainage").join(file).is_file(), "{file} is missing");
    }
    assert!(out("study-network-angles/report.html").is_file());
    let measure = |name: &str, measure: &str| report(&out(name))["measures"][measure]["value"].as_f64().unwrap();
    // A larger angle through the wetting phase needs less pressure to drain.
    let [pressure, less] = ["chip-drainage", "chip-drainage-80"].map(|name| measure(name, "breakthrough-pressure-Pa"));
    assert!(0.0 < less && less < pressure, "{less} and {pressure} Pa");
    // The same chip in DXF.
    for name in ["pores", "throats", "events", "trapped-saturation", "breakthrough-pressure-Pa"] {
        let [svg, dxf] = ["chip-drainage", "chip-dxf"].map(|out| measure(out, name));
        assert!((svg / dxf - 1.0).abs() < 1e-4, "{name}: {svg} and {dxf}");
    }
    // The case is the same displacement as the command without a case, whose saturations are those of the pack.
    for name in ["events", "breakthrough-pressure-Pa"] {
        assert_eq!(measure("chip", name), measure("chip-drainage", name), "{name}");
    }
}
