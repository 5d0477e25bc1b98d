//! What the program tells without a run: `check`, `geometry`, `list`, `new`.

use std::path::Path;

use crate::support::program::{
    all_at_once, assert_code, folder_with_small_case, meniscus, meniscus_coarsely, shipped, stderr, stdout,
};

/// What follows `label` on its line of `text`.
#[track_caller]
fn line<'a>(text: &'a str, label: &str) -> &'a str {
    let found = text.lines().find_map(|line| line.trim_start().strip_prefix(label)).map(str::trim);
    found.unwrap_or_else(|| panic!("no line `{label}` in\n{text}"))
}

/// Fails unless `text` tells what a run of a case would be like; its spacing was `factor` times that of the case.
#[track_caller]
fn assert_tells_what_a_run_is_like(text: &str, case: &Path, factor: f64) {
    let particles: f64 = line(text, "particles").split(' ').next().unwrap().parse().unwrap();
    assert!((100.0..100_000.0).contains(&(factor * factor * particles)), "{}: {particles}", case.display());
    for label in ["memory", "time step", "run", "throat", "Re"] {
        line(text, label);
    }
    assert!(line(text, "time step").contains("ruled by"), "{text}");
    let written = std::fs::read_to_string(case).unwrap();
    // The numbers of an interface are those of its tension; one case has an interface without, and a frozen one does not act.
    let is_frozen = written.contains("[sph.measure.relative-permeability]");
    if written.contains("[sph.interface]") && !written.contains("tension = 0.0 ") && !is_frozen {
        for number in ["Ca", "We", "Bo", "Oh", "La"] {
            line(text, number);
        }
        let named = ["throat", "drop", "shorter side"].iter().any(|name| line(text, "L ").contains(name));
        assert!(named, "{text}");
    }
}

/// The part of the largest case that `chip-direct.toml` has.
const PART_OF_CHIP: [&str; 3] = [
    "--set=geometry.window=[[0.0, 1.5e-3], [4.5e-3, 4.5e-3]]",
    "--set=sph.sides.bottom=symmetry",
    "--set=sph.sides.top=symmetry",
];

#[test]
fn check_tells_what_a_run_of_each_case_would_be_like() {
    let folder = tempfile::tempdir().unwrap();
    let mut cases = shipped("cases", &["toml"]);
    // It is checked below.
    cases.retain(|case| !case.ends_with(AT_REST));
    all_at_once(&cases, |case| {
        let more = if case.ends_with("chip-oil.toml") { &PART_OF_CHIP[..] } else { &[] };
        let (output, factor) = meniscus_coarsely(folder.path(), "check", case, more);
        assert_code(&output, 0);
        assert_tells_what_a_run_is_like(&stdout(&output), case, factor);
    });
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "check writes nothing");
}

#[test]
fn check_tells_the_resolution_of_the_narrowest_throat_and_takes_it_as_length() {
    let folder = folder_with_small_case();
    // Two discs of R = 0.2 mm with 0.1 mm between them, in a periodic box.
    let arguments = [
        "check",
        "drop.toml",
        "--set=geometry.shapes=[{ disc = { center = [2.5e-4, 3.0e-4], radius = 2.0e-4 } }, \
         { disc = { center = [7.5e-4, 3.0e-4], radius = 2.0e-4 } }]",
        "--set=sph.sides.bottom=periodic",
        "--set=sph.sides.top=periodic",
        "--set=sph.spacing=1e-5",
    ];
    let output = meniscus(folder.path(), &arguments);
    assert_code(&output, 0);
    let text = stdout(&output);
    assert!(line(&text, "throat").starts_with("10.0 particles across the narrowest one, 1.000e-4 m"), "{text}");
    assert!(line(&text, "L ").starts_with("= 1.000e-4 m, width of the narrowest throat"), "{text}");
    // La = sigma rho L/mu^2 = 0.02 x 800 x 1e-4/(8e-3)^2.
    assert!(line(&text, "La").starts_with("25.00"), "{text}");
    let coarse = meniscus(folder.path(), &[&arguments[..5], &["--set=sph.spacing=2.5e-5"]].concat());
    assert_code(&coarse, 3);
    assert!(stderr(&coarse).contains("4.0 particles, at least 5 are needed"), "{}", stderr(&coarse));
}

/// A case that begins with the state of a network.
const AT_REST: &str = "cases/from-network.toml";

#[test]
fn check_advises_which_model_can_answer() {
    let folder = tempfile::tempdir().unwrap();
    let case = |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join(name).display().to_string();
    let direct = case(AT_REST);
    let output = meniscus(folder.path(), &["check", &direct]);
    assert_code(&output, 0);
    let fine = stdout(&output);
    assert_tells_what_a_run_is_like(&fine, Path::new(&direct), 1.0);
    assert!(line(&fine, "network").starts_with("20 pores and 33 throats"), "{fine}");
    assert!(line(&fine, "direct").contains("8.0 spacings across the narrowest throat"), "{fine}");
    assert!(line(&fine, "ADVICE").contains("the direct simulation is feasible"), "{fine}");
    let coarse = stdout(&meniscus(folder.path(), &["check", &direct, "--set", "sph.spacing=9e-6"]));
    let advice = line(&coarse, "ADVICE");
    assert!(
        advice.starts_with("5.6 spacings across the narrowest throat at this spacing: use the network"),
        "{advice}"
    );
    let json = stdout(&meniscus(folder.path(), &["check", &case("cases/network/hand-over.toml"), "--json"]));
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["advice"]["pores"], 20);
    assert!(json["advice"]["sentence"].as_str().unwrap().starts_with("use the network"));
    assert!(json["warnings"].is_array() && json["steps"].is_number());
}

#[test]
fn geometry_measures_and_draws_every_shape_file() {
    let folder = tempfile::tempdir().unwrap();
    for file in shipped("geometries", &["toml", "xyr", "wkt"]) {
        let out = folder.path().join(file.file_name().unwrap());
        let output = meniscus(folder.path(), &["geometry", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
        assert_code(&output, 0);
        let text = stdout(&output);
        // Value, unit where there is one, and how it was found.
        let (porosity, method) = line(&text, "porosity").split_once(' ').unwrap();
        let porosity: f64 = porosity.parse().unwrap();
        assert!(porosity > 0.1 && porosity < 1.0, "{}: {porosity}", file.display());
        assert_eq!(method.trim(), "share of the domain that is not solid, exact along the outline");
        let surface: Vec<&str> = line(&text, "specific-surface-per-m").split_whitespace().collect();
        assert_eq!(surface[1..3], ["1/m", "wall"], "{text}");
        assert!(surface[0].parse::<f64>().is_ok_and(|surface| surface > 0.0), "{text}");
        for name in ["solid.vtu", "distance.vtu", "picture.png"] {
            let length = std::fs::metadata(out.join(name)).unwrap().len();
            assert!(length > 500, "{}: {name} has {length} bytes", file.display());
        }
    }
}

/// A disc on the corner of a box, with the walls of a case or joined sides.
#[test]
fn geometry_sees_the_sides_of_a_case_and_those_it_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "corner.toml",
        "format = 1\nmin = [0.0, 0.0]\nmax = [1.0e-3, 1.0e-3]\nshapes = [{ disc = { center = [0.0, 0.0], radius = 2.0e-4 } }]\n",
    );
    let case = |sides: &str| {
        format!(
            "format = 1\ntitle = \"A corner\"\n[geometry]\nfile = \"corner.toml\"\n[sph]\nspacing = 2.0e-5\n[sph.phases.wetting]\n\
             density = 1000.0\nviscosity = 1.0e-3\n[sph.sides]\n{sides}\n[time]\nend = 1.0e-3\n"
        )
    };
    write("joined.toml", &case("left = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\""));
    write("walled.toml", &case("left = \"wall\"\nright = \"wall\"\nbottom = \"symmetry\"\ntop = \"wall\""));
    let told = |arguments: &[&str]| {
        let output = meniscus(folder.path(), &[&["geometry"], arguments].concat());
        assert_code(&output, 0);
        stdout(&output)
    };
    let porosity = |text: &str| line(text, "porosity").split_whitespace().next().unwrap().parse::<f64>().unwrap();
    let quarter = std::f64::consts::PI * 0.04 / 4.0;
    // Four digits are told.
    let (box_alone, joined) = (told(&["corner.toml"]), told(&["joined.toml"]));
    assert!((porosity(&box_alone) - (1.0 - quarter)).abs() < 1e-4);
    assert!((porosity(&joined) - (1.0 - 4.0 * quarter)).abs() < 1e-4);
    assert!(line(&box_alone, "sides").starts_with("none"), "{box_alone}");
    assert!(line(&joined, "sides").contains("left periodic, right periodic, bottom periodic, top periodic"));
    // The gaps between the disc and its own images.
    assert!(line(&joined, "throat-1-width-m").starts_with("6.000e-4"), "{joined}");
    assert_eq!(porosity(&told(&["corner.toml", "--periodic", "xy"])), porosity(&joined));
    assert!((porosity(&told(&["corner.toml", "--periodic", "y"])) - (1.0 - 2.0 * quarter)).abs() < 1e-4);
    let walled = told(&["walled.toml"]);
    assert!(line(&walled, "sides").contains("left wall, right wall, bottom open, top wall"), "{walled}");
    // From the disc to the opposite wall.
    assert!(line(&walled, "throat-1-width-m").starts_with("8.000e-4"), "{walled}");
    assert_code(&meniscus(folder.path(), &["geometry", "walled.toml", "--periodic", "x"]), 2);
}

#[test]
fn the_list_names_every_model_with_its_source() {
    let folder = tempfile::tempdir().unwrap();
    let text = stdout(&meniscus(folder.path(), &["list"]));
    for (model, source) in [
        ("[sph]", "Huber et al. 2013"),
        ("[sph.surface-force.csf]", "Brackbill et al. 1992"),
        ("[sph.wetting.young]", "Huber et al. 2013, Eqs. 7 and 23"),
        ("\"szewc\"", "Szewc et al. 2012"),
        ("\"morris\"", "Morris et al. 1997"),
        ("sph.sides: image", "Huber et al. 2013"),
    ] {
        assert!(text.lines().any(|line| line.contains(model) && line.contains(source)), "{model} {source}\n{text}");
    }
}

#[test]
fn the_starter_case_can_be_checked_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    assert_code(&meniscus(folder.path(), &["new"]), 0);
    assert_code(&meniscus(folder.path(), &["check", "case.toml"]), 0);
}

/// The small case with other text, and a shape.
fn with_shape(shape: &str, changes: &[(&str, &str)]) -> String {
    let domain = "max = [1.0e-3, 6.0e-4] # m\n";
    let mut text = crate::support::program::SMALL.replace(domain, &format!("{domain}shapes = [{{ {shape} }}]\n"));
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

#[test]
fn what_keeps_a_solver_from_being_made_is_told_at_the_key_to_change() {
    let open = [
        ("spacing = 4.0e-5", "spacing = 3.0e-5"),
        ("left = \"periodic\"", "left = \"inlet\""),
        ("right = \"periodic\"", "right = \"outlet\"\n[sph.sides.open.left]\nvelocity = 0.01\nprofile = \"parabolic\""),
    ];
    let direct = |shape: &str| with_shape(shape, &open);
    let network = |shape: &str, keys: &str| {
        format!(
            "format = 1\ntitle = \"A network\"\n[geometry]\nmin = [0.0, 0.0]\nmax = [1.0e-3, 6.0e-4]\nshapes = [{shape}]\n[network]\n{keys}\n\
             [network.interface]\ntension = 0.02\n[network.wetting.young]\ncontact-angle-deg = 40.0\n"
        )
    };
    let disc = "{ disc = { center = [5.0e-4, 3.0e-4], radius = 1.0e-4 } }";
    let block = "{ rectangle = { center = [0.0, 3.0e-4], size = [2.0e-4, 2.0e-3] } }";
    for (text, key, message) in [
        (
            direct("rectangle = { center = [0.0, 3.0e-4], size = [2.0e-4, 2.0e-3] }"),
            "left =",
            "block the open side `left`",
        ),
        (
            direct("rectangle = { center = [1.0e-4, 3.0e-4], size = [2.0e-4, 2.0e-4] }"),
            "left =",
            "ends at the open side",
        ),
        (direct("rectangle = { center = [0.0, 3.0e-4], size = [2.0e-4, 2.0e-4] }"), "profile =", "2 openings"),
        (
            network(
                "",
                "sides = { left = \"periodic\", right = \"periodic\", bottom = \"periodic\", top = \"periodic\" }",
            ),
            "[geometry]",
            "no wall lies",
        ),
        (network(&[disc, block].join(", "), "inlet = \"left\""), "inlet =", "no pore opens at the side `left`"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("case.toml"), &text).unwrap();
        let line = 1 + text.lines().position(|line| line.contains(key)).unwrap();
        for command in ["check", "run"] {
            let output = meniscus(folder.path(), &[command, "case.toml"]);
            assert_code(&output, 3);
            // Lines of a long message begin with a bar.
            let told = stderr(&output).replace("│ ", "");
            assert!(told.contains(message) && told.contains(&format!("[case.toml:{line}:")), "line {line}: {told}");
            assert!(told.contains("help:"), "{told}");
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing is written");
    }
}

#[test]
fn a_grid_of_the_output_is_bounded_by_the_domain() {
    let folder = folder_with_small_case();
    // 25 by 15 spacings.
    for (ratio, message) in [("15.5", "would be 15.5 spacings apart"), ("0.2", "from 0.25 to 100.0")] {
        let output = meniscus(folder.path(), &["check", "drop.toml", &format!("--set=output.grid.ratio={ratio}")]);
        assert_code(&output, 3);
        assert!(stderr(&output).contains(message), "{}", stderr(&output));
    }
    assert_code(&meniscus(folder.path(), &["check", "drop.toml", "--set=output.grid.ratio=15.0"]), 0);
    // Two million particles, and sixteen times as many nodes.
    let fine = ["check", "drop.toml", "--set=sph.spacing=5.4e-7", "--set=output.grid.ratio=0.25"];
    let output = meniscus(folder.path(), &fine);
    assert_code(&output, 3);
    assert!(stderr(&output).contains("3.3e7 nodes") && stderr(&output).contains("0.33 or more"), "{}", stderr(&output));
}
