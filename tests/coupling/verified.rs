//! Throats by direct simulation, from the command to its table: entry pressure and conductance, in the plane and in a chip, and values that a network
//! takes up.

use std::collections::BTreeMap;
use std::path::Path;

use crate::support::program::{assert_code, meniscus, stderr, stdout};
use crate::verify::{DISCS, case};
use meniscus::verify::choose::{Choice, choose};
use meniscus::verify::subject::Subject;
use meniscus_case::load;
use meniscus_core::input::Overrides;

/// The first row of a table by its heads.
fn first_row(path: &Path) -> BTreeMap<String, String> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let heads = reader.headers().unwrap().clone();
    let row = reader.records().next().unwrap().unwrap();
    heads.iter().map(str::to_owned).zip(row.iter().map(str::to_owned)).collect()
}

/// The error bar of the conductance of a direct simulation, in percent of that of the formula.
fn bar_percent(row: &BTreeMap<String, String>) -> f64 {
    let [bar, formula] = ["g_direct_error_m2", "g_formula_m2"].map(|name| row[name].parse::<f64>().unwrap());
    100.0 * bar / formula
}

#[test]
fn one_throat_is_verified_and_its_value_taken_up() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("two.toml"), case(DISCS, 50.0, "")).unwrap();
    let arguments = [
        "network",
        "verify",
        "two.toml",
        "--throats",
        "critical",
        "--spacings",
        "6,8",
        "--threads",
        "1",
        "--out",
        "out",
    ];
    let output = meniscus(at, &arguments);
    assert_code(&output, 0);
    assert!(stdout(&output).contains("| throat "), "{}", stdout(&output));
    let row = first_row(&at.join("out/verify.csv"));
    let number = |name: &str| row[name].parse::<f64>().unwrap();
    assert_eq!((row["status"].as_str(), row["flow_status"].as_str()), ("ok", "ok"), "{row:?}");
    assert!((number("w_m") - 1.5e-4).abs() < 1e-12, "{row:?}");
    assert!(number("pc_difference_percent").abs() < 0.5, "{row:?}");
    assert!(number("g_difference_percent").abs() < bar_percent(&row), "{row:?}");
    let page = std::fs::read_to_string(at.join("out/verify.html")).unwrap();
    assert!(page.contains("picture.png") && !page.contains("http"));
    // Nothing is left to do the second time.
    let again = meniscus(at, &arguments);
    assert_code(&again, 0);
    assert!(stderr(&again).contains("was complete") || !stderr(&again).contains("begun"), "{}", stderr(&again));
    assert_eq!(first_row(&at.join("out/verify.csv")), row);
    taken_up(at, number("pc_formula_Pa"));
}

#[test]
fn a_throat_of_a_chip_is_verified_with_its_depth() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("two.toml"), case(DISCS, 50.0, "")).unwrap();
    let set =
        ["--set", "geometry.depth=1.5e-4", "--set", "network.wetting.patches=[{plate=\"lid\",contact-angle-deg=70.0}]"];
    let verify = ["network", "verify", "two.toml", "--throats", "critical", "--spacings", "6,8", "--threads", "1"];
    let output = meniscus(at, &[&verify[..], &["--out", "out"], &set].concat());
    assert_code(&output, 0);
    let row = first_row(&at.join("out/verify.csv"));
    let number = |name: &str| row[name].parse::<f64>().unwrap();
    assert_eq!((row["status"].as_str(), row["flow_status"].as_str()), ("ok", "ok"), "{row:?}");
    // Of the network with the same depth.
    assert_code(&meniscus(at, &[&["run", "two.toml", "--out", "run"], &set[..]].concat()), 0);
    let mut throats = csv::Reader::from_path(at.join("run/throats.csv")).unwrap();
    let heads = throats.headers().unwrap().clone();
    let place = heads.iter().position(|head| head == "entry_pressure_Pa").unwrap();
    let of_network = throats.records().nth(number("throat") as usize).unwrap().unwrap()[place].parse::<f64>().unwrap();
    assert!((number("pc_formula_Pa") / of_network - 1.0).abs() < 1e-12, "{row:?} {of_network}");
    assert!(number("pc_difference_percent").abs() < 1.0, "{row:?}");
    // Finite elements of the depth-averaged equations give 2.969e-10 m²: the network is 7 % below, eight spacings 4 % above, and the conductance
    // of the plane 3.5 times that.
    // A throat as deep as wide: the formula has the flow of a duct. The direct simulation has the flow averaged over the depth, whose friction at floor and
    // lid is that of plates without walls between them; in a straight duct of this section, it carries 1 - tanh(k)/k over .4217, k = √3.
    let k = 3.0_f64.sqrt();
    let averaged = 100.0 * ((1.0 - k.tanh() / k) / 0.4217 - 1.0);
    let (difference, bar) = (number("g_difference_percent"), bar_percent(&row));
    assert!((8.0..9.0).contains(&averaged) && -bar < difference && difference < averaged + bar, "{row:?}");
    assert!(stdout(&output).contains("both sides curve menisci over the depth"), "{}", stdout(&output));
}

/// A measured value that is a tenth higher moves the breakthrough; one of another geometry is refused.
fn taken_up(at: &Path, formula: f64) {
    let text = std::fs::read_to_string(at.join("out/measured.json")).unwrap();
    let mut measured: serde_json::Value = serde_json::from_str(&text).unwrap();
    let throat = serde_json::json!({
        "index": first_index(at), "formula-curvature": formula / 0.03, "entry-curvature": 1.1 * formula / 0.03
    });
    measured["throats"] = serde_json::json!([throat]);
    std::fs::write(at.join("higher.json"), measured.to_string()).unwrap();
    std::fs::write(at.join("higher.toml"), case(DISCS, 50.0, "measured = \"higher.json\"")).unwrap();
    let pressure = |case: &str| {
        let out = format!("run-{case}");
        assert_code(&meniscus(at, &["run", &format!("{case}.toml"), "--out", &out]), 0);
        let report: serde_json::Value =
            serde_json::from_slice(&std::fs::read(at.join(out).join("report.json")).unwrap()).unwrap();
        let value = |name: &str| report["measures"][name]["value"].as_f64();
        (value("breakthrough-pressure-Pa").unwrap(), value("measured-entry-pressures"))
    };
    let ((before, none), (after, count)) = (pressure("two"), pressure("higher"));
    assert_eq!((none, count), (None, Some(1.0)));
    assert!((after / before - 1.1).abs() < 1e-9, "{before} {after}");
    measured["geometry-hash"] = "0000000000000000".into();
    std::fs::write(at.join("higher.json"), measured.to_string()).unwrap();
    let refused = meniscus(at, &["run", "higher.toml", "--out", "run-refused"]);
    assert_code(&refused, 3);
    // Lines of a long message begin with a bar.
    assert!(stderr(&refused).replace("│ ", "").contains("those of another geometry"), "{}", stderr(&refused));
}

/// The index of the verified throat among all of the network.
fn first_index(at: &Path) -> usize {
    let loaded = load(&at.join("two.toml"), &Overrides::default()).unwrap();
    let subject = Subject::new(&loaded.case).unwrap();
    choose(&subject, &[Choice::Critical], 1).unwrap()[0].throat
}
