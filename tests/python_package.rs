//! The Python package: built by `pip install .`, and tested in an environment of its own, as is the notebook, which uses it.

mod support;

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use support::python::{package_interpreter, root, run};

/// The compiled libraries of the package in the folder of these tests.
fn libraries() -> BTreeSet<String> {
    let folder = Path::new(env!("CARGO_BIN_EXE_meniscus")).with_file_name("deps");
    let files = std::fs::read_dir(folder).expect("the folder of compiled libraries").flatten();
    let names = files.filter_map(|file| file.file_name().into_string().ok());
    names.filter(|name| name.starts_with("libmeniscus-") && name.ends_with(".rlib")).collect()
}

#[test]
fn the_package_is_built_with_the_library_of_these_tests_and_passes_its_own() {
    let before = libraries();
    let python = package_interpreter();
    // Another one is compiled where dependencies are used with other features: the root `Cargo.toml` must turn on those that tests and pyo3 need.
    assert_eq!(libraries(), before, "the library was compiled once more for the Python package");
    let mut tests = Command::new(&python);
    tests.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider"]).arg(root().join("python/tests"));
    tests.env("MENISCUS_PROGRAM", env!("CARGO_BIN_EXE_meniscus"));
    println!("{}", run(&mut tests, "the tests of the Python package must pass"));
    let mut notebook = Command::new(&python);
    notebook.arg(root().join("postprocess/tests/run_notebook.py")).arg(root().join("postprocess/sessile-drop.ipynb"));
    notebook.current_dir(root().join("postprocess")).env("MPLBACKEND", "Agg");
    let printed = run(&mut notebook, "the cells of the notebook must run");
    for angle in [40, 90, 140] {
        assert!(printed.contains(&format!("{angle} degrees asked, ")), "{printed}");
    }
}
