//! Cases of thin films and how tests run them.

use std::path::{Path, PathBuf};

use meniscus_case::{Loaded, load};
use meniscus_core::input::Overrides;
use meniscus_core::solver::Solver;

/// A case by its name.
pub fn named(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../cases/thin-film/{name}.toml"))
}

pub fn loaded(path: &Path, set: &[&str]) -> Loaded {
    load(path, &Overrides::parse(set).unwrap()).unwrap_or_else(|error| panic!("{}", error.render()))
}

/// Steps through the stops, which are met exactly.
pub fn advance(solver: &mut dyn Solver, stops: &[f64]) {
    for &stop in stops {
        while solver.time() < stop {
            solver.step(stop).unwrap();
        }
        assert_eq!(solver.time(), stop);
    }
}
