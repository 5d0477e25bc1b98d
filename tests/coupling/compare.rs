//! `meniscus compare`: two cases of one geometry become a page and a JSON file; cases that do not fit are refused.

use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use crate::support::program::{assert_code, command, meniscus, stderr};

fn repository(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name).display().to_string()
}

/// Both cases of the demonstration in a folder, the direct one coarser and a hundredth as long.
fn cases(folder: &Path) {
    let text = |name: &str| std::fs::read_to_string(repository(name)).unwrap();
    let pack = format!("file = {:?}", repository("geometries/wide-pack.toml"));
    let network = text("cases/network/compare.toml").replace("file = \"../../geometries/wide-pack.toml\"", &pack);
    let direct = text("cases/compare.toml").replace("file = \"../geometries/wide-pack.toml\"", &pack);
    // Filled as far as the network is at its first event.
    let direct = direct.replace("size = [2.0e-4, 2.0e-3]", "size = [9.0e-4, 2.0e-3]");
    let direct = direct.replace("spacing = 1.0e-5", "spacing = 1.6e-5").replace("end = 0.01", "end = 1.0e-4");
    std::fs::write(folder.join("network.toml"), network).unwrap();
    std::fs::write(folder.join("direct.toml"), direct).unwrap();
}

#[test]
fn two_cases_of_one_geometry_become_a_page_and_numbers() {
    let folder = tempfile::tempdir().unwrap();
    cases(folder.path());
    let arguments = ["compare", "network.toml", "direct.toml", "--records", "5", "--out", "both", "--threads", "1"];
    assert_code(&meniscus(folder.path(), &arguments), 0);
    let page = std::fs::read_to_string(folder.path().join("both/compare.html")).unwrap();
    for resource in ["src=", "href=", "url(", "@import"] {
        assert!(!page.contains(resource), "{resource}");
    }
    assert!(page.contains("capillary pressure") && page.matches("<svg").count() >= 2);
    // It is coarser than menisci in throats need.
    assert!(page.contains("<li>direct simulation: ") && page.contains("across the narrowest throat"), "{page}");
    let text = std::fs::read_to_string(folder.path().join("both/compare.json")).unwrap();
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(found["direct"]["saturation"].as_array().unwrap().len(), 6);
    assert!(found["network"]["breakthrough_pressure_pa"].as_f64().unwrap() > 100.0);
    assert!(found["direct"]["breakthrough_pressure_pa"].is_null(), "it ends long before");
    let again = meniscus(folder.path(), &arguments);
    assert_code(&again, 2);
    assert!(stderr(&again).contains("is not empty"), "{}", stderr(&again));
}

#[test]
fn cases_of_two_geometries_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    cases(folder.path());
    let other = repository("cases/network/hand-over.toml");
    let output = meniscus(folder.path(), &["compare", &other, "direct.toml", "--out", "both"]);
    assert_code(&output, 3);
    assert!(stderr(&output).contains("not of one geometry"), "{}", stderr(&output));
    let no_network = meniscus(folder.path(), &["compare", "direct.toml", "direct.toml", "--out", "none"]);
    assert_code(&no_network, 3);
    assert!(stderr(&no_network).contains("expected a network with a displacement"), "{}", stderr(&no_network));
}

/// All that is compared, without the times that it took.
fn compared(folder: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(folder.join("compare.json")).unwrap();
    let mut found: serde_json::Value = serde_json::from_str(&text).unwrap();
    for side in ["network", "direct"] {
        for time in ["wall_time_s", "processor_time_s"] {
            assert!(found[side].as_object_mut().unwrap().remove(time).is_some(), "{side}: {time}");
        }
    }
    found
}

#[test]
fn a_comparison_that_is_killed_goes_on_to_the_same_numbers() {
    let folder = tempfile::tempdir().unwrap();
    cases(folder.path());
    let direct = folder.path().join("direct.toml");
    let text = std::fs::read_to_string(&direct).unwrap();
    std::fs::write(&direct, text + "\n[output]\nrestart = { every-time = 1.0e-5 } # s\n").unwrap();
    let arguments = |out| ["compare", "network.toml", "direct.toml", "--records", "20", "--threads", "1", "--out", out];
    assert_code(&meniscus(folder.path(), &arguments("whole")), 0);
    let mut child = command(folder.path(), &arguments("killed")).stderr(Stdio::null()).spawn().unwrap();
    let states = folder.path().join("killed/direct-states.jsonl");
    let count = || std::fs::read_to_string(&states).map_or(0, |text| text.lines().count());
    while count() < 8 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it was killed");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(count() < 21, "it was killed too late");
    let go_on = |more: &[&str]| meniscus(folder.path(), &[&arguments("killed")[..], &["--resume"], more].concat());
    assert_code(&go_on(&[]), 0);
    assert_eq!(count(), 21);
    assert_eq!(compared(&folder.path().join("killed")), compared(&folder.path().join("whole")));
    // Files for ParaView are written beside it, and at the end only the page is made again.
    assert!(folder.path().join("killed/direct/particles.pvd").exists());
    std::fs::remove_file(folder.path().join("killed/compare.html")).unwrap();
    assert_code(&go_on(&[]), 0);
    assert!(folder.path().join("killed/compare.html").exists());
    let nothing = meniscus(folder.path(), &[&arguments("nothing")[..], &["--resume"]].concat());
    assert_code(&nothing, 2);
    assert!(stderr(&nothing).contains("there is no run to resume in nothing"), "{}", stderr(&nothing));
    assert!(!folder.path().join("nothing").exists());
}

/// A study of the comparison in `folder` at two angles.
fn study(folder: &Path, records: usize) {
    let text = format!(
        r#"
format = 1
title = "Network and direct simulation at two angles"
case = "direct.toml"
[compare]
network = "network.toml"
records = {records}
[[axis]]
name = "angle"
key = "sph.wetting.young.contact-angle-deg"
also = ["network.wetting.young.contact-angle-deg"]
values = [40.0, 60.0]
[[expect]]
measure = "network-breakthrough-pressure-Pa"
value = 547.5
tolerance = 0.1
where = {{ angle = 40.0 }}
"#
    );
    std::fs::write(folder.join("study.toml"), text).unwrap();
}

#[test]
fn a_study_compares_both_at_each_of_its_points() {
    let folder = tempfile::tempdir().unwrap();
    cases(folder.path());
    let run = |records| {
        study(folder.path(), records);
        let output = meniscus(folder.path(), &["study", "run", "study.toml", "--out", "out", "--jobs", "2"]);
        assert_code(&output, 0);
        stderr(&output).matches("done in").count()
    };
    assert_eq!(run(2), 2);
    let read = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    let csv = read("table.csv");
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|head| *head == name).unwrap_or_else(|| panic!("{name}: {csv}"));
    let values = |name: &str| [1, 2].map(|row| rows[row][column(name)].parse::<f64>().unwrap());
    assert_eq!(values("angle"), [40.0, 60.0]);
    let [wetting, less_wetting] = values("network-breakthrough-pressure-Pa");
    assert!(wetting > 1.1 * less_wetting, "the angle reached the network: {csv}");
    assert!(values("mean-overlap").iter().all(|overlap| (0.0..=1.0).contains(overlap)), "{csv}");
    assert!(values("direct-cpu-s").iter().all(|seconds| *seconds > 0.0), "{csv}");
    assert_eq!(rows[1][column("direct-breakthrough-pressure-Pa")], "", "it ends long before");
    let page = read("report.html");
    assert_eq!((page.matches("<svg").count(), page.matches("src=").count()), (2, 0), "it is one file");
    for name in ["angle=40", "angle=60"] {
        assert!(page.contains(&format!("href=\"runs/{name}/compare.html\"")), "{page}");
        assert!(read(&format!("runs/{name}/compare.html")).contains("At equal saturation"));
    }
    // What is complete is kept, what was begun is taken up, and with other records all of it is done again.
    assert_eq!(run(2), 0);
    std::fs::remove_file(folder.path().join("out/runs/angle=60/report.json")).unwrap();
    // Particles of the first state are written by a run that begins, not by one that goes on.
    let first = folder.path().join("out/runs/angle=60/direct/particles/particles-000000.vtu");
    let written = || std::fs::metadata(&first).unwrap().modified().unwrap();
    let before = written();
    assert_eq!(run(2), 1);
    assert_eq!(written(), before, "its direct simulation was at the end");
    assert_eq!(run(3), 2);
}

#[test]
fn a_comparison_of_a_study_that_cannot_be_run_is_refused_before_any_run() {
    let folder = tempfile::tempdir().unwrap();
    cases(folder.path());
    study(folder.path(), 2);
    let path = folder.path().join("study.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replace("\"network-break", "\"netwrk-break")).unwrap();
    let output = meniscus(folder.path(), &["study", "plan", "study.toml"]);
    assert_code(&output, 3);
    let told = stderr(&output);
    assert!(
        told.contains("study.toml:14") && told.contains("did you mean `network-breakthrough-pressure-Pa`"),
        "{told}"
    );
    let other = repository("cases/network/hand-over.toml");
    std::fs::write(&path, text.replace("\"network.toml\"", &format!("{other:?}"))).unwrap();
    let output = meniscus(folder.path(), &["study", "plan", "study.toml"]);
    assert_code(&output, 3);
    let told = stderr(&output);
    assert!(told.contains("study.toml:6") && told.contains("not of one geometry"), "{told}");
    assert!(told.contains("let both name the same shape file: that of direct.toml"), "{told}");
}

/// The same cases with the wetting phase coming in.
fn imbibition(folder: &Path) {
    cases(folder);
    let edit = |name: &str, pairs: &[(&str, &str)]| {
        let path = folder.join(name);
        let mut text = std::fs::read_to_string(&path).unwrap();
        for (from, to) in pairs {
            assert!(text.contains(from), "{from}");
            text = text.replace(from, to);
        }
        std::fs::write(path, text).unwrap();
    };
    edit("network.toml", &[("outlet = \"right\"", "outlet = \"right\"\nprocess = \"imbibition\"")]);
    let inflow = "velocity = 0.1 # m/s";
    let pairs =
        [("[[sph.initial.non-wetting]]", "[[sph.initial.wetting]]"), (inflow, "velocity = 0.1\nphase = \"wetting\"")];
    edit("direct.toml", &pairs);
}

#[test]
fn the_breakthrough_of_an_imbibition_is_that_of_a_run() {
    let folder = tempfile::tempdir().unwrap();
    imbibition(folder.path());
    assert_code(&meniscus(folder.path(), &["run", "network.toml", "--out", "run", "--threads", "1"]), 0);
    let report = std::fs::read_to_string(folder.path().join("run/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let measure = |name: &str| report["measures"][name]["value"].as_f64().unwrap();
    let arguments = ["compare", "network.toml", "direct.toml", "--records", "2", "--out", "both", "--threads", "1"];
    assert_code(&meniscus(folder.path(), &arguments), 0);
    let text = std::fs::read_to_string(folder.path().join("both/compare.json")).unwrap();
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let network = &found["network"];
    assert_eq!(network["breakthrough_pressure_pa"].as_f64().unwrap(), measure("breakthrough-pressure-Pa"));
    assert_eq!(network["saturation_at_breakthrough"].as_f64().unwrap(), measure("saturation-at-breakthrough"));
    let pressures: Vec<f64> =
        network["capillary_pressure_pa"].as_array().unwrap().iter().filter_map(serde_json::Value::as_f64).collect();
    assert!(pressures[0] > measure("breakthrough-pressure-Pa"), "it falls in an imbibition: {pressures:?}");
}
