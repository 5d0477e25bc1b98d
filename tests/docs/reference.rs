//! The reference pages name what the program has, no more and no less: keys, defaults, shapes, presets, columns, arrays, measures,
//! report, exit codes, constants.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use meniscus::run::setup;
use meniscus_case::measures::{offers, offers_of_comparison};
use meniscus_case::preset::{Preset, State};
use meniscus_case::{load, schema};
use meniscus_core::input::Overrides;
use meniscus_core::input::tables::Words;
use meniscus_core::snapshot::{Field, Layer};
use meniscus_core::solver::Solver;
use meniscus_core::table::Column;

use crate::generated::{as_code, compare, filled, first_sentence, table};
use crate::keys::followed;
use crate::page::{Page, code, files, page, root, text};

/// The codes of the first cells, in their order.
fn names(rows: &[Vec<String>]) -> Vec<String> {
    rows.iter().flat_map(|row| code(&row[0])).collect()
}

fn set(names: impl IntoIterator<Item = impl Into<String>>) -> BTreeSet<String> {
    names.into_iter().map(Into::into).collect()
}

/// Whether a page, or a list, tells all that is `there` and no more.
fn tells_all(told: &BTreeSet<String>, there: &BTreeSet<String>, place: &str) {
    let [missing, surplus] = [(there, told), (told, there)].map(|(a, b)| a.difference(b).collect::<Vec<_>>());
    assert!(missing.is_empty() && surplus.is_empty(), "{place} lacks {missing:?} and has {surplus:?} too many");
}

/// The rows below the heading that contains `title`, up to the next heading.
fn section(page: &Page, title: &str) -> Vec<Vec<String>> {
    let (mut inside, mut text) = (false, String::new());
    for line in page.prose().lines() {
        if line.starts_with('#') {
            inside = line.contains(title);
        } else if inside {
            text += &format!("{line}\n");
        }
    }
    let rows = Page { path: page.path.clone(), text }.rows();
    assert!(!rows.is_empty(), "{} has no table below {title}", page.name());
    rows
}

#[test]
fn the_reference_names_every_word_that_a_key_can_be() {
    let schema = schema();
    let page = ["case-file", "presets", "shape-files"].map(|name| text(&format!("docs/reference/{name}.md"))).concat();
    let mut count = 0;
    for (definition, all) in schema["$defs"].as_object().into_iter().flatten() {
        for word in all["oneOf"].as_array().into_iter().flatten().filter_map(|one| one["const"].as_str()) {
            assert!(page.contains(&format!("`{word}`")), "{word} of {definition} is missing");
            count += 1;
        }
    }
    assert!(count > 40, "only {count} words");
}

#[test]
fn the_defaults_of_the_reference_are_those_of_the_program() {
    let rows = page("docs/reference/case-file.md").rows();
    for case in ["cases/poiseuille.toml", "cases/sessile-drop.toml", "cases/laplace-drop.toml", FILM, NETWORK] {
        let given = text(case);
        let resolved = load(&root().join(case), &Overrides::default()).unwrap().resolved;
        let table: toml::Table = resolved.parse().unwrap();
        for row in rows.iter().filter(|row| row.len() == 4) {
            let path = code(&row[0]).remove(0);
            let (Some(last), false) = (
                path.rsplit('.').next(),
                ["sph.phases", "network.phases", "thin-film.fluid"].iter().any(|fluid| path.starts_with(fluid)),
            ) else {
                continue;
            };
            let value =
                path.split('.').try_fold(toml::Value::Table(table.clone()), |value, key| value.get(key).cloned());
            let Some(value) = value.filter(|value| !value.is_table() && !value.is_array()) else { continue };
            let follows_the_case =
                path.ends_with("every-time") || path.ends_with("every-pore-volume") || row[2].contains("one spacing");
            if given.contains(&format!("\n{last} = ")) || follows_the_case || row[2].starts_with("required") {
                continue;
            }
            let told = &row[2];
            let is_told = match &value {
                toml::Value::Float(number) => told.split([' ', ';']).any(|word| word.parse() == Ok(*number)),
                toml::Value::String(word) => told.contains(&format!("`{word}`")),
                other => told.split([' ', ';']).any(|word| word == other.to_string()),
            };
            assert!(is_told, "{path} is {value} in {case}, the page says {told:?}");
        }
    }
}

#[test]
fn every_shape_and_its_keys_are_described() {
    let schema = schema();
    let shapes = schema["$defs"]["ShapeSpec"]["oneOf"].as_array().unwrap();
    let rows = section(&page("docs/reference/shape-files.md"), "Shapes");
    let described: BTreeMap<String, Vec<String>> =
        rows.iter().map(|row| (code(&row[0]).remove(0), code(&row[1]))).collect();
    let mut count = 0;
    for (shape, inner) in shapes.iter().filter_map(|one| one["properties"].as_object()).flatten() {
        let keys = followed(inner, &schema).1["properties"].as_object().unwrap();
        let told = described.get(shape).unwrap_or_else(|| panic!("{shape} is missing"));
        for key in keys.keys() {
            assert!(told.contains(key), "{key} of {shape} is missing");
        }
        count += 1;
    }
    assert_eq!(count, described.len());
}

#[test]
fn every_wetting_law_is_described_with_its_source() {
    let rows = page("docs/numerics/wetting.md").rows();
    let told: BTreeMap<String, &str> = rows.iter().map(|row| (code(&row[0]).remove(0), row[2].as_str())).collect();
    let laws = meniscus_wetting::laws();
    for law in &laws {
        let name = format!("[sph.wetting.{}]", law.key);
        let remedy =
            "the third cell of its row in docs/numerics/wetting.md is the source that ends the comment on the law";
        assert_eq!(told.get(&name), Some(&law.what_and_source().1), "{name}: {remedy}");
    }
    assert_eq!(told.len(), laws.len(), "docs/numerics/wetting.md has a row of no law");
}

#[test]
fn the_presets_of_the_reference_are_those_of_the_program() {
    let rows = page("docs/reference/presets.md").rows();
    let named = rows.iter().filter(|row| row[0].starts_with('`'));
    assert_eq!(named.count(), Preset::all().count());
    for preset in Preset::all() {
        let name = preset.word();
        let row = rows.iter().find(|row| row[0] == format!("`{name}`")).unwrap();
        if preset.pressures().is_some() || preset.solute().is_some() {
            let ascii = row[2].replace('ä', "ae").replace('ñ', "n");
            assert_eq!(ascii, preset.source(), "{name}");
            continue;
        }
        for (celsius, first) in [(20.0, 1), (25.0, 4)] {
            let known = preset.at(&State { celsius: Some(celsius), ..State::default() }).ok();
            let expected = [
                known.map(|known| known.density),
                known.map(|known| known.viscosity * 1e3),
                known.and_then(|known| known.tension).map(|tension| tension * 1e3),
            ];
            for (expected, cell) in expected.iter().zip(&row[first..]) {
                let told: Option<f64> = cell.parse().ok();
                // Table and source hold the same digits; the change of unit rounds the last bit.
                let same = expected
                    .zip(told)
                    .map_or(expected.is_none() && told.is_none(), |(a, b)| (a / b - 1.0).abs() < 1e-12);
                assert!(same, "{name} at {celsius}: {expected:?}, the page says {cell}");
            }
        }
    }
}

fn solver(case: &str) -> Box<dyn Solver> {
    setup::build(&load(&root().join(case), &Overrides::default()).unwrap().case).unwrap()
}

const FLOW: &str = "cases/poiseuille.toml";
const FILM: &str = "cases/thin-film/partial-wetting.toml";
const FILMS: &str = "cases/network/films.toml";
const NETWORK: &str = "cases/network/drainage.toml";
const IN_TIME: &str = "cases/network/dynamic.toml";

#[test]
fn every_column_of_the_series_is_described() {
    let in_time = (IN_TIME, "Series of a displacement in time");
    for (case, title) in [(FLOW, "# `series.csv`"), (FILM, "Film columns"), (NETWORK, "Network columns"), in_time] {
        let there = solver(case).sample().into_iter().map(|sample| sample.name).collect::<Vec<_>>();
        assert_eq!(of_plane(&page("docs/reference/output.md"), title), there);
    }
    let there = solver(FILMS).sample().into_iter().map(|sample| sample.name).collect::<Vec<_>>();
    assert_eq!(names(&section(&page("docs/reference/output.md"), "Network columns")), there);
}

/// Columns that only a chip with a depth, or a network with films, has.
const OF_DEPTH_OR_FILMS: [&str; 6] =
    ["volume_m3", "film_volume_m3", "conductance_m3", "inflow_m3_per_s", "snap_offs", "film_saturation"];

/// The columns that a section of the page has in the plane without films.
fn of_plane(page: &Page, title: &str) -> Vec<String> {
    names(&section(page, title)).into_iter().filter(|name| !OF_DEPTH_OR_FILMS.contains(&name.as_str())).collect()
}

/// The second words of the rows of a table in `crates/sph/src/measures/chip.rs`: names of values of all of the depth.
fn of_chip(table: &str) -> Vec<String> {
    let source = text("crates/sph/src/measures/chip.rs");
    let rows = source.split(&format!("const {table}:")).nth(1).and_then(|rest| rest.split("];").next()).unwrap();
    let names: Vec<String> = rows.lines().filter_map(|row| row.split('"').nth(3)).map(str::to_owned).collect();
    assert!(names.len() > 3, "{rows}");
    names
}

#[test]
fn every_column_of_a_depth_is_described() {
    assert_eq!(names(&section(&page("docs/reference/output.md"), "Series columns of a depth")), of_chip("COLUMNS"));
}

#[test]
fn every_array_is_described_with_its_unit() {
    for (case, title) in [(FLOW, "Arrays"), (FILM, "Film arrays")] {
        let solver = solver(case);
        let snapshot = solver.snapshot();
        let rows = section(&page("docs/reference/output.md"), title);
        let grid = snapshot.grid.as_ref().map(|grid| grid.fields.as_slice());
        let interface = snapshot.interface.as_ref().map(|lines| lines.fields.as_slice());
        let groups =
            [("particles", Some(snapshot.particles.fields.as_slice())), ("grid", grid), ("interface", interface)];
        tells(&rows, groups.into_iter().filter_map(|(name, fields)| Some((name, fields?))));
    }
}

#[test]
fn every_array_of_a_network_is_described_with_its_unit() {
    let solver = solver(NETWORK);
    let (regions, results) = (solver.layers(), solver.results());
    let rows = section(&page("docs/reference/output.md"), "Network arrays");
    let layers: Vec<Layer<'_>> = results.layers.iter().map(|layer| layer()).chain(regions).collect();
    tells(&rows, layers.iter().map(|layer| (layer.name, layer.fields.as_slice())));
    assert_eq!(layers.len(), 3);
}

#[test]
fn every_column_of_the_tables_of_a_network_is_described() {
    let solver = solver(NETWORK);
    let with_films = self::solver(FILMS);
    let page = page("docs/reference/output.md");
    // The columns of `openpnm.csv` are those of another program.
    let tables = |solver: &dyn Solver| -> Vec<(String, Vec<String>)> {
        let results = solver.results();
        let tables = results.tables.iter().map(|table| table()).filter(|table| table.name != "openpnm");
        let names = |columns: Vec<Column>| columns.iter().map(|column| column.name.to_owned()).collect();
        tables.map(|table| (format!("Columns of `{}.csv`", table.name), names(table.columns))).collect()
    };
    let (plane, with_films) = (tables(&*solver), tables(&*with_films));
    assert_eq!((plane.len(), with_films.len()), (4, 5));
    for (title, columns) in plane {
        assert_eq!(of_plane(&page, &title), columns);
    }
    for (title, columns) in with_films {
        assert_eq!(set(names(&section(&page, &title))), set(columns), "{title}");
    }
    let in_time = self::solver(IN_TIME);
    let events = in_time.results().tables.iter().map(|table| table()).find(|table| table.name == "events").unwrap();
    let there = events.columns.iter().map(|column| column.name.to_owned()).collect::<Vec<_>>();
    assert_eq!(of_plane(&page, "Events of a displacement in time"), there);
}

#[test]
fn every_file_of_a_network_is_described() {
    let solver = solver(NETWORK);
    let results = solver.results();
    let told: BTreeSet<String> =
        section(&page("docs/reference/output.md"), "Files of networks").iter().flat_map(|row| code(&row[0])).collect();
    let tables = results.tables.iter().map(|table| format!("{}.csv", table().name));
    let layers = results.layers.iter().map(|layer| format!("{}.vtu", layer().name));
    let regions = solver.layers().into_iter().map(|layer| format!("{}.pvd", layer.name));
    let diagrams = solver.diagrams().into_iter().map(|diagram| format!("diagram-{}.svg", diagram.name));
    let documents = results.documents.iter().map(|document| document.name.to_owned());
    for name in
        tables.chain(layers).chain(regions.collect::<Vec<_>>()).chain(diagrams.collect::<Vec<_>>()).chain(documents)
    {
        assert!(told.contains(&name), "{name} is missing");
    }
}

/// The third column names the files that have the array.
fn tells<'f>(rows: &[Vec<String>], files: impl Iterator<Item = (&'f str, &'f [Field<'f>])>) {
    for (file, fields) in files {
        let rows = rows.iter().filter(|row| row[2].split(", ").any(|name| name == file));
        let told = rows.flat_map(|row| code(&row[0]).into_iter().map(|name| (name, row[1].clone())));
        let there = fields.iter().map(|field| (field.name.to_owned(), field.unit.to_owned()));
        assert_eq!(told.collect::<BTreeSet<_>>(), there.collect::<BTreeSet<_>>(), "{file}");
    }
}

#[test]
fn every_measure_is_described() {
    let mut there = BTreeSet::new();
    const OTHERS: [&str; 4] = [
        "crates/film/src/measures.rs",
        "crates/network/src/measures.rs",
        "crates/network/src/dynamic/measures.rs",
        "src/run/compare/measures.rs",
    ];
    let others = OTHERS.map(|file| root().join(file));
    let of_flows = ["crates/sph/src/measures", "crates/validation/src"]
        .into_iter()
        .flat_map(|folder| files(&root().join(folder), &["rs"]));
    for file in of_flows.chain(others) {
        let source = std::fs::read_to_string(file).unwrap();
        let calls = source.split("measure(").skip(1).filter_map(|rest| rest.trim_start().strip_prefix('"'));
        there.extend(calls.filter_map(|rest| rest.split('"').next().map(str::to_owned)));
    }
    // A network names the measures that take long in lists.
    let source = std::fs::read_to_string(root().join("crates/network/src/measures.rs")).unwrap();
    let lists = source.split(": [&str; ").skip(1).filter_map(|rest| rest.split_once("];"));
    there.extend(lists.flat_map(|(list, _)| list.split('"').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>()));
    there.extend(of_chip("MEASURES"));
    there.insert(meniscus::run::report::STEADY_AT.to_owned());
    assert!(there.contains("contact-angle-deg") && there.contains("permeability-x-m2"), "{there:?}");
    tells_all(&set(names(&page("docs/reference/measures.md").rows())), &there, "docs/reference/measures.md");
    let cases = ["sessile-drop", "network/drainage", "network/dynamic", "thin-film/spreading-drop"];
    let known = cases.iter().flat_map(|case| {
        let loaded = load(&root().join(format!("cases/{case}.toml")), &Overrides::default()).unwrap();
        offers(&loaded.case.model, None, false)
    });
    let known = known.chain(offers_of_comparison()).flat_map(|offer| offer.names.iter().map(|name| (*name).to_owned()));
    let place = "the names that `[[expect]]` knows (crates/case/src/measures.rs, crates/case/src/measure_groups.rs)";
    tells_all(&known.collect(), &there, place);
}

#[test]
fn every_key_of_the_report_is_described() {
    let source = text("src/run/report.rs");
    let fields = source.split("pub struct Report {").nth(1).and_then(|rest| rest.split("\n}").next()).unwrap();
    let fields = fields.lines().filter_map(|line| line.trim().strip_prefix("pub ")?.split_once(':'));
    let there = set(fields.map(|(name, _)| name.replace('_', "-")));
    let rows = section(&page("docs/reference/output.md"), "report.json");
    tells_all(&set(rows.iter().flat_map(|row| code(&row[0]))), &there, "report.json in docs/reference/output.md");
}

#[test]
fn the_exit_codes_and_commands_of_the_reference_are_those_of_the_help() {
    let output = Command::new(env!("CARGO_BIN_EXE_meniscus")).arg("--help").output().unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    let page = page("docs/reference/command-line.md");
    let told = set(section(&page, "Exit codes").iter().map(|row| row[0].clone()));
    let codes = help.split("Exit codes:").nth(1).unwrap();
    assert_eq!(told, set(codes.split_whitespace().filter(|word| word.parse::<u8>().is_ok())));
    let commands = help.split("Commands:").nth(1).and_then(|rest| rest.split("\n\n").next()).unwrap();
    for name in commands.lines().filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help") {
        assert!(page.text.contains(&format!("`meniscus {name}")), "{name} is missing");
    }
}

/// A row of the table of constants: name, value, file, and the first sentence of the comment.
fn row_of_constant(file: &str, name: &str) -> [String; 4] {
    let source = text(file);
    let lines: Vec<&str> = source.lines().collect();
    let at = lines.iter().position(|line| line.contains(&format!("const {name}: ")));
    let at = at.unwrap_or_else(|| panic!("{file} has no {name}"));
    let comment = lines[..at].iter().rev().map_while(|line| line.strip_prefix("/// ")).collect::<Vec<_>>();
    let comment = comment.into_iter().rev().collect::<Vec<_>>().join(" ");
    let value = lines[at].split("= ").nth(1).unwrap_or_default().trim_end_matches(';');
    [as_code(&[name.to_owned()]), as_code(&[value.to_owned()]), as_code(&[file.to_owned()]), first_sentence(&comment)]
}

#[test]
fn the_table_of_constants_is_that_of_the_source() {
    let path = "docs/numerics/overview.md";
    let rows = |block: &str| {
        let mut file = "";
        let rows = block.split_whitespace().filter_map(|word| {
            if word.contains('/') {
                file = word;
            }
            (!word.contains('/')).then(|| row_of_constant(file, word))
        });
        table(["constant", "value", "file", "meaning"], &rows.collect::<Vec<_>>())
    };
    compare(path, &filled(&text(path), "constants", rows));
}
