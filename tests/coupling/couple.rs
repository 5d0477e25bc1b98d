//! Menisci driven over their entry pressure: a pressure that rises in steps, and one avalanche of a network by direct simulation.

use std::path::Path;

use crate::support::program::{assert_code, meniscus, stderr};
use serde_json::Value;

fn repository(name: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name).display().to_string()
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn a_pressure_that_rises_in_steps_passes_a_throat_at_its_entry_pressure() {
    let folder = tempfile::tempdir().unwrap();
    let case = repository("cases/burst-pressure.toml");
    let arguments = ["run", &case, "--set", "sph.spacing=1.0e-5", "--out", "steps", "--threads", "2"];
    assert_code(&meniscus(folder.path(), &arguments), 0);
    let report = json(&folder.path().join("steps/report.json"));
    let measure = |name: &str, key: &str| report["measures"][name][key].as_f64().unwrap();
    // tension/r with sqrt(R² + r² + 2 R r cos 60°) = 0.13 mm, R = 0.1 mm.
    let exact = 0.03 / (0.5 * ((1.0e-8_f64 + 4.0 * 0.69e-8).sqrt() - 1.0e-4));
    let (found, half) = (measure("burst-pressure-Pa", "value"), measure("burst-pressure-Pa", "uncertainty"));
    assert!((found - exact).abs() <= half, "{found} +- {half} Pa, exact {exact} Pa");
    assert!(half < 21.0, "{half} Pa");
}

#[test]
fn steps_without_a_first_pressure_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let case = repository("cases/compare.toml");
    let steps = "sph.sides.open.left.pressure-steps={ rise = 1.0, every-time = 1.0 }";
    let output = meniscus(folder.path(), &["check", &case, "--set", steps]);
    assert_code(&output, 3);
    assert!(stderr(&output).contains("needs an initial value"), "{}", stderr(&output));
    let case = repository("cases/burst-pressure.toml");
    let output = meniscus(folder.path(), &["check", &case, "--set", "sph.sides.open.left.pressure-steps.rise=-1.0"]);
    assert_code(&output, 3);
    assert!(stderr(&output).contains("a step in Pa above 0"), "{}", stderr(&output));
}

/// The direct case of the demonstration in a folder, coarse and short.
fn direct(folder: &Path) -> String {
    let text = std::fs::read_to_string(repository("cases/couple.toml")).unwrap();
    let pack = format!("file = {:?}", repository("geometries/wide-pack.toml"));
    let text = text.replace("file = \"../geometries/wide-pack.toml\"", &pack);
    let state = format!("network = {:?}", repository("cases/states/couple.json"));
    let text = text.replace("network = \"states/couple.json\"", &state);
    let text = text.replace("spacing = 1.0e-5", "spacing = 1.6e-5").replace("\nend = ", "\nend = 5.0e-5 # not ");
    std::fs::write(folder.join("direct.toml"), text).unwrap();
    "direct.toml".to_owned()
}

#[test]
fn an_avalanche_goes_from_the_network_to_the_direct_simulation_and_back() {
    let folder = tempfile::tempdir().unwrap();
    let (network, direct) = (repository("cases/network/compare.toml"), direct(folder.path()));
    assert_code(&meniscus(folder.path(), &["couple", &network, &direct, "--out", "all", "--threads", "2"]), 0);
    let all = folder.path().join("all");
    let found = json(&all.join("couple.json"));
    // The pack breaks through at 547.5 Pa, with all seven events that are left.
    let pressure = found["avalanche"]["pressure_pa"].as_f64().unwrap();
    assert!((pressure - 547.5).abs() < 0.1 && found["avalanche"]["events"] == 7, "{found}");
    let rest = found["avalanche"]["rest_pressure_pa"].as_f64().unwrap();
    assert!(495.7 < rest && rest < pressure, "{found}");
    let before = json(&all.join("1-network/at-end.json"))["saturation"].as_f64().unwrap();
    let [from, to] = [0, 1].map(|i| found["avalanche"]["saturation"][i].as_f64().unwrap());
    assert!((before - from).abs() < 1e-12 && to < 0.1, "{before} {found}");
    // In so short a time nothing bursts: the direct simulation hands back what it took.
    assert!((found["saturation_by_direct_simulation"].as_f64().unwrap() - from).abs() < 1e-9, "{found}");
    // The network goes on from there and does what was left.
    let after = json(&all.join("3-network/at-end.json"));
    assert!((after["saturation"].as_f64().unwrap() - to).abs() < 1e-9, "{after}");
}

#[test]
fn what_cannot_be_coupled_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (network, direct) = (repository("cases/network/compare.toml"), direct(folder.path()));
    let couple = |event: &str, network: &str, direct: &str| {
        meniscus(folder.path(), &["couple", network, direct, "--event", event, "--out", "none"])
    };
    for (event, network, direct, code, message) in [
        ("pore:99", &network, &direct, 3, "9 pores, numbered from 0"),
        ("burst", &network, &direct, 2, "expected breakthrough, overlap or pore:N"),
        ("pore:-1", &network, &direct, 2, "-1 is not the number of a pore"),
        ("breakthrough", &direct, &direct, 3, "no slow displacement"),
        ("breakthrough", &repository("cases/network/dynamic.toml"), &direct, 3, "no slow displacement"),
    ] {
        let output = couple(event, network, direct);
        assert_code(&output, code);
        assert!(stderr(&output).contains(message), "{event}: {}", stderr(&output));
    }
}

#[test]
fn a_direct_case_that_does_not_fit_is_refused_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    let (network, good) = (repository("cases/network/compare.toml"), direct(folder.path()));
    let text = std::fs::read_to_string(folder.path().join(&good)).unwrap();
    let line = |needle: &str| 1 + text.lines().position(|line| line.contains(needle)).unwrap();
    let pack = text.lines().find(|line| line.starts_with("file = ")).unwrap().to_owned();
    let state = text.lines().find(|line| line.starts_with("network = ")).unwrap().to_owned();
    let other = format!("file = {:?}", repository("geometries/four-discs.toml"));
    let shape = "wetting = [{ rectangle = { center = [0.0, 5.0e-4], size = [2.0e-4, 3.0e-3] } }]";
    for (from, to, place, message) in [
        (pack.as_str(), other.as_str(), line("network = "), "the state of the network belongs to another geometry"),
        ("left = \"inlet\"", "left = \"outlet\"", line("left ="), "here that is not an inlet with a pressure"),
        ("spacing = 1.6e-5", "spacing = 4.0e-5", line("spacing ="), "the narrowest throat is"),
        (state.as_str(), "", line("[sph.initial"), "no shape defines their regions"),
        (state.as_str(), shape, line("[sph.initial"), "does not begin with the state of a network"),
    ] {
        assert!(text.contains(from), "{from}");
        std::fs::write(folder.path().join("other.toml"), text.replace(from, to)).unwrap();
        let output = meniscus(folder.path(), &["couple", &network, "other.toml", "--out", "none"]);
        assert_code(&output, 3);
        // Lines of a long message begin with a bar.
        let told = stderr(&output).replace("│ ", "");
        assert!(told.contains(message) && told.contains(&format!("other.toml:{place}:")), "{place}: {told}");
        assert!(!folder.path().join("none").exists(), "{message}: something was run");
    }
    // The file that the direct case names need not be there: this command writes it.
    std::fs::write(folder.path().join("other.toml"), text.replace(&state, "network = \"none.json\"")).unwrap();
    let output = meniscus(folder.path(), &["couple", &network, "other.toml", "--event", "pore:99"]);
    assert!(stderr(&output).contains("numbered from 0"), "{}", stderr(&output));
}
