//! The layers of the source tree: low may not import high, and foreign libraries for one purpose keep to their places.
//!
//! Reads the sources as text: comments are cut off, every path that begins with `crate::` counts.

mod circles;
mod picture;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What each module of the crate may import besides itself. Output code sees snapshots, so `io` sees neither case nor solver
/// modules; `interface` and `analysis` are pure.
const MAY_IMPORT: [(&str, &[&str]); 20] = [
    ("math", &[]),
    ("input", &["math"]),
    ("snapshot", &["math"]),
    ("diagram", &[]),
    ("table", &[]),
    ("solver", &["math", "snapshot", "diagram", "table"]),
    ("geometry", &["math", "input", "snapshot"]),
    ("interface", &["math", "snapshot", "geometry"]),
    ("analysis", &["math", "snapshot", "interface"]),
    ("wetting", &["input"]),
    ("case", &["math", "input", "geometry", "wetting"]),
    (
        "network",
        &["math", "geometry", "snapshot", "diagram", "table", "solver", "wetting", "case", "interface", "analysis"],
    ),
    ("sph", &["math", "geometry", "snapshot", "table", "solver", "wetting", "case", "interface", "analysis"]),
    ("benchmarks", &["math", "solver", "case", "interface", "analysis", "sph"]),
    ("thin_film", &["math", "snapshot", "diagram", "solver", "case", "analysis"]),
    ("io", &["math", "snapshot", "diagram", "table", "solver"]),
    (
        "run",
        &[
            "math",
            "input",
            "geometry",
            "snapshot",
            "diagram",
            "solver",
            "case",
            "analysis",
            "network",
            "sph",
            "benchmarks",
            "thin_film",
            "io",
        ],
    ),
    ("study", &["math", "diagram", "input", "case", "analysis", "io", "run"]),
    ("verify", &["math", "input", "geometry", "case", "interface", "network", "io", "study"]),
    (
        "cli",
        &[
            "math", "input", "geometry", "snapshot", "solver", "wetting", "case", "analysis", "io", "run", "study",
            "verify",
        ],
    ),
];

/// Words that belong to one place: the word, and the files that may hold it, by the beginning of their path.
const ONE_PLACE: [(&str, &[&str]); 7] = [
    ("println!", &["cli/"]),
    ("eprintln!", &["cli/"]),
    ("print!", &["cli/"]),
    ("eprint!", &["cli/"]),
    ("dbg!", &[]),
    // Pipes of other processes are called so too.
    ("stdout", &["cli/", "study/child.rs"]),
    ("stderr", &["cli/", "study/child.rs"]),
];

/// Libraries for one purpose, with the files that may use them, by the beginning of their path.
const PLACES: [(&str, &[&str]); 31] = [
    ("ab_glyph", &["io/picture/"]),
    ("base64", &["io/vtk/"]),
    ("clap", &["cli/"]),
    ("clap_complete", &["cli/"]),
    ("clap_mangen", &["cli/"]),
    ("cpu_time", &["run/processor_time.rs"]),
    ("ctrlc", &["cli/"]),
    ("dejavu", &["io/picture/"]),
    ("delaunator", &["geometry/"]),
    ("flate2", &["io/vtk/"]),
    ("geo", &["geometry/"]),
    ("geojson", &["geometry/"]),
    ("indicatif", &["cli/"]),
    ("lz4_flex", &["io/vtk/"]),
    // Errors in input carry their place as `miette` wants it; only the command line prints them.
    ("miette", &["cli/", "input/error.rs", "input/excerpt.rs"]),
    ("mimalloc", &["main.rs"]),
    ("parry2d_f64", &["geometry/"]),
    ("plotters", &["io/axes.rs", "io/diagram.rs"]),
    // Masks are read and written, pictures written.
    ("png", &["geometry/export/mask.rs", "geometry/import/mask/", "io/picture/"]),
    // Packs of grains, and throats by chance.
    ("rand_chacha", &["geometry/pack/", "verify/choose.rs"]),
    ("raw_cpuid", &["cli/"]),
    ("roxmltree", &["geometry/"]),
    ("signal_hook", &["cli/"]),
    ("sobol_burley", &["study/sampling/"]),
    ("statrs", &["study/sampling/"]),
    ("strsim", &["input/suggest.rs"]),
    ("svgtypes", &["geometry/"]),
    ("tiff", &["geometry/"]),
    ("tiny_skia", &["io/picture/"]),
    ("vtkio", &["io/vtk.rs", "io/vtk/"]),
    ("wkt", &["geometry/"]),
];

/// Libraries for numbers, data and errors in general.
const EVERYWHERE: [&str; 10] =
    ["csv", "faer", "nalgebra", "postcard", "rayon", "schemars", "serde", "serde_json", "thiserror", "toml"];

/// A source file: its path below `src` and its lines without comments.
struct Source {
    path: String,
    lines: Vec<String>,
}

impl Source {
    /// The module of the crate it belongs to: `sph` for `sph/poisson/solve.rs`, `math` for `math.rs`.
    fn module(&self) -> &str {
        self.path.split('/').next().unwrap_or_default().trim_end_matches(".rs")
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

    fn place(&self, line: usize) -> String {
        format!("src/{}:{}", self.path, line + 1)
    }
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &mut files);
    files.sort();
    let source = |file: PathBuf| Source {
        path: file.strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/"),
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

/// The first parts of the paths behind each `crate::` of a file with their lines; `crate::{a::B, c}` has two.
fn imports(source: &Source) -> Vec<(usize, String)> {
    heads_behind(&source.lines.join("\n"), "crate::")
}

/// The first parts of the paths behind each `prefix` of a text with their lines.
fn heads_behind(text: &str, prefix: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (at, path) in text.match_indices(prefix) {
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

#[test]
fn low_layers_do_not_import_high_ones() {
    let mut violations = Vec::new();
    for source in sources().iter().filter(|source| !matches!(source.path.as_str(), "main.rs" | "lib.rs")) {
        let module = source.module();
        let Some((_, allowed)) = MAY_IMPORT.iter().find(|(name, _)| *name == module) else {
            violations.push(format!("src/{}: the module `{module}` has no layer in tests/layers/main.rs", source.path));
            continue;
        };
        for (line, import) in imports(source) {
            if import != module && !allowed.contains(&import.as_str()) {
                violations.push(format!("{}: `{module}` may not import `{import}`", source.place(line)));
            }
        }
    }
    assert_none(&violations);
}

/// What each module imports from others outside of its tests.
fn imports_of_modules() -> picture::Imports {
    let mut found = picture::Imports::new();
    let is_module = |source: &&Source| !matches!(source.path.as_str(), "main.rs" | "lib.rs");
    for source in sources().iter().filter(is_module) {
        let of_module = found.entry(source.module().to_owned()).or_default();
        if source.is_of_tests() {
            continue;
        }
        let code = source.code();
        of_module.extend(heads_behind(&code, "crate::").into_iter().map(|(_, head)| head));
        of_module.remove(source.module());
    }
    let modules: BTreeSet<String> = found.keys().cloned().collect();
    found.values_mut().for_each(|imported| imported.retain(|import| modules.contains(import)));
    found
}

/// `MENISCUS_BLESS=1 cargo test --release --test layers` draws them anew.
#[test]
fn the_pictures_of_the_structure_are_those_of_the_source() {
    let sources = sources();
    let inside = ["sph", "network", "thin_film", "geometry"].map(|folder| {
        let mut imports = circles::imports_within(folder, &sources);
        imports.remove("mod");
        imports.values_mut().for_each(|imported| imported.retain(|import| import != "mod"));
        (format!("structure-{folder}.svg"), picture::svg(&imports, false))
    });
    let whole = ("structure.svg".to_owned(), picture::svg(&imports_of_modules(), true));
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

#[test]
fn no_file_climbs_out_of_its_module_by_super() {
    let mut violations = Vec::new();
    for source in sources() {
        let folders = source.path.matches('/').count();
        let own = if source.path.ends_with("mod.rs") { folders - 1 } else { folders };
        let mut inner = 0;
        for (number, line) in source.lines.iter().enumerate() {
            inner += usize::from(line.trim_start().starts_with("mod ") && line.trim_end().ends_with('{'));
            let longest = (1..=8).rev().find(|&n| line.contains(&"super::".repeat(n))).unwrap_or(0);
            if longest > own + inner {
                violations.push(format!("{}: `super` leads to the root of the crate", source.place(number)));
            }
        }
    }
    assert_none(&violations);
}

/// What the solver takes from a case as it is: plain tables of numbers and words.
const TABLES: [&str; 6] = ["Fluid", "LineDelta", "Numerics", "SurfaceForce", "ViscousStep", "ViscousTerm"];

#[test]
fn beside_its_setup_the_solver_sees_plain_tables_of_the_case_only() {
    let mut violations = Vec::new();
    for source in sources().iter().filter(|source| source.module() == "sph" && !source.path.starts_with("sph/setup/")) {
        for (number, line) in source.lines.iter().enumerate().filter(|(_, line)| line.contains("crate::case")) {
            let (_, names) = line.split_once("crate::case::").unwrap_or_default();
            let mut names = names.split(|c| !is_word(c)).filter(|name| !name.is_empty());
            if !line.starts_with("use ") || names.any(|name| !TABLES.contains(&name)) {
                violations.push(format!("{}: beyond the tables {TABLES:?}: {}", source.place(number), line.trim()));
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
                    violations.push(format!("{}: `{word}` belongs to {places:?}", source.place(number)));
                }
            }
        }
    }
    assert_none(&violations);
}

#[test]
fn every_foreign_library_has_a_place_or_is_for_all() {
    let manifest = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml")).unwrap();
    let is_table = |line: &str| line.ends_with("dependencies]") && !line.contains("dev-");
    let mut in_table = false;
    for line in manifest.lines() {
        in_table = if line.starts_with('[') { is_table(line) } else { in_table };
        let Some((library, _)) = line.split_once(" = ").filter(|_| in_table && !line.starts_with('[')) else {
            continue;
        };
        let library = library.replace('-', "_");
        let has_place = PLACES.iter().any(|(name, _)| *name == library) || EVERYWHERE.contains(&library.as_str());
        assert!(has_place, "`{library}` is neither in PLACES nor in EVERYWHERE of tests/layers/main.rs");
    }
}

#[test]
fn the_physics_touches_no_file() {
    let mut violations = Vec::new();
    for source in sources()
        .iter()
        .filter(|source| matches!(source.module(), "math" | "interface" | "analysis" | "sph" | "benchmarks"))
    {
        for (number, line) in source.lines.iter().enumerate() {
            if ["std::fs", "std::io", "std::env", "std::process"].iter().any(|name| line.contains(name)) {
                violations.push(format!("{}: {}", source.place(number), line.trim()));
            }
        }
    }
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
    let source =
        Source { path: "a.rs".into(), lines: lines.iter().map(|line| without_comment(line).to_owned()).collect() };
    let found: Vec<_> = imports(&source).into_iter().map(|(line, head)| format!("{line} {head}")).collect();
    assert_eq!(found, ["0 math", "1 io", "1 run", "1 solver", "3 sph"]);
    assert!(
        holds("    println!(\"a\")", "println!") && !holds("eprintln!()", "println!") && !holds("overclap", "clap")
    );
}
