//! Menisci in a slit from complete wetting to complete drying, and what the program says of angles and spacings that are hard.

use std::path::Path;

use crate::support::flow::flow;
use crate::support::program::{assert_code, meniscus, stdout};
use meniscus_case::MeasureSet;
use meniscus_sph::measures::Group;
use meniscus_sph::observe::Observation;
use meniscus_validation::requested_groups;
use serde_json::Value;

/// A meniscus between plates half a millimeter apart, 16 spacings across.
const SLIT: &str = r#"
format = 1
title = "A meniscus in a short slit"
[geometry]
min = [-4.0e-4, -2.5e-4] # m
max = [4.0e-4, 2.5e-4] # m
[sph]
spacing = 3.125e-5 # m
[sph.phases.wetting]
density = 1000.0 # kg/m3
viscosity = 0.01 # Pa s
[sph.phases.non-wetting]
density = 1000.0 # kg/m3
viscosity = 0.01 # Pa s
[sph.interface]
tension = 0.025 # N/m
[sph.wetting.young]
contact-angle-deg = 40.0 # degrees
[[sph.initial.wetting]]
rectangle = { center = [2.0e-3, 0.0], size = [4.0e-3, 4.0e-3] } # m
[time]
end = 0.01 # s
[output]
vtk.every-time = 0.01 # s
"#;

/// Half of the gap in m.
const HALF: f64 = 2.5e-4;
const TENSION: f64 = 0.025;

/// The measures of the slit at an angle in degrees, and the warnings.
fn measured(folder: &Path, degrees: f64) -> (Value, Value) {
    let name = format!("slit-{degrees}");
    let angle = format!("--set=sph.wetting.young.contact-angle-deg={degrees:?}");
    assert_code(&meniscus(folder, &["run", "slit.toml", "--out", &name, &angle]), 0);
    let report = std::fs::read(folder.join(name).join("report.json")).unwrap();
    let report: Value = serde_json::from_slice(&report).unwrap();
    (report["measures"].clone(), report["warnings"].clone())
}

#[test]
fn menisci_have_their_pressure_and_their_angle_within_the_bars_from_0_to_180_degrees() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("slit.toml"), SLIT).unwrap();
    // Degrees, and what pressure (relative) and angle (degrees) may be off: close to 0 and 180 the fluid at the wall is thinner than a spacing.
    for (degrees, of_pressure, of_angle) in [
        (0.0_f64, 5e-3, 10.0),
        (2.0, 5e-3, 7.0),
        (5.0, 5e-3, 3.5),
        (10.0, 2.3e-3, 0.4),
        (60.0, 1e-3, 0.25),
        (170.0, 2.3e-3, 0.4),
        (175.0, 5e-3, 3.5),
        (178.0, 5e-3, 7.0),
        (180.0, 5e-3, 10.0),
    ] {
        let (measures, warnings) = measured(folder.path(), degrees);
        let value = |name: &str, key: &str| measures[name][key].as_f64().unwrap_or(f64::NAN);
        let exact = TENSION * degrees.to_radians().cos() / HALF;
        let pressure = value("capillary-pressure-Pa", "value");
        assert!((pressure / exact - 1.0).abs() < of_pressure, "{degrees} degrees: {pressure} Pa, exact {exact}");
        let off = (pressure - exact).abs() / value("capillary-pressure-Pa", "uncertainty");
        assert!(off < 2.0, "{degrees} degrees: {pressure} Pa is {off} bars off");
        let off = (value("contact-angle-deg", "value") - degrees).abs();
        let within = off < of_angle && off < value("contact-angle-deg", "uncertainty");
        assert!(within, "{degrees} degrees: {}", measures["contact-angle-deg"]);
        let is_told = warnings.to_string().contains("complete wetting or drying");
        assert_eq!(is_told, degrees <= 10.0 || degrees >= 170.0, "{degrees}: {warnings}");
    }
}

#[test]
fn check_warns_of_low_drops_and_of_coarse_throats() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("slit.toml"), SLIT).unwrap();
    let told = |changes: &[&str]| {
        let output = meniscus(folder.path(), &[&["check", "slit.toml"], changes].concat());
        assert_code(&output, 0);
        stdout(&output)
    };
    assert!(!told(&[]).contains("WARNING"), "{}", told(&[]));
    let discs = "--set=geometry.shapes=[{ disc = { center = [-2.0e-4, -2.1e-4], radius = 1.0e-4 } }, \
                 { disc = { center = [-2.0e-4, 2.1e-4], radius = 1.0e-4 } }]";
    let coarse = told(&[discs]);
    assert!(coarse.contains("WARNING") && coarse.contains("7.0 particles across the narrowest throat"), "{coarse}");
    let drop = "--set=sph.initial.wetting=[{ disc = { center = [0.0, -2.5e-4], radius = 1.5e-4 } }]";
    let low = told(&[drop, "--set=sph.wetting.young.contact-angle-deg=20.0"]);
    assert!(low.contains("spacings high on a plane"), "{low}");
    let film = told(&[drop, "--set=sph.wetting.young.contact-angle-deg=0.0"]);
    assert!(film.contains("spreads to a film"), "{film}");
}

/// Base and height in m of a drop on the floor of a box that begins at `left` (m), whose left side is of the given kind.
fn extent(left: f64, kind: &str) -> Vec<f64> {
    let flow = flow(&format!(
        "format = 1\ntitle = \"A drop\"\n[geometry]\nmin = [{left:?}, 0.0]\nmax = [1.0e-3, 1.0e-3]\n[time]\nend = 1.0\n[sph]\nspacing = 4.0e-5\n\
         [sph.phases.wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n[sph.phases.non-wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n\
         [sph.interface]\ntension = 0.02\n[sph.wetting.young]\ncontact-angle-deg = 90.0\n[sph.sides]\nleft = \"{kind}\"\n\
         [[sph.initial.wetting]]\ndisc = {{ center = [0.0, 0.0], radius = 5.0e-4 }}\n"
    ));
    let set = MeasureSet { sessile_drop: true, ..MeasureSet::default() };
    let columns = |group: &Group| (group.columns)(&flow, &Observation::of(&flow, &[]));
    requested_groups(&set).iter().flat_map(columns).map(|(_, value)| value).collect()
}

/// Issue: half a drop beside a symmetry side has one contact line, and its base and height vanished.
#[test]
fn half_a_drop_beside_a_symmetry_side_has_the_base_and_height_of_the_whole_one() {
    let (whole, half) = (extent(-1.0e-3, "wall"), extent(0.0, "symmetry"));
    assert!((whole[0] / 1.0e-3 - 1.0).abs() < 0.01 && (whole[1] / 5.0e-4 - 1.0).abs() < 0.02, "{whole:?}");
    for (whole, half) in whole.iter().zip(&half) {
        assert!((half / whole - 1.0).abs() < 5e-3, "{whole} and {half}");
    }
}
