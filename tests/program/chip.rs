//! A chip's depth on the command line: measures of a geometry, files that have it, what is told before a run, and the names of values of all of the depth.

use std::collections::BTreeMap;
use std::path::Path;

use crate::support::program::{assert_code, folder_with_small_case, meniscus, report, stderr, stdout};

/// Posts of 200 um, 50 um apart, in a shape file with the depth 50 um.
fn folder_with_pack() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let arguments =
        ["new", "pack.toml", "--pack", "square", "--radius", "1e-4", "--gap", "5e-5", "--size", "1e-3,1e-3"];
    assert_code(&meniscus(folder.path(), &[&arguments[..], &["--depth", "50e-6"]].concat()), 0);
    folder
}

/// The measures that `geometry` prints.
fn measured(folder: &Path, arguments: &[&str]) -> BTreeMap<String, f64> {
    let output = meniscus(folder, &[&["geometry"], arguments].concat());
    assert_code(&output, 0);
    let words = |line: &str| line.split_whitespace().take(2).map(str::to_owned).collect::<Vec<_>>();
    let number = |words: Vec<String>| Some((words.first()?.clone(), words.get(1)?.parse().ok()?));
    stdout(&output).lines().map(words).filter_map(number).collect()
}

#[test]
fn a_geometry_with_a_depth_has_volumes_and_throats_in_depths() {
    let folder = folder_with_pack();
    let plane = measured(folder.path(), &["pack.toml", "--depth", "1e-4"]);
    let found = measured(folder.path(), &["pack.toml"]);
    // Four digits are printed.
    let near = |name: &str, value: f64| assert!((found[name] / value - 1.0).abs() < 2e-3, "{name}: {found:?}");
    let (b, porosity) = (50e-6, found["porosity"]);
    near("depth-m", b);
    near("pore-volume-m3", porosity * 1e-6 * b);
    near("specific-surface-with-plates-per-m", found["specific-surface-per-m"] + 2.0 * porosity / b);
    near("permeability-bound-m2", porosity * b * b / 12.0);
    near("throat-1-width-over-depth", 1.0);
    assert!((plane["throat-1-width-over-depth"] - 0.5).abs() < 1e-3 && plane["depth-m"] == 1e-4, "{plane:?}");
}

#[test]
fn a_shape_file_keeps_its_depth_and_a_case_takes_it() {
    let folder = folder_with_pack();
    let at = folder.path();
    assert!(std::fs::read_to_string(at.join("pack.toml")).unwrap().contains("\ndepth = 5e-5 "));
    measured(at, &["pack.toml", "--write", "same.toml", "--depth", "2e-5"]);
    assert_eq!(measured(at, &["same.toml"])["depth-m"], 2e-5);
    let depth = |arguments: &[&str], out: &str| {
        assert_code(&meniscus(at, &[arguments, &["--out", out]].concat()), 0);
        report(&at.join(out))["case"]["depth"].as_f64()
    };
    assert_eq!(depth(&["network", "pack.toml"], "a"), Some(5e-5));
    assert_eq!(depth(&["network", "pack.toml", "--depth", "1e-4"], "b"), Some(1e-4));
    std::fs::write(
        at.join("case.toml"),
        "format = 1\ntitle = \"Posts\"\n[geometry]\nfile = \"pack.toml\"\n[network]\n",
    )
    .unwrap();
    assert_eq!(depth(&["run", "case.toml"], "c"), Some(5e-5));
    assert_eq!(depth(&["run", "case.toml", "--set", "geometry.depth=1e-4"], "d"), Some(1e-4));
    assert_eq!(measured(at, &["case.toml"])["depth-m"], 5e-5);
}

#[test]
fn a_depth_that_is_none_is_refused_alike_everywhere() {
    let folder = folder_with_pack();
    let at = folder.path();
    let pack = ["new", "other.toml", "--pack", "square", "--size", "1e-3,1e-3"];
    for (arguments, depth) in [
        (&["geometry", "pack.toml"][..], "50"),
        (&["network", "pack.toml"], "50"),
        (&pack, "50e3"),
        (&["geometry", "pack.toml"], "-1e-5"),
        (&["network", "pack.toml"], "nan"),
    ] {
        let depth = if depth == "50" { "5e4" } else { depth };
        let output = meniscus(at, &[arguments, &["--depth", depth]].concat());
        assert_code(&output, 3);
        let told = stderr(&output);
        assert!(told.contains("depth: the depth of ") && told.contains("50 um are 50e-6"), "{arguments:?}: {told}");
    }
    let output = meniscus(at, &["new", "mine.toml", "--depth", "5e4"]);
    assert_code(&output, 3);
    assert!(
        stderr(&output).contains("the depth of 5e4 m is implausible for a domain of 2e-3 m"),
        "{}",
        stderr(&output)
    );
    assert!(!at.join("mine.toml").exists() && !at.join("other.toml").exists());
}

#[test]
fn the_starter_case_of_a_chip_can_be_checked() {
    let folder = tempfile::tempdir().unwrap();
    assert_code(&meniscus(folder.path(), &["new", "--depth", "50e-6"]), 0);
    let text = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    assert!(text.contains("\ndepth = 5e-5 # m"), "{text}");
    let output = meniscus(folder.path(), &["check", "case.toml"]);
    assert_code(&output, 0);
    assert!(stdout(&output).contains("  depth       50 um"), "{}", stdout(&output));
}

#[test]
fn values_of_all_of_the_depth_stand_beside_those_per_meter() {
    let folder = folder_with_small_case();
    let sides = "sph.sides={left=\"periodic\",right=\"periodic\",open={left={flow-rate=1.2e-12}}}";
    let set = ["geometry.depth=1e-4", sides];
    let arguments = ["run", "drop.toml", "--threads", "1", "--out", "out", "--set", set[0], "--set", set[1]];
    assert_code(&meniscus(folder.path(), &arguments), 0);
    let mut reader = csv::Reader::from_path(folder.path().join("out/series.csv")).unwrap();
    let heads: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let row = reader.records().last().unwrap().unwrap();
    let value = |name: &str| row[heads.iter().position(|head| head == name).unwrap()].parse::<f64>().unwrap();
    for (of_meter, of_chip) in [
        ("kinetic_energy_J_per_m", "kinetic_energy_J"),
        ("wetting_area_m2", "wetting_volume_m3"),
        ("momentum_x_kg_per_m_s", "momentum_x_kg_m_per_s"),
        ("flow_rate_x_m2_per_s", "flow_rate_x_m3_per_s"),
        ("wetting_in_m2", "wetting_in_m3"),
    ] {
        assert!((1e-4 * value(of_meter) - value(of_chip)).abs() <= 1e-12 * value(of_chip).abs(), "{of_chip}");
    }
    // The rate of the case is that of the chip.
    assert!((value("flow_rate_x_m3_per_s") / 1.2e-12 - 1.0).abs() < 1e-6);
    let measures = &report(&folder.path().join("out"))["measures"];
    let asked = measures["asked-inflow-m3-per-s"]["value"].as_f64().unwrap();
    assert!((asked / 1.2e-12 - 1.0).abs() < 1e-12, "{measures}");
    assert_eq!(measures["asked-inflow-m3-per-s"]["unit"], "m3/s");
}

#[test]
fn what_floor_and_lid_leave_out_is_told_before_a_run() {
    let folder = folder_with_small_case();
    let told = |set: &[&str]| {
        let set: Vec<&str> = set.iter().flat_map(|config| ["--set", config]).collect();
        let output = meniscus(folder.path(), &[&["check", "drop.toml"], &set[..]].concat());
        assert_code(&output, 0);
        stdout(&output)
    };
    let posts = "geometry.shapes=[{disc={center=[1.5e-4,5.0e-4],radius=6e-5}},{disc={center=[8.5e-4,5.0e-4],radius=6e-5}},{disc={center=[1.5e-4,2.5e-4],radius=4e-5}}]";
    let fine = "sph.spacing=7.8e-6";
    let hysteresis = "sph.wetting={hysteresis={advancing-angle-deg=70.0,receding-angle-deg=50.0}}";
    let chip = told(&["geometry.depth=1e-4", hysteresis]);
    assert!(chip.contains("[sph.wetting.hysteresis] acts on lines along the walls"), "{chip}");
    assert!(!told(&["geometry.depth=1e-4"]).contains("acts on lines along the walls"));
    assert!(!told(&[hysteresis]).contains("acts on lines along the walls"));
    let flow = "sph.sides={left=\"periodic\",right=\"periodic\",open={left={velocity=0.02}}}";
    let wet = "sph.wetting.young.contact-angle-deg=15.0";
    assert!(told(&["geometry.depth=1e-4", flow, wet]).contains("leave films on floor and lid"));
    assert!(!told(&["geometry.depth=1e-4", flow]).contains("leave films on floor and lid"));
    let odd = told(&["geometry.depth=10.0", posts, fine]);
    assert!(odd.contains("times the widest throat"), "{odd}");
    let unlike = told(&["geometry.depth=1e-4", posts, fine]);
    assert!(unlike.contains("w/b  "), "{unlike}");
}
