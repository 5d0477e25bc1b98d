//! What can be told of a run before it starts: what it would take, doubts, and which model can answer.

use super::advice::{self, Advice};
use super::description::doubts;
use super::setup;
use super::trial::{Trial, trial};
use crate::case::Case;
use crate::solver::{Series, Solver, SolverError};

/// A case whose first steps were tried.
#[derive(Debug)]
pub struct Checked {
    /// What a run would take.
    pub(crate) trial: Trial,
    /// What a reader should know before a run.
    pub(crate) warnings: Vec<String>,
    /// What both models would take, where both can be asked.
    pub(crate) advice: Option<Advice>,
}

/// Tries the first steps of a case with its solver at time zero, without any file; `tried` receives the share of them that is done.
///
/// # Errors
/// [`SolverError`] of a step that fails.
pub fn check(case: &Case, solver: &mut dyn Solver, tried: &mut dyn FnMut(f64)) -> Result<Checked, SolverError> {
    // Those with which a run begins: they do not depend on how many steps are tried.
    let mut warnings = setup::warnings(case, solver, &Series::default());
    warnings.extend(doubts(case));
    let trial = trial(case, solver, tried)?;
    let advice = advice::advice(case, Some(&trial));
    Ok(Checked { trial, warnings, advice })
}

impl Checked {
    /// The keys of the trial, `warnings` and, where there is one, `advice`.
    ///
    /// # Errors
    /// None that is known: all of it can be written as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let mut told = serde_json::to_value(&self.trial)?;
        told["warnings"] = serde_json::to_value(&self.warnings)?;
        if let Some(advice) = &self.advice {
            told["advice"] = serde_json::to_value(advice)?;
        }
        serde_json::to_string_pretty(&told)
    }
}
