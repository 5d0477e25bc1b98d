//! The tutorial of networks and the page of questions: their commands run, one after the other, in a copy of what they name, and leave what the pages say.

use std::fs;
use std::path::Path;

use crate::support::program::{assert_code, meniscus, report, stderr};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The command lines of the program in the fences of a page.
fn commands(page: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(Path::new(ROOT).join(page)).unwrap();
    let fences = text.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next());
    let lines = fences.flat_map(str::lines).filter_map(|line| line.strip_prefix("meniscus "));
    lines.map(arguments).collect()
}

/// The arguments of a command line, in which double quotes hold words together.
fn arguments(line: &str) -> Vec<String> {
    let parts = line.split('"').enumerate();
    let words = parts.flat_map(|(number, part)| match number % 2 {
        0 => part.split_whitespace().map(str::to_owned).collect(),
        _ => vec![part.to_owned()],
    });
    words.collect()
}

fn copy(folder: &str, to: &Path) {
    fs::create_dir_all(to.join(folder)).unwrap();
    for entry in fs::read_dir(Path::new(ROOT).join(folder)).unwrap().map(Result::unwrap) {
        if entry.file_type().unwrap().is_file() {
            fs::copy(entry.path(), to.join(folder).join(entry.file_name())).unwrap();
        }
    }
}

/// Runs commands in a folder.
fn run(commands: &[Vec<String>], folder: &Path) {
    for arguments in commands {
        let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let output = meniscus(folder, &words);
        assert!(output.status.success(), "meniscus {}\n{}", words.join(" "), stderr(&output));
        assert_code(&output, 0);
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
    run(&commands, folder.path());
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
        assert!((svg / dxf - 1.0).abs() < 2e-5, "{name}: {svg} and {dxf}");
    }
    // The case is the same displacement as the command without a case, whose saturations are those of the pack.
    for name in ["events", "breakthrough-pressure-Pa"] {
        assert_eq!(measure("chip", name), measure("chip-drainage", name), "{name}");
    }
}

#[test]
fn the_questions_have_the_answers_of_their_page() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["geometries", "cases", "cases/network", "cases/thin-film"] {
        copy(name, folder.path());
    }
    let mut commands = commands("docs/tutorials/questions.md");
    assert!(commands.len() >= 12, "{commands:?}");
    // Studies take longer; their tables and figures are kept elsewhere.
    commands.retain(|words| words[0] != "study");
    run(&commands, folder.path());
    let answers = [
        ("chip-kr", "relative-permeability-non-wetting", 0.27, 0.005),
        ("tilted-plate", "drag-over-largest-retention", 0.120, 0.001),
        ("wafer", "contact-line-position", 4.7e-3, 0.05e-3),
        ("upright", "saturation-at-breakthrough", 0.70, 0.005),
        ("tilted", "saturation-at-breakthrough", 0.61, 0.005),
        ("upside-down", "saturation-at-breakthrough", 0.40, 0.005),
        ("carbon-dioxide", "trapped-saturation", 0.183, 0.001),
        ("from-openpnm", "breakthrough-pressure-Pa", 329.0, 0.5),
    ];
    for (out, name, told, rounding) in answers {
        let measures = report(&folder.path().join("out").join(out))["measures"].clone();
        let found = measures[name]["value"].as_f64().unwrap_or_else(|| panic!("{out}: no {name}"));
        assert!((found - told).abs() <= rounding, "{out}, {name}: {found}, and the page tells {told}");
    }
    assert!(folder.path().join("out/chip-kr/movie.gif").is_file());
}
