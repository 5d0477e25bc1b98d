//! From a checked case to its solver: the one place that knows both.

use crate::case::checked::Case;
use crate::solver::Solver;

/// A case that no solver can be made for.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// The program has no solver for the model.
    #[error("solver not linked")]
    NotLinked,
}

/// The solver of a case, in its initial state.
///
/// # Errors
/// [`SetupError`].
pub fn build(_case: &Case) -> Result<Box<dyn Solver>, SetupError> {
    Err(SetupError::NotLinked)
}
