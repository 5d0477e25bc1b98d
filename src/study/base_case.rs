//! A base case with the values of a run.

use std::path::Path;

use super::definition::Assignment;
use crate::run::setup;
use meniscus_case::{self, KeptGeometry, Loaded, Origin};
use meniscus_core::input::{InputError, Overrides};

/// The expectations of a base case apply to its own values; a study has its own.
const WITHOUT_EXPECTATIONS: &str = "expect=[]";

/// The differences from the base case in the form of `--set`.
pub(super) fn overrides(assignments: &[Assignment]) -> Vec<String> {
    let mut texts = vec![WITHOUT_EXPECTATIONS.to_owned()];
    texts.extend(assignments.iter().map(|one| one.text.clone()));
    texts
}

/// Loads a case with these values and checks it against its geometry; with `kept`, which has the geometry of the previous case, the resolved text has no
/// shapes.
///
/// # Errors
/// All mistakes.
pub(super) fn load(case: &Path, assignments: &[Assignment], kept: Option<&KeptGeometry>) -> Result<Loaded, InputError> {
    let overrides = Overrides::parse(&overrides(assignments))?;
    let loaded = meniscus_case::load_from(&Origin::Disk(case), &overrides, kept)?;
    loaded.refuse(setup::problems(&loaded.case))?;
    Ok(loaded)
}
