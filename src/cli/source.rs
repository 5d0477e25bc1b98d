//! Where cases and shapes come from: the command line's only door to the case reader and the geometry.

use std::path::Path;

use super::exit::{BAD_INPUT, Failure};
use crate::case::checked::Case;
use crate::snapshot::{Grid, Lines};
use crate::solver::Measure;

/// A checked case with the name of its output folder.
#[derive(Debug)]
pub struct Source {
    /// The case.
    pub case: Case,
    /// The case file with all that was filled in.
    pub resolved: String,
    /// Name of the case: that of its file without the ending.
    pub name: String,
}

/// What can be told and drawn of a shape file.
#[derive(Debug)]
pub struct Shapes {
    /// Outline of the solids.
    pub outline: Lines<'static>,
    /// Signed distance on a grid, in the field `wall-distance`.
    pub distance: Grid<'static>,
    /// Porosity, specific surface, throats.
    pub measures: Vec<Measure>,
}

fn not_linked(what: &str) -> Failure {
    Failure::new(BAD_INPUT, &format_args!("{what} is not linked"))
}

/// Loads a case file, or the built-in case where there is none.
pub fn load_case(_path: Option<&Path>, _overrides: &[String]) -> Result<Source, Failure> {
    Err(not_linked("the case reader"))
}

/// Loads and measures a shape file.
pub fn load_shapes(_path: &Path) -> Result<Shapes, Failure> {
    Err(not_linked("the geometry"))
}

/// The commented starter case.
pub fn starter_case() -> Result<String, Failure> {
    Err(not_linked("the case reader"))
}

/// The JSON schema of a case file.
pub fn schema() -> Result<String, Failure> {
    Err(not_linked("the case reader"))
}
