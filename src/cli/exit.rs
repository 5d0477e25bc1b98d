//! Exit codes, and the failures that lead to them.

use std::fmt::Display;

use miette::Diagnostic;

use super::output::red;

/// Success.
pub(crate) const DONE: u8 = 0;
/// The program itself is wrong: please report it.
pub(crate) const BUG: u8 = 1;
/// The command line, or a folder or file that it names for output, cannot be used.
pub(crate) const USAGE: u8 = 2;
/// A case or a shape file is wrong.
pub(crate) const BAD_INPUT: u8 = 3;
/// The solver failed; its last valid state was saved.
pub(crate) const SOLVER_FAILED: u8 = 4;
/// The run reached its end, but a measure is not what the case expects.
pub(crate) const EXPECTATION_FAILED: u8 = 5;
/// Interrupted by Ctrl-C; the run can be resumed. 128 plus the number of the signal, as in shells.
pub(crate) const INTERRUPTED: u8 = 130;

/// Why a command ends early: the exit code and the message.
#[derive(Debug)]
pub(crate) struct Failure {
    /// One of the constants of this module.
    pub(crate) code: u8,
    /// The whole text for standard error.
    pub(crate) message: String,
}

impl Failure {
    /// A failure with its error, in one line.
    pub(crate) fn new(code: u8, error: impl Display) -> Self {
        Self { code, message: format!("{}: {error}", red("error")) }
    }

    /// [`Failure::new`], for `map_err`.
    pub(crate) fn with<E: Display>(code: u8) -> impl Fn(E) -> Self {
        move |error| Self::new(code, error)
    }

    /// A mistake in a case or shape file, with its location.
    pub(crate) fn input(error: impl Diagnostic + Send + Sync + 'static) -> Self {
        Self { code: BAD_INPUT, message: format!("{:?}", miette::Report::new(error)) }
    }
}
