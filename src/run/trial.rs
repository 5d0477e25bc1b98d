//! Estimates the cost of a run: some first steps of its solver, without any file.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::execute::drawn;
use super::memory;
use super::schedule::Schedule;
use super::sink::compression;
use meniscus_case::Case;
use meniscus_core::solver::{Solver, SolverError};
use meniscus_output::vtk;

/// Number of trial steps; the first ones set up what later ones reuse.
const TRIAL_STEPS: usize = 5;

/// The same if there is no other estimate of the number of steps: an accelerating flow soon takes shorter ones.
const MORE_STEPS: usize = 20;

/// No further step is tried after this time in s: those of many particles take long, and one of them is enough.
const PATIENCE: f64 = 10.0;

/// The estimated cost of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) struct Trial {
    /// Number of unknowns: particles or nodes.
    pub(crate) unknowns: usize,
    /// Length of the last trial step in s.
    pub(crate) time_step_s: f64,
    /// The limit that set it.
    pub(crate) limit: String,
    /// Expected number of steps.
    pub(crate) steps: f64,
    /// Expected wall time in s with the present number of threads.
    pub(crate) duration_s: f64,
    /// Peak memory of this process so far in bytes, if the system reports it.
    pub(crate) memory_bytes: Option<u64>,
}

/// Does the first steps of a case with its solver at time zero: five, or twenty if there is no other estimate of their number, or as many as ten seconds allow,
/// at least one. `tried` receives the completed fraction of the five, after each and before the first.
///
/// # Errors
/// [`SolverError`] of a step that fails.
pub(crate) fn trial(case: &Case, solver: &mut dyn Solver, tried: &mut dyn FnMut(f64)) -> Result<Trial, SolverError> {
    trial_within(case, solver, PATIENCE, tried)
}

/// [`trial`] with as many steps as `patience` (s) allows.
fn trial_within(
    case: &Case,
    solver: &mut dyn Solver,
    patience: f64,
    tried: &mut dyn FnMut(f64),
) -> Result<Trial, SolverError> {
    let clock = Instant::now();
    tried(0.0);
    // The steps of a run end exactly at its records, which may shorten the first one.
    let schedule = Schedule::new(&case.output, case.end);
    let next = |solver: &dyn Solver| schedule.next_after(solver.time()).map_or(case.end, |stop| stop.time);
    let until = next(solver);
    let mut info = solver.step(until)?;
    let first_s = clock.elapsed().as_secs_f64();
    let most = if solver.steps_to(case.end).is_some() { TRIAL_STEPS } else { MORE_STEPS };
    for step in 1..most {
        tried((step as f64 / TRIAL_STEPS as f64).min(1.0));
        if solver.time() >= case.end || solver.is_done() || clock.elapsed().as_secs_f64() > patience {
            break;
        }
        let until = next(solver);
        let after = solver.step(until)?;
        // A step cut short by a record is not representative.
        if after.limit != "record" || info.limit == "record" {
            info = after;
        }
    }
    let more = solver.steps().saturating_sub(1);
    // The first step sets up what the others reuse.
    let per_step = if more == 0 { first_s } else { (clock.elapsed().as_secs_f64() - first_s) / more as f64 };
    // Time and memory of a record.
    let before_record = clock.elapsed().as_secs_f64();
    let record = || (solver.sample(), solver.snapshot().into_owned(), solver.state());
    let first = record();
    let per_record = clock.elapsed().as_secs_f64() - before_record;
    // A run needs most memory when it draws its picture while one record is being written and the next one waits.
    let waiting = record();
    let content = vtk::points(&first.1.particles, compression(&case.output));
    let grid = first.1.grid.as_ref().map(|grid| vtk::grid(grid, compression(&case.output)));
    let picture = (drawn(case, solver), solver.results());
    drop((first, waiting, content, grid, picture));
    // Steps that grow with time are cut short by every record, most of them late in the run.
    let records = case.end / case.output.series_every.min(case.output.vtk_every).min(case.output.restart_every);
    let known = solver.steps_to(case.end).map(|left| (left + solver.steps() as f64 + records).ceil());
    let steps = known.unwrap_or_else(|| solver.steps() as f64 + steps_between(&schedule, solver.time(), info.dt));
    Ok(Trial {
        unknowns: solver.statistics().unknowns,
        time_step_s: info.dt,
        limit: info.limit.to_owned(),
        steps,
        duration_s: steps * per_step + records * per_record,
        memory_bytes: memory::peak(),
    })
}

/// Number of steps of length `dt` (s) from `time` (s) to the end, with a step end at each record.
fn steps_between(schedule: &Schedule, mut time: f64, dt: f64) -> f64 {
    /// An integer up to rounding is an integer.
    const ROUNDING: f64 = 1e-6;
    let mut steps = 0.0;
    while let Some(stop) = schedule.next_after(time) {
        steps += ((stop.time - time) / dt - ROUNDING).ceil().max(1.0);
        time = stop.time;
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::super::mock::{MockSolver, case};
    use super::*;

    #[test]
    fn a_trial_counts_the_steps_that_are_left() {
        let found = trial(&case(), &mut MockSolver::new(), &mut |_| {}).unwrap();
        // The mock takes steps of 0.0234 s, five to each of ten records.
        assert_eq!((found.unknowns, found.steps), (36, 50.0));
        assert!(found.duration_s > 0.0);
    }

    #[test]
    fn a_solver_that_fails_at_once_is_told() {
        let mut solver = MockSolver::new();
        solver.fails_after = Some(2);
        assert!(trial(&case(), &mut solver, &mut |_| {}).is_err());
    }

    #[test]
    fn steps_that_take_long_are_tried_once_and_tell_as_much() {
        for (patience, steps) in [(f64::INFINITY, 20), (0.0, 1)] {
            let (mut solver, mut fractions) = (MockSolver::new(), Vec::new());
            let found = trial_within(&case(), &mut solver, patience, &mut |fraction| fractions.push(fraction)).unwrap();
            assert_eq!((solver.steps(), found.steps), (steps, 50.0));
            assert_eq!(fractions[..2], [0.0, 0.2]);
        }
    }
}
