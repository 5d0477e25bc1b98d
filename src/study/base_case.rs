//! A base case with the values of a run.

use std::path::Path;

use super::definition::Assignment;
use crate::case::{self, KeptGeometry, Loaded};
use crate::input::{InputError, Overrides};
use crate::run::setup;

/// The expectations of a base case apply to its own values; a study has its own.
const WITHOUT_EXPECTATIONS: &str = "expect=[]";

/// The differences from the base case in the form of `--set`.
pub(super) fn overrides(assignments: &[Assignment]) -> Vec<String> {
    let mut texts = vec![WITHOUT_EXPECTATIONS.to_owned()];
    texts.extend(assignments.iter().map(|one| one.text.clone()));
    texts
}

/// Loads a case with these values and checks it against its geometry.
///
/// # Errors
/// All mistakes.
pub(super) fn load(case: &Path, assignments: &[Assignment]) -> Result<Loaded, InputError> {
    let overrides = Overrides::parse(&overrides(assignments))?;
    let loaded = case::load(case, &overrides)?;
    loaded.refuse(setup::problems(&loaded.case))?;
    Ok(loaded)
}

/// Loads a case of a network with these values, its resolved text without shapes; `kept` has the geometry of the previous case.
///
/// # Errors
/// All mistakes.
pub(super) fn load_with(case: &Path, assignments: &[Assignment], kept: &KeptGeometry) -> Result<Loaded, InputError> {
    let overrides = Overrides::parse(&overrides(assignments))?;
    let loaded = case::load_with(case, &overrides, kept)?;
    loaded.refuse(setup::problems(&loaded.case))?;
    Ok(loaded)
}
