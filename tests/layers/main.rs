//! The structure of the source beyond what Cargo says: within a package, no circles of imports; printing, files and libraries for one purpose in their places.
//!
//! Which package may use which, and which library, is said by the manifests in `crates`. The sources are read as text: comments are cut off.

mod circles;
mod picture;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Words that belong to one place: the word, and the files that may hold it, by the beginning of their path.
const ONE_PLACE: [(&str, &[&str]); 7] = [
    ("println!", &["src/cli/"]),
    ("eprintln!", &["src/cli/"]),
    ("print!", &["src/cli/"]),
    ("eprint!", &["src/cli/"]),
    ("dbg!", &[]),
    // Pipes of other processes are called so too.
    ("stdout", &["src/cli/", "src/study/child.rs"]),
    ("stderr", &["src/cli/", "src/study/child.rs"]),
];

/// Libraries of the program for one purpose, with the files that may use them, by the beginning of their path.
const PLACES: [(&str, &[&str]); 13] = [
    ("clap", &["src/cli/"]),
    ("clap_complete", &["src/cli/"]),
    ("clap_mangen", &["src/cli/"]),
    ("cpu_time", &["src/run/processor_time.rs"]),
    ("ctrlc", &["src/cli/"]),
    ("indicatif", &["src/cli/"]),
    // Errors in input carry their place as `miette` wants it; only the command line prints them.
    ("miette", &["src/cli/", "crates/core/src/input/error.rs", "crates/core/src/input/excerpt.rs"]),
    ("mimalloc", &["src/main.rs"]),
    // Packs of grains, and throats by chance.
    ("rand_chacha", &["crates/geometry/src/pack/", "src/verify/choose.rs"]),
    ("raw_cpuid", &["src/cli/"]),
    ("signal_hook", &["src/cli/"]),
    ("sobol_burley", &["src/study/sampling/"]),
    ("statrs", &["src/study/sampling/"]),
];

/// Packages without files, environment and processes.
const PHYSICS: [&str; 5] = ["geometry", "wetting", "sph", "film", "validation"];

/// A source file: its path below the root and its lines without comments.
struct Source {
    path: String,
    lines: Vec<String>,
}

impl Source {
    /// The package that it belongs to, `meniscus` for the program, and its path below the source of it.
    fn place(&self) -> (&str, &str) {
        let of_crate = self.path.strip_prefix("crates/").and_then(|rest| rest.split_once("/src/"));
        of_crate.unwrap_or_else(|| ("meniscus", self.path.trim_start_matches("src/")))
    }

    /// Whether it holds tests only.
    fn is_of_tests(&self) -> bool {
        self.path.ends_with("/tests.rs") || self.path.contains("/tests/")
    }

    /// The text up to its tests.
    fn code(&self) -> String {
        let text = self.lines.join("\n");
        text.split("#[cfg(test)]").next().unwrap_or_default().to_owned()
    }

    fn line(&self, number: usize) -> String {
        format!("{}:{}", self.path, number + 1)
    }
}

/// The packages in `crates` by the names of their folders.
fn packages() -> Vec<String> {
    let entries = std::fs::read_dir(root().join("crates")).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn sources() -> Vec<Source> {
    let folders = packages().into_iter().map(|name| root().join("crates").join(name).join("src"));
    let mut files = Vec::new();
    folders.chain([root().join("src")]).for_each(|folder| collect(&folder, &mut files));
    files.sort();
    let source = |file: PathBuf| Source {
        path: file.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/"),
        lines: std::fs::read_to_string(&file).unwrap().lines().map(|line| without_comment(line).to_owned()).collect(),
    };
    files.into_iter().map(source).collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// The line up to `//` outside of a string literal.
fn without_comment(line: &str) -> &str {
    let (mut in_string, mut escaped) = (false, false);
    for (i, c) in line.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' if in_string => escaped = true,
            '"' => in_string = !in_string,
            '/' if !in_string && line[i..].starts_with("//") => return &line[..i],
            _ => {}
        }
    }
    line
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_' || c == '!'
}

/// Whether `line` holds `word` with no letter beside it.
fn holds(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(at, _)| {
        !line[..at].ends_with(is_word)
            && !line[at + word.len()..].starts_with(|c: char| c.is_alphanumeric() || c == '_')
    })
}

/// The first parts of the paths behind each `prefix` of a text with their lines.
fn heads_behind(text: &str, prefix: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    // `$crate` names a macro of the package.
    let is_path = |&(at, _): &(usize, &str)| !text[..at].ends_with('$');
    for (at, path) in text.match_indices(prefix).filter(is_path) {
        let line = text[..at].matches('\n').count();
        let rest = &text[at + path.len()..];
        if let Some(group) = rest.strip_prefix('{') {
            found.extend(group_heads(group).into_iter().map(|head| (line, head)));
        } else {
            found.push((line, rest.chars().take_while(|&c| is_word(c)).collect()));
        }
    }
    found
}

/// The first part of each path of an import group, given what follows its opening brace.
fn group_heads(group: &str) -> Vec<String> {
    let (mut depth, mut heads, mut head, mut taking) = (1, Vec::new(), String::new(), true);
    for c in group.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 || (depth == 1 && c == ',') {
            heads.push(std::mem::take(&mut head));
            taking = true;
        } else if depth == 1 && taking && is_word(c) {
            head.push(c);
        } else if !c.is_whitespace() {
            taking = false;
        }
        if depth == 0 {
            break;
        }
    }
    heads.retain(|head| !head.is_empty());
    heads
}

fn assert_none(violations: &[String]) {
    assert!(violations.is_empty(), "\n{}", violations.join("\n"));
}

/// The packages that each package uses, from its manifest.
fn uses_of_packages() -> picture::Imports {
    let read = |manifest: PathBuf| {
        let table: toml::Table = std::fs::read_to_string(manifest).unwrap().parse().unwrap();
        let used = table["dependencies"].as_table().unwrap().keys();
        used.filter_map(|name| name.strip_prefix("meniscus-").map(str::to_owned)).collect::<BTreeSet<_>>()
    };
    let of_crates = packages().into_iter().map(|name| {
        let manifest = root().join("crates").join(&name).join("Cargo.toml");
        (name, read(manifest))
    });
    of_crates.chain([("meniscus".to_owned(), read(root().join("Cargo.toml")))]).collect()
}

/// `MENISCUS_BLESS=1 cargo test --release --test layers` draws them anew.
#[test]
fn the_pictures_of_the_structure_are_those_of_the_source() {
    let sources = sources();
    let inside = ["sph", "network", "film", "geometry"].map(|package| {
        let mut imports = circles::imports_within((package, ""), &sources);
        imports.remove("mod");
        imports.values_mut().for_each(|imported| imported.retain(|import| import != "mod"));
        (format!("structure-{package}.svg"), picture::svg(&imports, false))
    });
    let whole = ("structure.svg".to_owned(), picture::svg(&uses_of_packages(), true));
    for (name, drawn) in inside.into_iter().chain([whole]) {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/figures").join(&name);
        if std::env::var_os("MENISCUS_BLESS").is_some() {
            std::fs::write(&file, &drawn).unwrap();
        }
        let shown = std::fs::read_to_string(&file).unwrap_or_default();
        assert!(
            shown == drawn,
            "docs/figures/{name} is not of this source: MENISCUS_BLESS=1 cargo test --release --test layers"
        );
    }
}

/// What the solver takes from a case as it is: plain tables of numbers and words.
const TABLES: [&str; 6] = ["Fluid", "LineDelta", "Numerics", "SurfaceForce", "ViscousStep", "ViscousTerm"];

#[test]
fn beside_its_setup_the_solver_sees_plain_tables_of_the_case_only() {
    let mut violations = Vec::new();
    let is_of_solver = |source: &&Source| {
        let (package, inner) = source.place();
        package == "sph" && !inner.starts_with("setup/")
    };
    for source in sources().iter().filter(is_of_solver) {
        for (number, line) in source.lines.iter().enumerate().filter(|(_, line)| line.contains("meniscus_case")) {
            let (_, names) = line.split_once("meniscus_case::").unwrap_or_default();
            let names = names.split(" as ").next().unwrap_or_default();
            let mut names = names.split(|c| !is_word(c)).filter(|name| !name.is_empty());
            if !line.starts_with("use ") || names.any(|name| !TABLES.contains(&name)) {
                violations.push(format!("{}: beyond the tables {TABLES:?}: {}", source.line(number), line.trim()));
            }
        }
    }
    assert_none(&violations);
}

#[test]
fn foreign_libraries_and_printing_keep_to_their_place() {
    let mut violations = Vec::new();
    let uses = |line: &str, library: &str| {
        holds(line, library)
            && line
                .match_indices(&format!("{library}::"))
                .any(|(at, _)| !line[..at].ends_with(|c| is_word(c) || c == ':'))
    };
    for source in sources() {
        for (number, line) in source.lines.iter().enumerate() {
            let words = ONE_PLACE.into_iter().filter(|(word, _)| holds(line, word));
            for (word, places) in words.chain(PLACES.into_iter().filter(|(library, _)| uses(line, library))) {
                if !places.iter().any(|place| source.path.starts_with(place)) {
                    violations.push(format!("{}: `{word}` belongs to {places:?}", source.line(number)));
                }
            }
        }
    }
    assert_none(&violations);
}

#[test]
fn the_physics_touches_no_file() {
    let mut violations = Vec::new();
    for source in sources().iter().filter(|source| PHYSICS.contains(&source.place().0)) {
        for (number, line) in source.lines.iter().enumerate() {
            if ["std::fs", "std::io", "std::env", "std::process"].iter().any(|name| line.contains(name)) {
                violations.push(format!("{}: {}", source.line(number), line.trim()));
            }
        }
    }
    assert_none(&violations);
}

#[test]
fn every_file_of_the_source_is_compiled() {
    let mut files = Vec::new();
    for folder in ["src", "tests", "crates", "python/src"] {
        collect(&root().join(folder), &mut files);
    }
    let roots = ["main", "mod", "lib"];
    let declares = |folder: &Path, name: &str| {
        let beside = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let mut texts = beside.filter(|path| path.extension().is_some_and(|extension| extension == "rs"));
        texts.any(|path| std::fs::read_to_string(path).unwrap().contains(&format!("mod {name};")))
    };
    let violations: Vec<String> = files
        .iter()
        .filter(|file| {
            let (folder, name) = (file.parent().unwrap(), file.file_stem().unwrap().to_str().unwrap());
            // Cargo itself finds what lies in these.
            let is_target = ["tests", "examples", "benches"].iter().any(|kind| folder.ends_with(kind));
            !(is_target || roots.contains(&name) || declares(folder, name) || declares(folder.parent().unwrap(), name))
        })
        .map(|file| format!("no `mod` names {}", file.display()))
        .collect();
    assert_none(&violations);
}

#[test]
fn the_reader_of_imports_reads_what_rust_reads() {
    let lines = [
        "use crate::math::Vec2; // crate::cli",
        "use crate::{io::{atomic, vtk}, run,",
        "    solver};",
        "let a = \"//\"; crate::sph::x()",
    ];
    let found = heads_behind(&lines.map(without_comment).join("\n"), "crate::");
    let found: Vec<_> = found.into_iter().map(|(line, head)| format!("{line} {head}")).collect();
    assert_eq!(found, ["0 math", "1 io", "1 run", "1 solver", "3 sph"]);
    assert!(
        holds("    println!(\"a\")", "println!") && !holds("eprintln!()", "println!") && !holds("overclap", "clap")
    );
}
