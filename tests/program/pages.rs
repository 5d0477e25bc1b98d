//! The commands of the pages run, one after the other, and give the numbers that the pages tell.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::marks::{Block, Mark, read, rounds_to, same_line};
use crate::support::program::{all_at_once, assert_code, meniscus, report, shipped, stderr, stdout};
use crate::support::python;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
/// What the commands of pages read.
const FOLDERS: [&str; 4] = ["cases", "geometries", "studies", "postprocess"];

/// Stored results of long studies.
const RESULTS: &str = "docs/validation/results";

/// The words of a command line, in which double quotes hold words together.
fn words(line: &str) -> Vec<&str> {
    let parts = line.split('"').enumerate();
    parts
        .flat_map(|(number, part)| if number % 2 == 1 { vec![part] } else { part.split_whitespace().collect() })
        .collect()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        let to = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            copy(&entry.path(), &to);
        } else {
            fs::copy(entry.path(), to).unwrap();
        }
    }
}

/// Runs a command line of the program or of a script in a folder; others are not for tests.
fn run(line: &str, folder: &Path) -> Option<Output> {
    let begins = ["meniscus ", "cargo run --release -- ", "cargo run --release"];
    if let Some(arguments) = begins.iter().find_map(|begin| line.strip_prefix(begin)) {
        return Some(meniscus(folder, &words(arguments)));
    }
    let script = line.strip_prefix("python postprocess/")?;
    let mut command = Command::new(python::interpreter());
    command.arg("postprocess/".to_owned() + script.split_whitespace().next()?);
    command.args(&words(script)[1..]).current_dir(folder).env("MPLBACKEND", "Agg");
    Some(command.output().unwrap())
}

/// A page and what a test finds on it.
struct Page {
    path: PathBuf,
    blocks: Vec<Block>,
    marks: Vec<Mark>,
}

impl Page {
    /// The pages with blocks of output or marks.
    fn all() -> Vec<Self> {
        let folders = ["docs", "docs/network", "docs/numerics", "docs/thin-film", "docs/tutorials"];
        let paths = folders.iter().flat_map(|folder| shipped(folder, &["md"]));
        let pages = paths.chain([Path::new(ROOT).join("README.md")]).map(|path| {
            let text = fs::read_to_string(&path).unwrap();
            let (blocks, marks) = read(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            Self { path, blocks, marks }
        });
        pages.filter(Self::tells_numbers).collect()
    }

    fn tells_numbers(&self) -> bool {
        !self.marks.is_empty() || self.blocks.iter().any(|block| matches!(block, Block::Output(..)))
    }

    /// Runs the commands in a copy of what they read, and compares what they print and leave.
    fn visit(&self) {
        let folder = tempfile::tempdir().unwrap();
        for name in FOLDERS {
            copy(&Path::new(ROOT).join(name), &folder.path().join(name));
        }
        fs::create_dir_all(folder.path().join("docs/figures")).unwrap();
        let mut printed = String::new();
        for block in &self.blocks {
            match block {
                Block::File(name, text) => fs::write(folder.path().join(name), text).unwrap(),
                Block::Commands(lines, long) => {
                    printed.clear();
                    for line in lines.iter().filter(|_| !long) {
                        let Some(output) = run(line, folder.path()) else { continue };
                        assert!(output.status.success(), "{}: {line}\n{}", self.name(), stderr(&output));
                        assert_code(&output, 0);
                        printed += &(stdout(&output) + &String::from_utf8_lossy(&output.stderr));
                    }
                }
                Block::Output(lines, tolerance) => {
                    for line in lines.iter().filter(|line| !line.is_empty()) {
                        let found = printed.lines().any(|printed| same_line(line, printed, *tolerance));
                        assert!(found, "{}: no command prints\n{line}\nbut\n{printed}", self.name());
                    }
                }
            }
        }
        for mark in &self.marks {
            let stored = mark.folder == "results" && mark.table.is_some();
            let place =
                if stored { Path::new(ROOT).join(RESULTS) } else { folder.path().join("out").join(&mark.folder) };
            let found = mark.factor * value(mark, &place);
            assert!(rounds_to(found, &mark.told), "{}: {found}, and the page tells {mark:?}", self.name());
        }
        if self.name() == "network.md" {
            the_tutorial_of_networks_leaves_what_it_promises(folder.path());
        }
    }

    fn name(&self) -> String {
        self.path.file_name().unwrap().to_string_lossy().into_owned()
    }
}

/// The number that a mark is about, in the output of a run or study.
fn value(mark: &Mark, folder: &Path) -> f64 {
    let Some(table) = &mark.table else {
        assert!(folder.join("report.json").is_file(), "no command of the page leaves a report: {mark:?}");
        let measure = &report(folder)["measures"][&mark.quantity];
        return measure["value"].as_f64().unwrap_or_else(|| panic!("no measure: {mark:?}"));
    };
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(folder.join(table)).unwrap();
    let head = reader.headers().unwrap().clone();
    let column =
        |name: &str| head.iter().position(|cell| cell == name).unwrap_or_else(|| panic!("no {name}: {mark:?}"));
    let is_meant = |row: &csv::StringRecord| mark.row.iter().all(|(name, value)| &row[column(name)] == value);
    let row =
        reader.records().map(Result::unwrap).filter(is_meant).last().unwrap_or_else(|| panic!("no row: {mark:?}"));
    row[column(&mark.quantity)].parse().unwrap_or_else(|_| panic!("no number: {mark:?}"))
}

#[test]
fn the_commands_of_every_page_run_and_give_its_numbers() {
    let pages = Page::all();
    let marks: usize = pages.iter().map(|page| page.marks.len()).sum();
    assert!(pages.len() >= 8 && marks >= 20, "{} pages, {marks} marks", pages.len());
    all_at_once(&pages, Page::visit);
}

fn the_tutorial_of_networks_leaves_what_it_promises(folder: &Path) {
    let out = |name: &str| folder.join("out").join(name);
    for file in ["picture.png", "diagram-capillary-pressure.svg", "events.csv", "pores.csv", "throats.csv"] {
        assert!(out("chip-drainage").join(file).is_file(), "{file} is missing");
    }
    let measure = |name: &str, measure: &str| report(&out(name))["measures"][measure]["value"].as_f64().unwrap();
    // A larger angle through the wetting phase needs less pressure to drain.
    let [pressure, less] = ["chip-drainage", "chip-drainage-80"].map(|name| measure(name, "breakthrough-pressure-Pa"));
    assert!(0.0 < less && less < pressure, "{less} and {pressure} Pa");
    // The same chip in DXF.
    for name in ["pores", "throats", "events", "trapped-saturation", "breakthrough-pressure-Pa"] {
        let [svg, dxf] = ["chip-drainage", "chip-dxf"].map(|out| measure(out, name));
        assert!((svg / dxf - 1.0).abs() < 2e-5, "{name}: {svg} and {dxf}");
    }
    // The case is the same displacement as the command without a case, whose saturations are those of the pack.
    for name in ["events", "breakthrough-pressure-Pa"] {
        assert_eq!(measure("chip", name), measure("chip-drainage", name), "{name}");
    }
}
