//! The documentation holds: links lead somewhere, names exist in the source, commands parse, examples load, and the reference
//! names what the program has, no more and no less.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use meniscus_case::{load, load_shapes};
use meniscus_core::input::Overrides;
use meniscus_drawings::import::Options;

#[path = "docs/equations.rs"]
mod equations;
#[path = "docs/generated.rs"]
mod generated;
#[path = "docs/keys.rs"]
mod keys;
#[path = "docs/names.rs"]
mod names;
#[path = "docs/page.rs"]
mod page;
#[path = "docs/reference.rs"]
mod reference;

use page::{Page, code, files, page, pages, root, text, words};

/// Whether there is such a path, or a file that its last part stands for where that has a `*`.
fn exists(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let Some((begin, end)) = name.split_once('*') else { return path.exists() };
    let files = path.parent().and_then(|folder| std::fs::read_dir(folder).ok()).into_iter().flatten().flatten();
    files.map(|file| file.file_name().to_string_lossy().into_owned()).any(|n| n.starts_with(begin) && n.ends_with(end))
}

/// The sources and tests as one text.
fn sources() -> String {
    let all = ["src", "crates", "tests"].into_iter().flat_map(|folder| files(&root().join(folder), &["rs"]));
    all.map(|path| std::fs::read_to_string(path).unwrap()).collect()
}

#[test]
fn every_link_leads_to_a_page_and_a_heading() {
    for from in pages() {
        for link in from.links().iter().filter(|link| !link.starts_with("https://")) {
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let folder = from.path.parent().unwrap_or(Path::new(""));
            let target = if file.is_empty() { from.path.clone() } else { folder.join(file) };
            assert!(exists(&root().join(&target)), "{}: there is no {}", from.name(), target.display());
            if !anchor.is_empty() {
                let anchors = page(&target.to_string_lossy()).anchors();
                assert!(anchors.iter().any(|a| a == anchor), "{}: no heading {link} among {anchors:?}", from.name());
            }
        }
    }
}

#[test]
fn every_page_of_the_book_is_in_its_summary() {
    let listed: BTreeSet<String> =
        page("docs/SUMMARY.md").links().into_iter().map(|link| format!("docs/{link}")).collect();
    let outside = ["docs/SUMMARY.md", "README.md", "CHANGELOG.md"];
    let there: BTreeSet<String> =
        pages().iter().map(Page::name).filter(|name| !outside.contains(&name.as_str())).collect();
    let [missing, surplus] = [(&there, &listed), (&listed, &there)].map(|(a, b)| a.difference(b).collect::<Vec<_>>());
    assert!(missing.is_empty() && surplus.is_empty(), "docs/SUMMARY.md lacks {missing:?}, and there is no {surplus:?}");
}

#[test]
fn every_path_of_the_repository_that_is_named_exists() {
    const FOLDERS: [&str; 8] =
        ["src/", "crates/", "tests/", "cases/", "studies/", "geometries/", "postprocess/", "docs/"];
    for page in pages() {
        let fences = page.fences().into_iter().map(|fence| fence.text).collect::<String>();
        for name in page.code().iter().flat_map(|code| words(code)).chain(words(&fences)) {
            if FOLDERS.iter().any(|folder| name.starts_with(folder)) {
                assert!(exists(&root().join(&name)), "{}: there is no {name}", page.name());
            }
        }
    }
}

#[test]
fn no_page_names_a_host_or_an_absolute_path() {
    for page in pages() {
        let separators = |c: char| c.is_whitespace() || "`\"'()<>|=,;".contains(c);
        for word in page.text.split(separators) {
            let is_path =
                word.strip_prefix('/').is_some_and(|rest| rest.starts_with(char::is_alphabetic) && rest.contains('/'));
            assert!(!is_path, "{}: {word} is an absolute path", page.name());
            assert!(!word.contains("localhost") && !word.contains(":\\"), "{}: {word}", page.name());
        }
    }
}

#[test]
fn formulas_pass_through_markdown_unchanged() {
    // Markdown takes `_` behind a sign as emphasis, and `\` before a sign as an escape, before MathJax sees them.
    for page in pages() {
        assert!(page.prose().matches("$$").count().is_multiple_of(2), "{}: a formula is not closed", page.name());
        for formula in page.formulas() {
            let place = format!("{}: {formula}", page.name());
            assert!(!formula.contains("\n\n") && !formula.contains('*'), "{place}");
            let begins_a_list = |line: &str| line.trim_start().starts_with(['-', '+', '#', '>', '=']);
            assert!(!formula.lines().any(begins_a_list), "a line of {place} begins a list");
            for pair in formula.chars().collect::<Vec<_>>().windows(2) {
                assert!(pair[1] != '_' || pair[0].is_alphanumeric(), "`{}_` in {place}", pair[0]);
                assert!(pair[0] != '\\' || pair[1].is_alphabetic(), "`\\{}` in {place}", pair[1]);
                assert!(pair[0] != '<' || !pair[1].is_alphabetic(), "`<{}` in {place}", pair[1]);
            }
            assert_eq!(formula.matches('{').count(), formula.matches('}').count(), "braces in {place}");
            assert_eq!(formula.matches("\\left").count(), formula.matches("\\right").count(), "\\left in {place}");
        }
    }
}

#[test]
fn every_row_of_a_table_has_as_many_cells_as_its_head() {
    for page in pages() {
        let mut cells = 0;
        for line in page.prose().lines() {
            let count = if line.starts_with('|') { line.matches('|').count() } else { 0 };
            assert!(count == 0 || cells == 0 || count == cells, "{}: {line}", page.name());
            cells = count;
        }
    }
}

/// The command lines of the program on all pages, without its name.
fn commands() -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    for page in pages() {
        for fence in page.fences().iter().filter(|fence| fence.language == "sh") {
            for line in fence.text.lines() {
                let arguments = line.strip_prefix("meniscus ").or_else(|| line.strip_prefix("cargo run --release -- "));
                found.extend(arguments.map(|arguments| (page.name(), words(arguments))));
            }
        }
    }
    assert!(found.len() > 20, "only {} commands", found.len());
    found
}

#[test]
fn every_command_that_is_shown_parses() {
    for (name, arguments) in commands() {
        let output = Command::new(env!("CARGO_BIN_EXE_meniscus")).args(&arguments).arg("--help").output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{name}: meniscus {}\n{message}", arguments.join(" "));
    }
}

#[test]
fn every_value_that_is_set_in_a_command_fits_its_case() {
    for (name, arguments) in commands() {
        let Some(case) = arguments.iter().find(|word| word.starts_with("cases/")) else { continue };
        let sets = arguments.windows(2).filter(|pair| pair[0] == "--set").map(|pair| &pair[1]);
        let overrides = Overrides::parse(&sets.collect::<Vec<_>>()).unwrap_or_else(|error| panic!("{name}: {error:?}"));
        let loaded = load(&root().join(case), &overrides);
        assert!(loaded.is_ok(), "{name}: {}\n{:?}", arguments.join(" "), loaded.err());
    }
}

#[test]
fn every_example_file_loads() {
    let folder = tempfile::tempdir().unwrap();
    let mut names = Vec::new();
    for fence in pages().iter().flat_map(Page::fences) {
        let first = fence.text.lines().next().unwrap_or_default();
        let name = first.strip_prefix("# ").and_then(|rest| rest.split([':', ' ']).next()).unwrap_or_default();
        if [".toml", ".xyr", ".wkt"].iter().any(|ending| name.ends_with(ending)) {
            std::fs::write(folder.path().join(name), &fence.text).unwrap();
            names.push(name.to_owned());
        }
    }
    assert!(names.len() >= 4, "{names:?}");
    for name in names {
        let path = folder.path().join(&name);
        let text = std::fs::read_to_string(&path).unwrap();
        if text.contains("[[axis]]") {
            let study = meniscus::study::load::load(&path).unwrap_or_else(|error| panic!("{}", error.render()));
            let runs = meniscus::study::runs::plan(&study).unwrap_or_else(|error| panic!("{}", error.render()));
            assert!(runs.len() > 1, "{name}");
        } else if text.contains("[time]") || text.contains("[network]") {
            let loaded = load(&path, &Overrides::default()).unwrap_or_else(|error| panic!("{name}: {error:?}"));
            let problems = meniscus::run::setup::problems(&loaded.case);
            assert!(problems.is_empty(), "{name}: {problems:?}");
        } else {
            load_shapes(&path, &Options::default()).unwrap_or_else(|error| panic!("{name}: {error:?}"));
        }
    }
}

#[test]
fn the_gallery_lists_every_case_and_every_study() {
    let listed: BTreeSet<String> = page("docs/validation/gallery.md").rows().into_iter().flatten().collect();
    for folder in ["cases", "studies", "studies/validation"] {
        for file in std::fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path()) {
            if file.extension().is_some_and(|extension| extension == "toml") {
                let name = format!("`{folder}/{}`", file.file_name().unwrap().to_string_lossy());
                assert!(listed.contains(&name), "{name} is not in the gallery");
            }
        }
    }
}

/// Whether a function, type or block of methods of this name begins in the source.
fn defines(source: &str, name: &str) -> bool {
    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    let begins = |kind: &str| source.split(&format!("{kind} {name}")).skip(1).any(ends);
    ["fn", "struct", "enum"].into_iter().any(begins)
}

#[test]
fn every_function_on_the_page_of_equations_is_in_its_file() {
    let mut count = 0;
    for row in page("docs/equations.md").rows() {
        for cell in row.iter().filter(|cell| cell.contains("` in `src/") || cell.contains("` in `crates/")) {
            let mut names: Vec<String> = Vec::new();
            for piece in code(cell) {
                if !piece.starts_with("src/") && !piece.starts_with("crates/") {
                    names.push(piece);
                    continue;
                }
                let source = text(&piece);
                for name in names.drain(..) {
                    let function = name.rsplit("::").next().unwrap_or_default();
                    assert!(defines(&source, function), "{piece} defines no {name}");
                    count += 1;
                }
            }
        }
    }
    assert!(count > 40, "only {count} functions");
}

#[test]
fn every_test_on_the_page_of_equations_exists() {
    let sources = sources();
    let page = page("docs/equations.md");
    let sentences =
        page.code().into_iter().filter(|code| code.matches('_').count() >= 3 && !code.contains(['/', ' ', ':']));
    let tests: Vec<String> = sentences.collect();
    assert!(tests.len() > 20, "only {} tests", tests.len());
    for test in tests {
        assert!(sources.contains(&format!("fn {test}(")), "there is no test {test}");
    }
}

#[test]
fn every_paper_that_the_source_cites_by_key_is_in_the_bibliography() {
    let (sources, bibliography) = (sources(), text("references.bib"));
    let mut keys = BTreeSet::new();
    for rest in sources.split('[').skip(1) {
        let key: String = rest.chars().take_while(|c| c.is_ascii_alphanumeric()).collect();
        let ends = [", ", "; ", "]", "\\]"].iter().any(|end| rest[key.len()..].starts_with(end));
        let is_key = key.len() > 4 && key.starts_with(|c: char| c.is_ascii_uppercase()) && ends;
        let (name, year) = key.split_at(key.len().saturating_sub(4));
        if is_key && !name.is_empty() && name.chars().all(char::is_alphabetic) && year.parse::<u32>().is_ok() {
            keys.insert(key);
        }
    }
    assert!(["Huber2013", "Bracke1989"].iter().all(|key| keys.contains(*key)), "{keys:?}");
    for key in keys {
        assert!(bibliography.contains(&format!("{{{key},")), "references.bib has no {key}");
    }
}
