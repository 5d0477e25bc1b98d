//! The tables and figures of the validation pages are those of stored results, and these of the present studies, cases and version.
//!
//! `postprocess/gallery.py` explains blocks and stored results and writes both; its checksums are computed here once more.

use std::collections::BTreeSet;
use std::path::Path;

use flate2::Crc;

use crate::page::{files, pages, root, text};

const BEGIN: &str = "\n<!-- results: ";
const END: &str = "<!-- end of results";
const FOLDER: &str = "docs/validation/results";

/// CRC-32 in hexadecimal digits.
fn checksum(data: &[u8]) -> String {
    let mut crc = Crc::new();
    crc.update(data);
    format!("{:08x}", crc.sum())
}

/// What of a study, case or shape file can change a run: no comments, title, expectations and report.
fn essence(text: &str) -> String {
    let mut counts = true;
    let mut kept = Vec::new();
    for line in text.lines().map(|line| line.split('#').next().unwrap_or_default().trim()) {
        if line.starts_with('[') {
            counts = !["[[expect", "[[trend", "[report", "[[report"].iter().any(|remark| line.starts_with(remark));
        }
        if counts && !line.is_empty() && !line.starts_with("title") {
            kept.push(line);
        }
    }
    kept.join("\n")
}

/// The checksum of a file that a stored result comes from, or of a figure of it.
fn checksum_of_file(path: &str) -> String {
    if path.ends_with(".toml") || path.ends_with(".csv") {
        return checksum(essence(&text(path)).as_bytes());
    }
    checksum(&std::fs::read(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}")))
}

/// A stored result by the name of its study.
fn stored(name: &str) -> String {
    text(&format!("{FOLDER}/{name}.csv"))
}

/// The lines of a page with a table of results: the names of the studies, the block up to its last line, and the checksum in that.
fn blocks(page: &str) -> Vec<(Vec<String>, &str, &str)> {
    let found = page.match_indices(BEGIN).map(|(begin, _)| {
        let block = &page[begin + 1..];
        let names = block[BEGIN.len() - 1..].lines().next().unwrap_or_default().split_whitespace();
        let (block, end) = block.split_once(END).expect("a block of results has an end");
        (names.map(str::to_owned).collect(), block, end.split("-->").next().unwrap_or_default().trim())
    });
    found.collect()
}

#[test]
fn every_table_of_results_is_that_of_its_stored_results() {
    let mut shown = BTreeSet::new();
    for page in pages() {
        for (names, block, told) in blocks(&page.text) {
            let results = names.iter().map(|name| stored(name)).collect::<String>();
            let place = format!("{}: the table of {}", page.name(), names.join(", "));
            let advice = "edit no number by hand: python postprocess/gallery.py write";
            assert_eq!(checksum(format!("{block}{results}").as_bytes()), told, "{place}; {advice}");
            shown.extend(names);
        }
    }
    let there = files(&root().join(FOLDER), &["csv"])
        .into_iter()
        .filter_map(|path| Path::new(&path).file_stem().map(|name| name.to_string_lossy().into_owned()));
    assert_eq!(there.collect::<BTreeSet<_>>(), shown, "stored results and those that pages show");
}

#[test]
fn every_stored_result_is_of_the_present_study_case_figures_and_version() {
    for file in files(&root().join(FOLDER), &["csv"]) {
        let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let result = stored(&name);
        let head: Vec<&str> = result.lines().map_while(|line| line.strip_prefix("# ")).collect();
        let advice = format!("python postprocess/gallery.py run {name}");
        let version = format!("version {}, ", env!("CARGO_PKG_VERSION"));
        assert!(head[1].starts_with(&version), "{name} is of {}: {advice}", head[1]);
        assert!(head[0].ends_with(&format!("/{name}.toml")), "{name}: {}", head[0]);
        let study = head[0].trim_start_matches("meniscus study run ");
        let stamps: Vec<(&str, &str)> = head[2..].iter().filter_map(|line| line.split_once(' ')).collect();
        let is_whole =
            stamps.first().is_some_and(|first| first.1 == study) && stamps.last().is_some_and(|last| last.1 == "rows");
        assert!(is_whole, "{name} lacks the checksums of study and rows");
        for (told, path) in stamps {
            if path == "rows" {
                let rows: String = result.split_inclusive('\n').filter(|line| !line.starts_with('#')).collect();
                assert_eq!(checksum(rows.as_bytes()), told, "a number of {name} was edited: {advice}");
                continue;
            }
            assert_eq!(checksum_of_file(path), told, "{path} has changed since {name} was stored: {advice}");
        }
    }
}
