//! Checks before a run: its cost, doubts, and which model is applicable.

use super::advice::{self, Advice};
use super::description::doubts;
use super::setup;
use super::trial::{Trial, trial};
use meniscus_case::Case;
use meniscus_core::solver::{Series, Solver, SolverError};

/// A case whose first steps were tried.
#[derive(Debug)]
pub struct Checked {
    /// Estimated cost of a run.
    pub(crate) trial: Trial,
    /// Warnings before a run.
    pub(crate) warnings: Vec<String>,
    /// The cost of both models, if both are possible.
    pub(crate) advice: Option<Advice>,
}

/// Tries the first steps of a case with its solver at time zero, which took `built_s` (s) to build, without any file; `tried` receives the completed fraction.
///
/// # Errors
/// [`SolverError`] of a step that fails.
pub fn check(
    case: &Case,
    solver: &mut dyn Solver,
    built_s: f64,
    tried: &mut dyn FnMut(f64),
) -> Result<Checked, SolverError> {
    // The warnings at the start of a run: they do not depend on the number of trial steps.
    let mut warnings = setup::warnings(case, solver, &Series::default());
    warnings.extend(doubts(case));
    let trial = trial(case, solver, built_s, tried)?;
    let advice = advice::advice(case, Some(&trial));
    Ok(Checked { trial, warnings, advice })
}

impl Checked {
    /// The keys of the trial, `warnings` and, where there is one, `advice`.
    ///
    /// # Errors
    /// None that is known: all of it can be written as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let mut report = serde_json::to_value(&self.trial)?;
        report["warnings"] = serde_json::to_value(&self.warnings)?;
        if let Some(advice) = &self.advice {
            report["advice"] = serde_json::to_value(advice)?;
        }
        serde_json::to_string_pretty(&report)
    }
}
