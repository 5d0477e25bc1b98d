//! Runs the program as a user does, in a folder of its own.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

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

/// The program with `arguments`, to be run in `folder`.
pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_meniscus"));
    command.args(arguments).current_dir(folder);
    command
}

/// Runs the program with `arguments` in `folder`.
pub fn meniscus(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
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
