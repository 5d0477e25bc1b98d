//! The page on which a displacement in a network is played: the events of `events.csv`, with links from studies, and two side by side.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::program::{assert_code, meniscus, report};
use crate::support::python::{interpreter, root, run as python};

/// A chip of the repository.
fn chip() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("geometries/chip.svg").display().to_string()
}

/// The folder of a drainage, or of another process.
fn drained(more: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let chip = chip();
    let usual = ["network", &chip, "--inlet", "left", "--outlet", "right", "--tension", "0.0728", "--out", "out"];
    assert_code(&meniscus(folder.path(), &[&usual[..], more].concat()), 0);
    folder
}

fn data(page: &Path) -> serde_json::Value {
    let html = fs::read_to_string(page).unwrap();
    let (_, rest) = html.split_once("id=\"data\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

/// The bytes of a text in base64.
fn decoded(text: &str) -> Vec<u8> {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits: Vec<usize> = text.bytes().map_while(|byte| DIGITS.iter().position(|digit| *digit == byte)).collect();
    let group = |group: &[usize]| {
        let number = (0..4).fold(0, |sum, k| 64 * sum + group.get(k).unwrap_or(&0));
        (0..group.len() - 1).map(move |k| (number >> (16 - 8 * k)) as u8).collect::<Vec<_>>()
    };
    digits.chunks(4).flat_map(group).collect()
}

fn numbers(column: &serde_json::Value) -> Vec<f64> {
    let bytes = decoded(column["base64"].as_str().unwrap());
    match column["type"].as_str().unwrap() {
        "f32" => bytes.chunks(4).map(|it| f64::from(f32::from_le_bytes(it.try_into().unwrap()))).collect(),
        "i32" => bytes.chunks(4).map(|it| f64::from(i32::from_le_bytes(it.try_into().unwrap()))).collect(),
        "u16" => bytes.chunks(2).map(|it| f64::from(u16::from_le_bytes(it.try_into().unwrap()))).collect(),
        _ => bytes.into_iter().map(f64::from).collect(),
    }
}

#[test]
fn a_page_has_the_events_of_the_table() {
    let folder = drained(&["--process", "cycle", "--angle-deg", "40"]);
    let out = folder.path().join("out");
    let data = data(&out.join("network.html"));
    let events = &data["runs"][0]["events"];
    let mut table = csv::Reader::from_path(out.join("events.csv")).unwrap();
    let heads = table.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    assert!(rows.len() > 40, "{} rows", rows.len());
    let cells = |name: &str| {
        let at = heads.iter().position(|head| head == name).unwrap();
        rows.iter().map(move |row| row[at].to_owned()).collect::<Vec<_>>()
    };
    for name in ["meniscus_pressure_Pa", "capillary_pressure_Pa", "saturation"] {
        for (found, cell) in numbers(&events[name]).into_iter().zip(cells(name)) {
            let wanted: f64 = if cell.is_empty() { f64::NAN } else { cell.parse().unwrap() };
            assert!(
                found.is_nan() && wanted.is_nan() || (found - wanted).abs() <= 1e-6 * wanted.abs(),
                "{name} {cell}"
            );
        }
    }
    for (found, cell) in numbers(&events["throat"]).into_iter().zip(cells("throat")) {
        assert_eq!(found, cell.parse().map_or(0.0, |throat: f64| throat + 1.0));
    }
    let words = events["event"]["words"].as_array().unwrap();
    for (found, cell) in numbers(&events["event"]).into_iter().zip(cells("event")) {
        assert_eq!(words[found as usize], cell);
    }
}

#[test]
fn a_page_is_the_same_on_any_number_of_threads() {
    let [one, two] = ["1", "2"].map(|threads| {
        let folder = drained(&["--angle-deg", "40", "--threads", threads]);
        fs::read(folder.path().join("out/network.html")).unwrap()
    });
    assert!(one == two);
}

/// A case file for the chip in a folder.
fn case(folder: &Path, name: &str, deg: f64) {
    let text = format!(
        "format = 1\ntitle = \"Chip at {deg} degrees\"\n[geometry]\nfile = '{}'\n[network]\ninlet = \"left\"\noutlet = \"right\"\n\
         [network.interface]\ntension = 0.0728\n[network.wetting.young]\ncontact-angle-deg = {deg:?}\n",
        chip()
    );
    fs::write(folder.join(name), text).unwrap();
}

#[test]
fn a_study_links_the_page_of_each_run() {
    let folder = tempfile::tempdir().unwrap();
    case(folder.path(), "case.toml", 40.0);
    for (name, report) in [("with", ""), ("without", "[report]\npictures = false\n")] {
        let text = format!(
            "format = 1\ntitle = \"Angles\"\ncase = \"case.toml\"\n[[axis]]\nkey = \"network.wetting.young.contact-angle-deg\"\nname = \"angle\"\n\
             values = [40.0, 80.0]\n{report}"
        );
        fs::write(folder.path().join(format!("{name}.toml")), text).unwrap();
        assert_code(&meniscus(folder.path(), &["study", "run", &format!("{name}.toml"), "--out", name]), 0);
        let page = fs::read_to_string(folder.path().join(name).join("report.html")).unwrap();
        let links: Vec<&str> = page.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        let played: Vec<&&str> = links.iter().filter(|link| link.ends_with("/network.html")).collect();
        assert_eq!(played.len(), 2, "{links:?}");
        assert!(played.iter().all(|link| folder.path().join(name).join(link).is_file()), "{played:?}");
    }
}

#[test]
fn two_networks_are_compared_on_one_page() {
    let folder = tempfile::tempdir().unwrap();
    case(folder.path(), "one.toml", 40.0);
    case(folder.path(), "other.toml", 80.0);
    let output = meniscus(folder.path(), &["compare", "one.toml", "other.toml", "--out", "both"]);
    assert_code(&output, 0);
    let printed = crate::support::program::stdout(&output);
    assert!(printed.contains("breakthrough-pressure-Pa") && printed.contains("302.1") && printed.contains("199.2"));
    let both = data(&folder.path().join("both/compare.html"));
    for (run, name) in both["runs"].as_array().unwrap().iter().zip(["first", "second"]) {
        let alone = data(&folder.path().join("both").join(name).join("network.html"));
        assert_eq!(run["events"], alone["runs"][0]["events"]);
    }
    // Both are at their end.
    let again = ["compare", "one.toml", "other.toml", "--out", "both", "--resume"];
    assert_code(&meniscus(folder.path(), &again), 0);
}

#[test]
fn a_curve_alone_is_that_of_the_whole_run() {
    let in_time = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/network/dynamic.toml").display().to_string();
    let chip = chip();
    let drained = ["network", &chip, "--inlet", "left", "--outlet", "right", "--depth", "3e-4", "--angle-deg", "20"];
    for (arguments, option) in
        [(&drained[..], "--results=curve"), (&["run", &in_time, "--set=expect=[]"], "--set=network.results=\"curve\"")]
    {
        let folder = tempfile::tempdir().unwrap();
        let run = |more: &[&str]| assert_code(&meniscus(folder.path(), &[arguments, more].concat()), 0);
        run(&["--out", "all"]);
        run(&[option, "--out", "curve"]);
        let files = |name: &str| {
            let entries = fs::read_dir(folder.path().join(name)).unwrap();
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect::<Vec<_>>()
        };
        let is_same = |name: &&String| {
            ["events.csv", "series.csv", "capillary_pressure.csv"].contains(&name.as_str()) || name.ends_with(".svg")
        };
        let found = files("curve");
        let same: Vec<_> = found.iter().filter(is_same).collect();
        assert!(same.len() >= 3, "{found:?}");
        for name in same {
            let read = |folder_name: &str| fs::read(folder.path().join(folder_name).join(name)).unwrap();
            assert!(read("curve") == read("all"), "{name} differs");
        }
        for name in [
            "pores.csv",
            "throats.csv",
            "openpnm.csv",
            "pores.vtu",
            "regions.pvd",
            "interface.pvd",
            "network.html",
            "picture.png",
        ] {
            assert!(
                !found.iter().any(|it| it == name) && files("all").iter().any(|it| it == name),
                "{name}: {found:?}"
            );
        }
        let measures = |name: &str| report(&folder.path().join(name))["measures"].as_object().unwrap().clone();
        let (all, curve) = (measures("all"), measures("curve"));
        assert!(curve.iter().all(|(name, measure)| all[name] == *measure), "{curve:?}");
        assert!(all.contains_key("permeability-x-m2") && !curve.contains_key("permeability-x-m2"));
        assert!(all.contains_key("median-entry-pressure-Pa") && !curve.contains_key("median-entry-pressure-Pa"));
        assert!(curve.contains_key("final-wetting-saturation"), "{curve:?}");
        let mut check = Command::new(interpreter());
        check.arg(root().join("postprocess/check_output.py")).arg(folder.path().join("curve"));
        python(&mut check, "the output must keep the contract");
        // A movie computes the displacement again.
        assert_code(&meniscus(folder.path(), &["movie", "curve"]), 0);
    }
}
