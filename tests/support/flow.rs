//! A flow from the text of a case.

use meniscus_case::{Case, Model};
use meniscus_core::input::Overrides;
use meniscus_sph::flow::Flow;
use meniscus_sph::setup;
use meniscus_sph::solver::SphSolver;

/// The flow of a case given as text, at time zero.
pub fn flow(text: &str) -> Flow {
    solver(text).flow
}

/// The solver of a case given as text, at time zero.
pub fn solver(text: &str) -> SphSolver {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("case.toml");
    std::fs::write(&path, text).expect("the case can be written");
    let case: Case = meniscus_case::load(&path, &Overrides::default()).unwrap_or_else(|error| panic!("{error:?}")).case;
    let Model::Sph(sph) = &case.model else { panic!("the case is one of SPH") };
    setup::build(&case, sph).expect("a case that fits")
}
