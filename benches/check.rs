//! How long it takes to read a case and to check it against its geometry, all cases of the repository one by one; the steps that
//! `meniscus check` tries afterwards are no part of it.
//!
//! `cargo bench --bench check` prints the slowest cases, then criterion's statistics of all of them together.

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Instant;

use criterion::Criterion;
use meniscus::run::setup;
use meniscus_case::load;
use meniscus_core::input::Overrides;

/// So many of the slowest cases are told.
const TOLD: usize = 5;

fn cases(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut found: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|ending| ending == "toml")).collect();
    found.sort();
    found
}

fn check(path: &Path) {
    let loaded = load(path, &Overrides::default()).expect("a case");
    assert!(black_box(setup::problems(&loaded.case)).is_empty(), "{}", path.display());
    // A thin film has none.
    let _ = black_box(setup::geometry(&loaded.case));
}

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let all: Vec<PathBuf> = ["", "network", "thin-film"].iter().flat_map(|folder| cases(&root.join(folder))).collect();
    let milliseconds = |path: &Path| {
        check(path);
        let start = Instant::now();
        check(path);
        start.elapsed().as_secs_f64() * 1e3
    };
    let mut times: Vec<(f64, &PathBuf)> = all.iter().map(|path| (milliseconds(path), path)).collect();
    times.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (milliseconds, path) in times.iter().take(TOLD) {
        println!("{milliseconds:8.1} ms  {}", path.strip_prefix(&root).unwrap_or(path).display());
    }
    let mut criterion = Criterion::default().sample_size(10).configure_from_args();
    criterion
        .bench_function(&format!("check {} cases", all.len()), |b| b.iter(|| all.iter().for_each(|path| check(path))));
}
