//! Runs the program as a user does, in a folder of its own.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

pub use super::files::files;

/// A drop on a floor, coarse and short: a run of 50 steps in well below a second.
pub const SMALL: &str = r#"
format = 1
title = "A small drop"

[geometry]
min = [0.0, 0.0] # m
max = [1.0e-3, 6.0e-4] # m

[sph]
spacing = 4.0e-5 # m

[sph.phases.wetting]
density = 800.0 # kg/m3
viscosity = 8.0e-3 # Pa s

[sph.phases.non-wetting]
density = 800.0 # kg/m3
viscosity = 8.0e-3 # Pa s

[sph.interface]
tension = 0.02 # N/m

[sph.wetting.young]
contact-angle-deg = 60.0

[sph.sides]
left = "periodic"
right = "periodic"

[[sph.initial.wetting]]
disc = { center = [5.0e-4, 0.0], radius = 2.8e-4 } # m

[time]
end = 3.0e-4 # s

[output.series]
every-time = 1.0e-4 # s

[output.vtk]
every-time = 1.5e-4 # s
"#;

/// The program with `arguments`, to be run in `folder`. Signals that these tests were told to ignore, as by `nohup` or in the background, do their work.
pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let program = env!("CARGO_BIN_EXE_meniscus");
    let mut command = if can_reset_signals() {
        let mut command = Command::new(ENV);
        command.args([RESET, program]);
        command
    } else {
        Command::new(program)
    };
    command.args(arguments).current_dir(folder);
    command
}

/// `env` of coreutils 8.31 or later, which becomes the program that it starts.
const ENV: &str = "/usr/bin/env";
const RESET: &str = "--default-signal=HUP,INT,TERM";

fn can_reset_signals() -> bool {
    static FOUND: LazyLock<bool> =
        LazyLock::new(|| Command::new(ENV).args([RESET, "true"]).output().is_ok_and(|output| output.status.success()));
    *FOUND
}

/// Runs the program with `arguments` in `folder`.
pub fn meniscus(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

/// Runs the program with a case as first of `arguments`, with twice its spacing or one and a half where the case may be so coarse: what depends on the
/// kind of a case alone comes sooner. Returns the factor too.
pub fn meniscus_coarsely(folder: &Path, command: &str, case: &Path, arguments: &[&str]) -> (Output, f64) {
    let table: toml::Table = std::fs::read_to_string(case).unwrap().parse().unwrap();
    let spacing = table.get("sph").map(|sph| sph["spacing"].as_float().unwrap());
    let run = |more: &[&str]| {
        meniscus(folder, &[&[command, case.to_str().unwrap(), "--threads", "1"], arguments, more].concat())
    };
    for factor in [2.0, 1.5] {
        let Some(spacing) = spacing else { break };
        let output = run(&[&format!("--set=sph.spacing={:e}", factor * spacing)]);
        if output.status.code() != Some(3) {
            return (output, factor);
        }
    }
    (run(&[]), 1.0)
}

/// Standard output.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Standard error on one line, so that messages can be searched for words however they were broken.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Fails unless the program ended with `code`, and shows what it wrote.
#[track_caller]
pub fn assert_code(output: &Output, code: i32) {
    assert_eq!(output.status.code(), Some(code), "{}\n{}", stdout(output), String::from_utf8_lossy(&output.stderr));
}

/// A fresh folder with [`SMALL`] in it as `drop.toml`.
pub fn folder_with_small_case() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("drop.toml"), SMALL).unwrap();
    folder
}

/// Fails unless both folders hold the same files with the same bytes, and names those that differ.
#[track_caller]
pub fn assert_same_files(found: &Path, wanted: &Path) {
    let (found, wanted) = (files(found), files(wanted));
    let names = |files: &BTreeMap<PathBuf, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&found), names(&wanted));
    let different: Vec<_> =
        found.iter().filter(|(name, bytes)| wanted[*name] != **bytes).map(|(name, _)| name).collect();
    assert!(different.is_empty(), "these files differ: {different:?}");
}

/// The report of a run.
pub fn report(folder: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(folder.join("report.json")).unwrap()).unwrap()
}

/// The files with one of `extensions` in a folder of the package.
pub fn shipped(folder: &str, extensions: &[&str]) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|file| file.extension().is_some_and(|found| extensions.iter().any(|wanted| found == *wanted)));
    files.sort();
    assert!(!files.is_empty(), "no files in {folder}");
    files
}

/// Does some work with each of `items`, with as many of them at once as there are processors; the first ones begin first.
pub fn all_at_once<T: Sync>(items: &[T], work: impl Fn(&T) + Sync) {
    let next = AtomicUsize::new(0);
    let take = || {
        while let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed)) {
            work(item);
        }
    };
    std::thread::scope(|scope| {
        let workers = std::thread::available_parallelism().map_or(1, usize::from);
        let threads: Vec<_> = (0..workers.min(items.len())).map(|_| scope.spawn(take)).collect();
        let ended: Vec<_> = threads.into_iter().map(std::thread::ScopedJoinHandle::join).collect();
        ended.into_iter().for_each(|ended| ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
    });
}
