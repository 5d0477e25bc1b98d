//! Study files: each bad snippet gives exactly the mistakes it names, at their lines.
//!
//! `tests/bad-study/*.snippets`: whole study files split by `+++` lines, beside a case `drop.toml`, a network `pack.toml`, a table `t.csv` and a
//! table `ragged.csv`. `#^ message` below a line: this mistake at that line; messages are told up to a given length, so that
//! lists of known names may grow. `MENISCUS_BLESS=1 cargo test --test study files::` writes the messages anew: read them.

use std::path::Path;

use crate::support::program::{all_at_once, shipped};
use meniscus::study::load::load;
use meniscus::study::runs::{plan, runs};
use meniscus_core::input::InputError;

/// Longest message in a snippet.
const LONGEST: usize = 90;

/// A network of other shapes than those of `drop.toml`.
const PACK: &str = r#"
format = 1
title = "Drainage between two discs"
[geometry]
min = [0.0, 0.0]
max = [1.0e-3, 6.0e-4]
[[geometry.shapes]]
disc = { center = [5.0e-4, 1.0e-4], radius = 1.5e-4 }
[[geometry.shapes]]
disc = { center = [5.0e-4, 5.0e-4], radius = 1.5e-4 }
[network]
inlet = "left"
outlet = "right"
[network.interface]
tension = 0.02
[network.wetting.young]
contact-angle-deg = 60.0
"#;

fn folder_with(text: &str) -> tempfile::TempDir {
    let folder = crate::support::program::folder_with_small_case();
    std::fs::write(folder.path().join("t.csv"), "angle,exact,side\n50,1.5,wall\n70,2.5,periodic\n").unwrap();
    std::fs::write(folder.path().join("ragged.csv"), "angle,exact\n50,1.5\n70\n").unwrap();
    std::fs::write(folder.path().join("pack.toml"), PACK).unwrap();
    std::fs::write(folder.path().join("study.toml"), text).unwrap();
    folder
}

/// The mistakes of a study and of its cases: line from 1 (0 for a whole file) and message.
fn mistakes_of(text: &str) -> Vec<(usize, String)> {
    let folder = folder_with(text);
    let path = folder.path().join("study.toml");
    let error = match load(&path) {
        Ok(study) => plan(&study).err(),
        Err(error) => Some(error),
    };
    let here = format!("{}/", folder.path().display());
    let message = |text: &str| text.replace(&here, "").chars().take(LONGEST).collect::<String>();
    let mistakes = error.map_or(Vec::new(), |error: InputError| error.mistakes);
    mistakes.iter().map(|m| (m.location.map_or(0, |place| place.0), message(&m.message))).collect()
}

/// The snippet with the messages that it gives.
fn with_messages(snippet: &str) -> String {
    let lines: Vec<&str> = snippet.lines().filter(|line| !line.starts_with("#^ ")).collect();
    let found = mistakes_of(&(lines.join("\n") + "\n"));
    let mut text = String::new();
    for (number, line) in std::iter::once("").chain(lines.iter().copied()).enumerate() {
        if number > 0 {
            text += &format!("{line}\n");
        }
        text.extend(found.iter().filter(|(at, _)| *at == number).map(|(_, message)| format!("#^ {message}\n")));
    }
    text
}

const BLESS: &str = "where right is as meant, MENISCUS_BLESS=1 cargo test --test study files:: writes it";

#[test]
fn every_bad_study_gives_the_messages_it_names() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad-study/studies.snippets");
    let text = std::fs::read_to_string(&path).unwrap();
    let snippets: Vec<&str> = text.split("+++\n").collect();
    let found: Vec<String> = snippets.iter().map(|snippet| with_messages(snippet)).collect();
    if std::env::var_os("MENISCUS_BLESS").is_some() {
        std::fs::write(&path, found.join("+++\n")).unwrap();
    } else {
        for (number, (snippet, found)) in snippets.iter().zip(&found).enumerate() {
            assert!(found.contains("#^ "), "snippet {}: no mistake found", number + 1);
            assert_eq!(snippet, found, "snippet {}; {BLESS}", number + 1);
        }
    }
    assert!(snippets.len() >= 20, "{} bad studies", snippets.len());
}

#[test]
fn the_runs_are_all_combinations_and_their_names_tell_them() {
    let text = r#"
format = 1
title = "All kinds of axes"
set = ["time.end=1e-4"]
[[axis]]
cases = ["drop.toml", "./drop.toml"]
[[axis]]
table = "t.csv"
columns = { angle = "sph.wetting.young.contact-angle-deg", side = "sph.sides.bottom" }
[[axis]]
key = "sph.spacing"
range = { from = 5e-5, to = 2e-5, count = 2 }
"#;
    let folder = folder_with(&text.replace("\"./drop.toml\"", "\"other.toml\"").replace("periodic", "wall"));
    std::fs::copy(folder.path().join("drop.toml"), folder.path().join("other.toml")).unwrap();
    std::fs::write(folder.path().join("t.csv"), "angle,exact,side\n50,1.5,wall\n70,2.5,symmetry\n").unwrap();
    let study = load(&folder.path().join("study.toml")).unwrap_or_else(|error| panic!("{}", error.render()));
    let all = runs(&study);
    let names: Vec<&str> = all.iter().map(|run| run.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "case=drop_angle=50_spacing=5e-5",
            "case=drop_angle=50_spacing=2e-5",
            "case=drop_angle=70_spacing=5e-5",
            "case=drop_angle=70_spacing=2e-5",
            "case=other_angle=50_spacing=5e-5",
            "case=other_angle=50_spacing=2e-5",
            "case=other_angle=70_spacing=5e-5",
            "case=other_angle=70_spacing=2e-5",
        ]
    );
    assert_eq!(all.iter().map(|run| run.index).collect::<Vec<_>>(), (1..=8).collect::<Vec<_>>());
    let planned = plan(&study).unwrap_or_else(|error| panic!("{}", error.render()));
    let resolved: toml::Table = planned[3].resolved.parse().unwrap();
    assert_eq!(resolved["sph"]["sides"]["bottom"].as_str(), Some("symmetry"));
    assert_eq!(resolved["sph"]["spacing"].as_float(), Some(2.0e-5));
    assert_eq!(resolved["time"]["end"].as_float(), Some(1.0e-4));
    // The same values give the same digest, whichever base case they came from.
    assert_eq!(planned[3].digest(), planned[7].digest());
    assert_ne!(planned[2].digest(), planned[3].digest());
}

#[test]
fn every_shipped_study_can_be_planned() {
    let folders = ["studies", "studies/thin-film", "studies/validation"];
    let studies: Vec<_> = folders.into_iter().flat_map(|folder| shipped(folder, &["toml"])).collect();
    all_at_once(&studies, |study| {
        let study = load(study).unwrap_or_else(|error| panic!("{}", error.render()));
        let runs = plan(&study).unwrap_or_else(|error| panic!("{}", error.render()));
        // Two where a study holds two methods or two lengths against each other; a single run is a case.
        assert!(runs.len() >= 2, "{}", study.name);
    });
}
