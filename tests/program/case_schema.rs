//! The schema that editors use: it accepts all cases of the repository, refuses what the checks refuse, and its ranges are those of the
//! checks. The tables of the reference come from it (`tests/docs/keys.rs`).

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::program::SMALL;
use crate::support::python::{interpreter, root, run};
use meniscus_case::{load, schema};
use meniscus_core::input::Overrides;
use meniscus_geometry::spec::ShapeSpec;
use serde_json::Value;

/// What the schema says of each file: `valid`, or where it is wrong.
fn verdicts(folder: &Path, cases: &[PathBuf]) -> BTreeMap<PathBuf, String> {
    let file = folder.join("schema.json");
    std::fs::write(&file, schema().to_string()).unwrap();
    let mut command = Command::new(interpreter());
    command.arg(root().join("postprocess/tests/check_schema.py")).arg(file).args(cases);
    let printed = run(&mut command, "the schema must be one, and the cases TOML");
    let line = |line: &str| line.split_once('\t').map(|(file, verdict)| (PathBuf::from(file), verdict.to_owned()));
    let found: BTreeMap<_, _> = printed.lines().filter_map(line).collect();
    assert_eq!(found.len(), cases.len(), "{printed}");
    found
}

/// All case files of the repository.
fn cases() -> Vec<PathBuf> {
    let mut all = Vec::new();
    let mut open = vec![root().join("cases")];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                all.push(path);
            }
        }
    }
    all.sort();
    all
}

#[test]
fn the_schema_accepts_every_case_and_the_starter() {
    let folder = tempfile::tempdir().unwrap();
    let starter = folder.path().join("starter.toml");
    std::fs::write(&starter, meniscus_case::starter_case()).unwrap();
    // With every value present, also the ones that are defaults.
    let resolved = folder.path().join("resolved.toml");
    std::fs::write(&resolved, load(&cases()[0], &Overrides::default()).unwrap().resolved).unwrap();
    let all = [cases(), vec![starter, resolved]].concat();
    assert!(all.len() > 20, "{all:?}");
    let wrong: Vec<_> = verdicts(folder.path(), &all).into_iter().filter(|(_, verdict)| verdict != "valid").collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_schema_refuses_values_out_of_range_misspelled_keys_and_two_models_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let mistakes = [
        ("spacing = 4.0e-5", "spacing = -1.0", "$.sph.spacing: exclusiveMinimum"),
        ("contact-angle-deg = 60.0", "contact-angle-deg = 190.0", "$.sph.wetting.young.contact-angle-deg: maximum"),
        ("contact-angle-deg = 60.0", "contact-angle = 60.0", "$.sph.wetting.young: additionalProperties"),
        ("tension = 0.02", "tenson = 0.02", "$.sph.interface: additionalProperties"),
        ("tension = 0.02", "tension = \"high\"", "$.sph.interface.tension: type"),
        ("[time]", "[sph.wetting.kistler]\ncontact-angle-deg = 50.0\n[time]", "$.sph.wetting: oneOf"),
        ("[time]", "[network]\n[time]", "$: oneOf"),
        ("left = \"periodic\"", "left = \"periodical\"", "$.sph.sides.left: "),
        ("format = 1", "format = 2", "$.format: const"),
        ("title = \"A small drop\"", "", "$: required"),
        ("spacing = 4.0e-5", "", "$.sph: required"),
        ("contact-angle-deg = 60.0", "", "$.sph.wetting.young: required"),
    ];
    let mut files = Vec::new();
    for (number, (good, bad, _)) in mistakes.iter().enumerate() {
        assert!(SMALL.contains(good), "{good}");
        let file = folder.path().join(format!("{number}.toml"));
        std::fs::write(&file, SMALL.replacen(good, bad, 1)).unwrap();
        // What the schema is to refuse, the program refuses.
        assert!(load(&file, &Overrides::default()).is_err(), "{bad}");
        files.push(file);
    }
    let found = verdicts(folder.path(), &files);
    for (file, (_, bad, place)) in files.iter().zip(mistakes) {
        assert!(found[file].contains(place), "{bad}: {} instead of {place}", found[file]);
    }
}

/// The numbers of the schema with a range, by their path in the case file.
fn ranges(schema: &Value, whole: &Value, at: &str, found: &mut BTreeMap<String, [Option<(f64, bool)>; 2]>) {
    let followed = |schema: &Value| -> Value {
        let name = schema["$ref"].as_str().and_then(|name| name.strip_prefix("#/$defs/"));
        name.map_or_else(|| schema.clone(), |name| whole["$defs"][name].clone())
    };
    let schema = followed(schema);
    let table = if schema["items"].is_object() { followed(&schema["items"]) } else { schema.clone() };
    for (key, value) in table["properties"].as_object().into_iter().flatten() {
        ranges(value, whole, &if at.is_empty() { key.clone() } else { format!("{at}.{key}") }, found);
    }
    let limit = |closed: &str, open: &str| {
        schema[closed].as_f64().map(|limit| (limit, true)).or(schema[open].as_f64().map(|limit| (limit, false)))
    };
    let limits = [limit("minimum", "exclusiveMinimum"), limit("maximum", "exclusiveMaximum")];
    // Of unsigned numbers the type says as much.
    if limits != [None, None] && !schema["type"].as_str().is_some_and(|kind| kind == "integer" && limits[1].is_none()) {
        found.insert(at.to_owned(), limits);
    }
}

fn all_ranges() -> BTreeMap<String, [Option<(f64, bool)>; 2]> {
    let (whole, mut found) = (schema(), BTreeMap::new());
    ranges(&whole, &whole, "", &mut found);
    found.retain(|path, _| {
        !path.contains("shapes")
            && !path.starts_with("sph.initial.wetting")
            && !path.starts_with("sph.initial.non-wetting")
    });
    found
}

/// The path of a key in a case that has the table that it is in, the first one of an array; elsewhere another mistake could hide this one.
/// Tables of `[output]` are optional everywhere.
fn place(path: &str, case: &toml::Table) -> Option<String> {
    let (parent, key) = path.rsplit_once('.')?;
    if path.starts_with("output.") {
        return Some(path.to_owned());
    }
    let (mut table, mut place) = (case, String::new());
    for step in parent.split('.') {
        let value = table.get(step)?;
        table = value.as_array().map_or(Some(value), |all| all.first())?.as_table()?;
        place += &format!("{step}{}.", if value.is_array() { "[0]" } else { "" });
    }
    Some(place + key)
}

#[test]
fn the_checks_refuse_what_is_out_of_the_ranges_of_the_schema() {
    let (mut checked, mut unchecked) = (0, Vec::new());
    let read = |path: PathBuf| (std::fs::read_to_string(&path).unwrap().parse::<toml::Table>().unwrap(), path);
    let cases: Vec<(toml::Table, PathBuf)> = cases().into_iter().map(read).collect();
    for (path, [low, high]) in all_ranges() {
        let Some((place, case)) = cases.iter().find_map(|(case, file)| Some((place(&path, case)?, file))) else {
            unchecked.push(path);
            continue;
        };
        for (limit, side) in [(low, -1.0), (high, 1.0)] {
            let Some((limit, closed)) = limit else { continue };
            // Numbers of cycles and the like are whole.
            let step = if path == "network.cycles" { 1.0 } else { limit.abs().max(1.0) * 1.0e-3 };
            let outside = if closed { limit + side * step } else { limit };
            let text = if path == "network.cycles" { format!("{outside}") } else { format!("{outside:?}") };
            let set = Overrides::parse(&[format!("{place}={text}")]).unwrap();
            let loaded = load(case, &set).map(|_| ());
            let refused = loaded.expect_err(&format!("{place} = {text} in {}", case.display()));
            let (_, key) = path.rsplit_once('.').unwrap();
            let told = format!("{refused:?}");
            assert!(told.contains(key), "{place} = {text} is refused for another reason: {told}");
            checked += 1;
        }
    }
    // Models of wetting that no shipped case has share their types with those that one has.
    unchecked.retain(|path| !path.contains(".wetting."));
    // So do the other open sides with the left one.
    unchecked.retain(|path| !path.starts_with("sph.sides.open.") || path.starts_with("sph.sides.open.left."));
    assert!(checked > 90, "{checked}");
    assert_eq!(unchecked, ["thin-film.method.particles.tolerance"]);
}

/// A sound shape of each kind that has sizes.
fn shapes() -> Value {
    serde_json::json!({
        "disc": { "center": [0.0, 0.0], "radius": 1.0 },
        "rectangle": { "center": [0.0, 0.0], "size": [1.0, 1.0] },
        "capsule": { "ends": [[0.0, 0.0], [1.0, 0.0]], "radius": 1.0 },
        "channel": { "center": [0.0, 0.0], "width": 1.0 },
        "throat-discs": { "center": [0.0, 0.0], "radii": [1.0, 1.0], "gap": 1.0 },
        "throat-cosine": { "center": [0.0, 0.0], "width": 2.0, "throat": 1.0, "length": 1.0 },
        "random-pack": {
            "porosity": 0.8, "radius": 1.0, "radius-deviation": 0.1, "gap": 0.5, "region": [[0.0, 0.0], [20.0, 20.0]]
        },
        "array": { "arrangement": "square", "radius": 1.0, "gap": 1.0, "region": [[0.0, 0.0], [9.0, 9.0]] }
    })
}

#[test]
fn the_checks_of_shapes_refuse_what_is_out_of_the_ranges_of_the_schema() {
    let (whole, mut checked) = (schema(), 0);
    let kinds = whole["$defs"]["ShapeSpec"]["oneOf"].as_array().unwrap();
    for (kind, inner) in kinds.iter().filter_map(|one| one["properties"].as_object()).flatten() {
        let name = inner["$ref"].as_str().and_then(|name| name.strip_prefix("#/$defs/")).unwrap();
        for (key, value) in whole["$defs"][name]["properties"].as_object().unwrap() {
            let is_array = value["type"] == "array";
            let limits = if is_array { &value["items"] } else { value };
            for (keyword, beyond) in
                [("exclusiveMinimum", 0.0), ("exclusiveMaximum", 0.0), ("minimum", -1e-3), ("maximum", 1e-3)]
            {
                let Some(limit) = limits[keyword].as_f64().filter(|_| limits["type"] == "number") else { continue };
                let mut shape = serde_json::json!({ kind: shapes()[kind] });
                let sound: ShapeSpec = serde_json::from_value(shape.clone()).unwrap();
                assert!(sound.problems("shape").is_empty(), "{kind}: {:?}", sound.problems("shape"));
                let place = &mut shape[kind][key];
                *if is_array { &mut place[1] } else { place } = (limit + beyond).into();
                let bad: ShapeSpec = serde_json::from_value(shape).unwrap();
                let told = bad.problems("shape");
                assert!(told.iter().any(|problem| problem.path.ends_with(key)), "{key} of {kind}: {told:?}");
                checked += 1;
            }
        }
    }
    assert_eq!(checked, 17);
}
