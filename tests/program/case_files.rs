//! Case files: those of the project load, and each bad snippet gives the messages it names.
//!
//! `tests/bad-input/*.snippets`: snippets split by `+++` lines. A snippet of a case file is laid over the good case in
//! `tests/bad-input/good-case.toml`: its tables take the place of those of the same header, `#- [header]` takes one out.
//! `#^ message` below a line: this mistake at that line. `#! message`: a mistake at a line of the good case, such as the
//! header of a table that lacks a key. A snippet must give exactly the mistakes it names. Files whose name begins with
//! `shapes` hold whole shape files. `MENISCUS_BLESS=1 cargo test --test program case_files` writes the messages anew: read them.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use meniscus::run::setup::problems;
use meniscus_case::{Facts, check_against, load, load_default, load_shapes, starter_case};
use meniscus_core::input::{InputError, Overrides};
use meniscus_drawings::import::Options;
use proptest::prelude::*;

const GOOD: &str = include_str!("../bad-input/good-case.toml");

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn files(name: &str, extension: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder(name)).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|e| e == extension)).collect();
    files.sort();
    files
}

fn load_case_text(text: &str, overrides: &Overrides) -> Result<meniscus_case::Loaded, InputError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.toml");
    std::fs::write(&path, text).unwrap();
    load(&path, overrides)
}

fn mistakes_of(text: &str, is_shape_file: bool) -> Vec<(usize, String)> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file.toml");
    std::fs::write(&path, text).unwrap();
    let error = if is_shape_file {
        load_shapes(&path, &Options::default()).err()
    } else {
        load(&path, &Overrides::default()).err()
    };
    let mistakes = error.map_or(Vec::new(), |error| error.mistakes);
    let inside = folder.path().display().to_string();
    let place = |place: Option<(usize, usize)>| place.map_or(0, |(line, _)| line - 1);
    mistakes.into_iter().map(|m| (place(m.location), m.message.replace(&inside, "FOLDER"))).collect()
}

/// A line of the text that is loaded, and whether it is the snippet's own.
type Line = (String, bool);

/// The lines of `text` in blocks that begin at headers; the first block has the header "".
fn blocks(text: &str, own: bool) -> Vec<(String, Vec<Line>)> {
    let mut blocks = vec![(String::new(), Vec::new())];
    for line in text.lines() {
        let header = line.split('#').next().unwrap_or_default().trim();
        let inner = header.trim_matches(['[', ']']);
        let is_name = inner.chars().all(|c| c.is_alphanumeric() || c == '.' || c == '-');
        if header.starts_with('[') && header.ends_with(']') && is_name {
            blocks.push((header.to_owned(), Vec::new()));
        }
        blocks.last_mut().unwrap().1.push((line.to_owned(), own));
    }
    blocks
}

/// The good case with the tables of the snippet in place of its own.
fn laid_over(snippet: &str) -> Vec<Line> {
    let mut merged = blocks(GOOD, false);
    for header in snippet.lines().filter_map(|line| line.strip_prefix("#- ")) {
        merged.retain(|(name, _)| name != header.trim());
    }
    let own = blocks(snippet, true);
    let is_note = |line: &str| line.trim().is_empty() || line.starts_with("#-") || line.starts_with("#!");
    let has_top = own.iter().any(|(name, lines)| name.is_empty() && lines.iter().any(|(line, _)| !is_note(line)));
    let mut places = Vec::new();
    for (header, lines) in own.into_iter().filter(|(name, _)| has_top || !name.is_empty()) {
        let place = merged.iter().position(|(name, block)| *name == header && block.iter().all(|(_, own)| !own));
        match place {
            Some(place) => {
                merged[place].1 = lines;
                places.push((header, place));
            }
            // A second table of the same header stands behind the first.
            None => match places.iter().rfind(|(name, _)| *name == header) {
                Some((_, place)) => merged[*place].1.extend(lines),
                None => {
                    places.push((header.clone(), merged.len()));
                    merged.push((header, lines));
                }
            },
        }
    }
    merged.into_iter().flat_map(|(_, lines)| lines).collect()
}

/// The snippet with the messages that it gives written into it.
fn with_messages(snippet: &str, is_shape_file: bool) -> String {
    let clean: Vec<&str> = snippet.lines().filter(|line| !line.starts_with("#^") && !line.starts_with("#!")).collect();
    let clean = clean.join("\n");
    let lines: Vec<Line> =
        if is_shape_file { clean.lines().map(|line| (line.to_owned(), true)).collect() } else { laid_over(&clean) };
    let text: String = lines.iter().map(|(line, _)| format!("{line}\n")).collect();
    let mistakes = mistakes_of(&text, is_shape_file);
    let mut written = String::new();
    for line in clean.lines().filter(|line| line.starts_with("#-") && !is_shape_file) {
        let _ = writeln!(written, "{line}");
    }
    for (_, message) in mistakes.iter().filter(|(line, _)| lines.get(*line).is_none_or(|(_, own)| !own)) {
        let _ = writeln!(written, "#! {message}");
    }
    for (index, (line, _)) in lines.iter().enumerate().filter(|(_, (line, own))| *own && !line.starts_with("#-")) {
        let _ = writeln!(written, "{line}");
        for (_, message) in mistakes.iter().filter(|(line, _)| *line == index) {
            let _ = writeln!(written, "#^ {message}");
        }
    }
    written
}

const BLESS: &str = "where right is as meant, MENISCUS_BLESS=1 cargo test --test program case_files writes it";

#[test]
fn every_bad_snippet_gives_the_messages_it_names() {
    let mut count = 0;
    for path in files("tests/bad-input", "snippets") {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let text = std::fs::read_to_string(&path).unwrap();
        let snippets: Vec<&str> = text.split("+++\n").collect();
        let found: Vec<String> = snippets.iter().map(|s| with_messages(s, name.starts_with("shapes"))).collect();
        if std::env::var_os("MENISCUS_BLESS").is_some() {
            std::fs::write(&path, found.join("+++\n")).unwrap();
            count += snippets.len();
            continue;
        }
        for (number, (snippet, found)) in snippets.iter().zip(&found).enumerate() {
            assert!(found.contains("#^") || found.contains("#!"), "{name}, snippet {}: no mistake found", number + 1);
            assert_eq!(snippet, found, "{name}, snippet {}; {BLESS}", number + 1);
        }
        count += snippets.len();
    }
    assert!(count >= 60, "{count} bad snippets, 60 are wanted");
}

#[test]
fn every_case_of_the_project_loads_and_keeps_to_sixty_lines() {
    for path in files("cases", "toml") {
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.lines().count() <= 60, "{}", path.display());
        assert!(text.starts_with("# "), "{}: the first comment names the source", path.display());
        let loaded = load(&path, &Overrides::default()).unwrap_or_else(|error| panic!("{}", error.render()));
        // Other tests run them coarser.
        if let Err(error) = loaded.refuse(problems(&loaded.case)) {
            panic!("{}", error.render());
        }
    }
}

#[test]
fn a_resolved_case_loads_to_the_same_case() {
    for path in files("cases", "toml") {
        let loaded = load(&path, &Overrides::default()).unwrap();
        let again = load_case_text(&loaded.resolved, &Overrides::default())
            .unwrap_or_else(|error| panic!("{}", error.render()));
        assert_eq!(again.resolved, loaded.resolved, "{}", path.display());
        assert_eq!(again.case.geometry, loaded.case.geometry);
        assert_eq!(again.case.output, loaded.case.output);
        assert_eq!(again.case.expect, loaded.case.expect);
    }
}

#[test]
fn the_starter_case_the_good_case_and_the_built_in_case_load() {
    for text in [starter_case(), GOOD] {
        if let Err(error) = load_case_text(text, &Overrides::default()) {
            panic!("{}", error.render());
        }
    }
    let built_in = load_default(&Overrides::default()).unwrap();
    let on_disk = load(&folder("cases/four-discs.toml"), &Overrides::default()).unwrap();
    assert_eq!(built_in.case, on_disk.case);
    assert!(built_in.sources.is_empty());
    assert_eq!(on_disk.sources.len(), 2);
}

fn set(values: &[&str]) -> Result<meniscus_case::Loaded, InputError> {
    load_case_text(GOOD, &Overrides::parse(values)?)
}

#[test]
fn set_values_win_over_the_file_and_over_presets() {
    let values = [
        "sph.wetting.young.contact-angle-deg=60",
        "sph.phases.wetting.density=1000",
        "sph.sides.left=periodic",
        "sph.sides.right=periodic",
        "geometry.shapes[0].disc.radius=3e-4",
        "sph.initial.velocity={ uniform = [0.1, 0.2] }",
    ];
    let resolved = set(&values).unwrap().resolved;
    for line in ["density = 1000.0", "left = \"periodic\"", "radius = 0.0003", "uniform = [0.1, 0.2]"] {
        assert!(resolved.contains(line), "{line} in\n{resolved}");
    }
}

#[test]
fn a_wrong_set_value_is_named_with_its_place_on_the_command_line() {
    for (value, rendered) in [
        ("sph.spacing=fine", "--set sph.spacing=fine:1:13: expected a number, found the string \"fine\"\n"),
        ("sph.spacng=1e-5", "--set sph.spacng=1e-5:1:1: unknown key `spacng`\n"),
        ("sph.spacing=-1", "--set sph.spacing=-1:1:13: expected a spacing in m above 0, found -1.0\n"),
        ("sph.sides.left=round", "--set sph.sides.left=round:1:16: unknown name `round`\n"),
    ] {
        let error = set(&[value]).unwrap_err().render();
        assert!(error.starts_with(rendered), "{error}");
    }
}

#[test]
fn a_missing_case_file_is_named_with_its_resolved_path() {
    let error = load(Path::new("no/such.toml"), &Overrides::default()).unwrap_err().render();
    let resolved = std::env::current_dir().unwrap().join("no/such.toml");
    assert_eq!(
        error,
        format!("no/such.toml: there is no file {}\n  help: check the path of the case file\n", resolved.display())
    );
}

#[test]
fn mistakes_of_the_case_and_of_its_shape_file_come_together() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("s.toml"), "format = 1\nmin = [0, 0]\nmax = [1, 1]\nshape = []\n").unwrap();
    let case = folder.path().join("case.toml");
    std::fs::write(&case, "format = 2\ntitle = \"t\"\n[geometry]\nfile = \"s.toml\"\n").unwrap();
    let error = load(&case, &Overrides::default()).unwrap_err().render();
    for part in
        ["case.toml:1:10: expected format 1, found 2", "s.toml:4:1: unknown key `shape`", "did you mean `shapes`?"]
    {
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_case_can_cut_another_domain_out_of_its_shape_file() {
    let path = folder("cases/four-discs.toml");
    let load_with = |values: &[&str]| load(&path, &Overrides::parse(values).unwrap());
    let case = load_with(&["geometry.max=[1.3e-4, 1.1e-4]"]).unwrap().case;
    assert_eq!((case.geometry.min, case.geometry.max), ([-1.2e-4, -1.2e-4], [1.3e-4, 1.1e-4]));
    let error = load_with(&["geometry.max=[-2.0e-3, 1.0e-3]"]).unwrap_err().render();
    assert!(error.starts_with("--set geometry.max=[-2.0e-3, 1.0e-3]:1:14: "), "{error}");
}

#[test]
fn a_file_of_mistakes_ends_with_a_count_and_a_very_deep_one_does_not_exhaust_the_stack() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.toml");
    let head = "format = 1\nmin = [0, 0]\nmax = [1, 1]\n";
    let shapes = |shape: &str| format!("{head}shapes = [{}]\n", shape.repeat(200));
    for (text, last) in [
        (shapes("{ disc = { center = [0, 0], radius = -1 } },"), "there are 150 more mistakes"),
        (shapes("{ disc = { center = [0, 0], radios = 1 } },"), "there may be more mistakes"),
        (format!("{head}{}x = 1\n", "a.".repeat(100_000)), "recursion limit"),
        (format!("{head}x = {}\n", "[".repeat(100_000)), "cannot recurse further"),
    ] {
        std::fs::write(&path, text).unwrap();
        let error = load_shapes(&path, &Options::default()).unwrap_err();
        assert!(error.mistakes.len() <= 51, "{}", error.mistakes.len());
        let message = &error.mistakes.last().unwrap().message;
        assert!(message.contains(last), "{message}");
    }
}

#[test]
fn the_fancy_report_points_at_the_value() {
    let error = set(&["sph.spacing=-1"]).unwrap_err();
    let mut text = String::new();
    let handler = miette::GraphicalReportHandler::new_themed(miette::GraphicalTheme::unicode_nocolor());
    handler.render_report(&mut text, &error).unwrap();
    assert!(text.contains("sph.spacing=-1") && text.contains("here"), "{text}");
}

#[test]
fn a_throat_that_is_not_resolved_and_a_drop_in_the_solid_are_placed_in_the_case_file() {
    let loaded = set(&[]).unwrap();
    let facts = Facts {
        throat: Some((5.0e-5, meniscus_core::math::Vec2::zeros())),
        wall_distance: &|_| -1.0,
        in_initial_shape: &|_, point| point.norm() < 2.0e-4,
    };
    let error = loaded.refuse(check_against(&loaded.case, &facts)).unwrap_err().render();
    for part in
        ["and has 2.5 particles, at least 5 are needed", "a spacing of 1.00e-5 m or less", "entirely inside the solid"]
    {
        assert!(error.contains(part), "{error}");
    }
    // Half a width above the bottom wall of the domain.
    let at_side = Facts { throat: Some((5.0e-5, meniscus_core::math::Vec2::new(0.0, -9.75e-4))), ..facts };
    let error = loaded.refuse(check_against(&loaded.case, &at_side)).unwrap_err().render();
    let error = error.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
    for part in ["between a solid and the wall of the side `bottom`", "move that side until it cuts the solid"] {
        assert!(error.contains(part), "{error}");
    }
    let fine = Facts { throat: Some((1.0e-3, meniscus_core::math::Vec2::zeros())), wall_distance: &|_| 1.0, ..facts };
    assert!(loaded.refuse(check_against(&loaded.case, &fine)).is_ok());
}

#[test]
fn the_schema_has_a_description_for_every_key() {
    fn undescribed(value: &serde_json::Value, path: &str, found: &mut Vec<String>) {
        let properties = value.get("properties").and_then(|p| p.as_object());
        for (key, property) in properties.into_iter().flatten() {
            if property.get("description").is_none() {
                found.push(format!("{path}.{key}"));
            }
        }
        for (key, value) in value.as_object().into_iter().flatten() {
            undescribed(value, &format!("{path}/{key}"), found);
        }
    }
    let mut found = Vec::new();
    undescribed(&meniscus_case::schema(), "", &mut found);
    assert_eq!(found, Vec::<String>::new());
}

/// Bytes that are likely to reach odd corners of a TOML file.
const ODD: &[u8] = b"[]{}=.\"'#\n,-+eE_0x \t\\:inf\xff\xc3\x00";

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_change_of_bytes_makes_the_reader_panic(
        changes in prop::collection::vec((0..GOOD.len(), 0..3u8, 0..ODD.len()), 1..12)
    ) {
        let mut bytes = GOOD.as_bytes().to_vec();
        for (place, kind, odd) in changes {
            let place = place.min(bytes.len() - 1);
            match kind {
                0 => bytes[place] = ODD[odd],
                1 => bytes.insert(place, ODD[odd]),
                _ => { bytes.remove(place); }
            }
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("case.toml");
        std::fs::write(&path, bytes).unwrap();
        if let Err(error) = load(&path, &Overrides::default()) {
            prop_assert!(!error.render().is_empty());
        }
    }

    #[test]
    fn no_exchange_of_lines_makes_the_reader_panic(
        changes in prop::collection::vec((0..GOOD.lines().count(), 0..GOOD.lines().count()), 1..8)
    ) {
        let mut lines: Vec<&str> = GOOD.lines().collect();
        for (a, b) in changes {
            lines.swap(a, b);
        }
        let text = lines.join("\n");
        if let Err(error) = load_case_text(&text, &Overrides::default()) {
            prop_assert!(!error.render().is_empty());
        }
    }
}

#[test]
fn a_line_of_a_hundred_thousand_mistakes_is_told_shortly() {
    for letter in ["(", "-", "[", "0 ", "= "] {
        let error =
            load_case_text(&format!("format = 1\n{}\n", letter.repeat(100_000)), &Overrides::default()).unwrap_err();
        // The first one of the line, up to an open bracket: what follows is read but not explained.
        assert_eq!(error.mistakes.len(), 1, "{letter}");
        let report = format!("{:?}", miette::Report::new(error));
        assert!(report.len() < 50_000, "{letter}: a report of {} bytes", report.len());
    }
}

#[test]
fn a_film_in_scaled_units_that_is_steep_loads_again_as_resolved() {
    let steep = Overrides::parse(&["thin-film.droplets[0].height=3.75"]).unwrap();
    let loaded = load(&folder("cases/thin-film/axisymmetric.toml"), &steep).unwrap();
    let again = load_case_text(&loaded.resolved, &Overrides::default()).unwrap_or_else(|e| panic!("{}", e.render()));
    assert_eq!(again.resolved, loaded.resolved);
}
