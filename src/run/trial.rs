//! Estimates the cost of a run: some first steps of its solver, without any file.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::execute::drawn;
use super::memory;
use super::schedule::Schedule;
use super::sink::compression;
use meniscus_case::{Case, Model};
use meniscus_core::solver::{Results, Series, Solver, SolverError};
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
    /// Whether the run may end sooner, so that steps and wall time are upper bounds.
    #[serde(default)]
    pub(crate) is_upper_bound: bool,
    /// Peak memory of this process so far in bytes, if the system reports it.
    pub(crate) memory_bytes: Option<u64>,
}

/// Does the first steps of a case with its solver at time zero, which took `built_s` (s) to read and build: five, or twenty if there is no other estimate of
/// their number, or as many as ten seconds allow, at least one. `tried` receives the completed fraction of the five, after each and before the first.
///
/// # Errors
/// [`SolverError`] of a step that fails.
pub(crate) fn trial(
    case: &Case,
    solver: &mut dyn Solver,
    built_s: f64,
    tried: &mut dyn FnMut(f64),
) -> Result<Trial, SolverError> {
    let found = trial_within(case, solver, PATIENCE, tried)?;
    Ok(Trial { duration_s: found.duration_s + built_s, ..found })
}

/// [`trial`] without building, with as many steps as `patience` (s) allows.
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
    // Time and memory of records of each kind, and of the end. A run needs most memory when it draws its picture while one record is being written and the next
    // one waits.
    let (sample, per_sample) = timed(|| solver.sample());
    let (state, per_state) = timed(|| solver.state());
    let waiting = solver.snapshot().into_owned();
    let (frame, per_frame) = timed(|| {
        let (form, snapshot) = (compression(&case.output), solver.snapshot().into_owned());
        let files = [
            Some(vtk::points(&snapshot.particles, form)),
            snapshot.grid.as_ref().map(|grid| vtk::grid(grid, form)),
            snapshot.interface.as_ref().map(|interface| vtk::lines(interface, form)),
        ];
        let layers: Vec<_> = solver.layers().iter().map(|layer| vtk::layer(layer, form)).collect();
        (snapshot, files, layers)
    });
    let (ending, at_end) = timed(|| {
        let Results { tables, layers, documents } = solver.results();
        let _ = tables.iter().map(|table| table().columns.len()).sum::<usize>();
        let _ = layers.iter().map(|layer| layer().ends.len()).sum::<usize>();
        let _ = documents.iter().map(|document| document.text().len()).sum::<usize>();
        (drawn(case, solver).ok(), solver.measures(&Series::default()).len())
    });
    drop((sample, state, waiting, frame, ending));
    let output = &case.output;
    let kinds = [(output.series_every, per_sample), (output.vtk_every, per_frame), (output.restart_every, per_state)];
    let recording: f64 = kinds.iter().map(|(every, seconds)| case.end / every * seconds).sum();
    // Steps that grow with time are cut short by every record, most of them late in the run.
    let records = case.end / kinds.iter().map(|(every, _)| *every).fold(f64::INFINITY, f64::min);
    let known = solver.steps_to(case.end).map(|left| (left + solver.steps() as f64 + records).ceil());
    let steps = known.unwrap_or_else(|| solver.steps() as f64 + steps_between(&schedule, solver.time(), info.dt));
    Ok(Trial {
        unknowns: solver.statistics().unknowns,
        time_step_s: info.dt,
        limit: info.limit.to_owned(),
        steps,
        duration_s: steps * per_step + recording + at_end,
        is_upper_bound: may_end_sooner(case),
        memory_bytes: memory::peak(),
    })
}

/// Whether a run of the case ends where something has happened, and not only at its end.
fn may_end_sooner(case: &Case) -> bool {
    case.steady.is_some_and(|steady| steady.stop)
        || match &case.model {
            Model::Sph(sph) => sph.stop_at_breakthrough,
            Model::Network(_) => true,
            Model::ThinFilm(_) => false,
        }
}

/// What a function returns, and its wall time in s.
fn timed<T>(function: impl FnOnce() -> T) -> (T, f64) {
    let clock = Instant::now();
    let found = function();
    (found, clock.elapsed().as_secs_f64())
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
        let found = trial(&case(), &mut MockSolver::new(), 0.0, &mut |_| {}).unwrap();
        // The mock takes steps of 0.0234 s, five to each of ten records.
        assert_eq!((found.unknowns, found.steps), (36, 50.0));
        assert!(found.duration_s > 0.0);
    }

    #[test]
    fn a_solver_that_fails_at_once_is_told() {
        let mut solver = MockSolver::new();
        solver.fails_after = Some(2);
        assert!(trial(&case(), &mut solver, 0.0, &mut |_| {}).is_err());
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
