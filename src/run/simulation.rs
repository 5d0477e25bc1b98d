//! The loop of a run: steps the solver to each stop of the schedule and records what is due.

use std::sync::atomic::{AtomicBool, Ordering};

use super::records::Records;
use super::schedule::{Due, Schedule};
use super::steady::is_steady;
use meniscus_case::SteadyStop;
use meniscus_core::solver::{Clock, Solver, SolverError, StepInfo};
use meniscus_output::FileError;

/// How a run ended.
#[derive(Debug)]
pub(crate) enum Outcome {
    /// It reached the end, or was steady before.
    Done,
    /// It was stopped on request, and can be resumed.
    Interrupted,
    /// The solver failed; its last valid state was saved.
    Failed(SolverError),
}

/// The progress of a run after a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The quantity of `time`, `end` and `dt`.
    pub clock: Clock,
    /// Time in s.
    pub time: f64,
    /// End of the run in s.
    pub end: f64,
    /// Steps since time zero.
    pub step: u64,
    /// The last time step in s.
    pub dt: f64,
    /// The limit that set it.
    pub limit: &'static str,
}

impl Progress {
    /// The progress of a solver after a step towards the end of its run.
    pub(crate) fn after(solver: &dyn Solver, step: StepInfo, end: f64) -> Self {
        Self { clock: solver.clock(), time: solver.time(), end, step: solver.steps(), dt: step.dt, limit: step.limit }
    }
}

/// Is notified of each step: a progress bar, say.
pub trait Watcher {
    /// A step was done.
    fn stepped(&mut self, progress: &Progress);

    /// A row of the series is about to be recorded, followed by whatever else is due: the saved state is never ahead of this.
    ///
    /// # Errors
    /// [`FileError`] if something cannot be written.
    fn recorded(&mut self, _: &dyn Solver) -> Result<(), FileError> {
        Ok(())
    }

    /// A frame is about to be recorded: the state that VTK files show.
    fn framed(&mut self, _: &dyn Solver) {}
}

/// A watcher that does nothing.
pub struct Unwatched;

impl Watcher for Unwatched {
    fn stepped(&mut self, _: &Progress) {}
}

/// A run in progress.
pub(crate) struct Simulation<'a> {
    /// The solver.
    pub(crate) solver: &'a mut dyn Solver,
    /// Times of the records.
    pub(crate) schedule: Schedule,
    /// Criterion for ending the run early, if any.
    pub(crate) steady: Option<SteadyStop>,
    /// The records.
    pub(crate) records: &'a mut Records,
    /// Set from outside to stop the run after the present step.
    pub(crate) interrupt: &'a AtomicBool,
    /// Is notified of each step.
    pub(crate) watcher: &'a mut dyn Watcher,
}

impl Simulation<'_> {
    /// Writes `solid.vtu` and the record of time zero.
    pub(crate) fn begin(&mut self) -> Result<(), FileError> {
        self.records.write_outline(self.solver)?;
        self.record(Due::ALL)
    }

    /// Rewrites the files that do not depend on the state: `solid.vtu` and `units.json`.
    pub(crate) fn resume(&mut self) -> Result<(), FileError> {
        self.records.write_outline(self.solver)?;
        self.records.write_units(self.solver)
    }

    /// Whether the run ends here because it is steady, from its last row.
    fn ends_steady(&self) -> bool {
        let series = self.records.series();
        self.steady.is_some_and(|steady| steady.stop && is_steady(series, &self.solver.watched(), &steady))
    }

    /// Whether nothing is left to do.
    pub(crate) fn is_at_end(&self) -> bool {
        self.solver.time() >= self.schedule.end() || self.solver.is_done() || self.ends_steady()
    }

    fn record(&mut self, due: Due) -> Result<(), FileError> {
        if due.series {
            self.watcher.recorded(self.solver)?;
        }
        if due.vtk {
            self.watcher.framed(self.solver);
        }
        self.records.record(self.solver, due)
    }

    /// Records what is due at a stop, the row first, and everything if the run is steady by then.
    fn record_stop(&mut self, due: Due) -> Result<bool, FileError> {
        self.record(Due { vtk: false, restart: false, ..due })?;
        let is_steady = due.series && self.ends_steady();
        let rest = if is_steady { Due::ALL } else { due };
        self.record(Due { series: false, ..rest })?;
        Ok(is_steady)
    }

    /// Runs to the end, to steady state, to an interrupt or to an error of the solver; in the last two cases a state is saved.
    ///
    /// # Errors
    /// [`FileError`] if a record cannot be written.
    pub(crate) fn run(&mut self) -> Result<Outcome, FileError> {
        if self.is_at_end() {
            return Ok(Outcome::Done);
        }
        while let Some(stop) = self.schedule.next_after(self.solver.time()) {
            while self.solver.time() < stop.time {
                if self.interrupt.load(Ordering::Relaxed) {
                    self.record(Due::TO_RESUME)?;
                    return Ok(Outcome::Interrupted);
                }
                match self.solver.step(stop.time) {
                    Ok(info) => self.watcher.stepped(&Progress::after(self.solver, info, self.schedule.end())),
                    Err(error) => {
                        self.record(Due::LAST_GOOD_STATE)?;
                        return Ok(Outcome::Failed(error));
                    }
                }
                if self.solver.is_done() {
                    self.record(Due::ALL)?;
                    return Ok(Outcome::Done);
                }
            }
            if self.record_stop(stop.due)? {
                break;
            }
        }
        Ok(Outcome::Done)
    }
}
