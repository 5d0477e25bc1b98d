//! The cases as they are shipped: those of `tests/program` are coarser.

use crate::support::program::{all_at_once, command, shipped, stderr};

/// The part of the time of each case that is run: some steps.
const PART: f64 = 3000.0;

#[test]
#[ignore = "takes minutes: cargo test --release --test validation -- --ignored; .ci/run does it"]
fn every_direct_case_is_checked_packed_and_stepped_at_its_own_spacing() {
    let folder = tempfile::tempdir().unwrap();
    let cases = shipped("cases", &["toml"]);
    all_at_once(&cases, |case| {
        let end = std::fs::read_to_string(case).unwrap().parse::<toml::Table>().unwrap()["time"]["end"].as_float();
        let end = format!("--set=time.end={:e}", end.unwrap() / PART);
        let name = case.file_stem().unwrap().to_str().unwrap();
        let path = case.to_str().unwrap();
        for (arguments, codes) in [
            (&["check", path][..], &[0][..]),
            // What it expects of its end may be missed this early.
            (&["run", path, "--threads", "1", "--out", name, &end], &[0, 5]),
        ] {
            let output = command(folder.path(), arguments).output().unwrap();
            let code = output.status.code().unwrap_or(-1);
            assert!(codes.contains(&code), "{arguments:?}: {code}\n{}", stderr(&output));
        }
    });
}
