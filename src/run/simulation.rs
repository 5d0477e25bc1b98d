//! The loop of a run: steps the solver to each stop of the schedule and records what is due.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use super::processor_time::ProcessorTime;
use super::schedule::{Due, Schedule};
use super::sink::{Frame, SeriesSink, Start, VtkFiles, write_units};
use super::steady::is_steady;
use super::writer::{Record, Writer};
use crate::case::SteadyStop;
use crate::io::frames::{self, FrameList};
use crate::io::journal::Mark;
use crate::io::restart::Saved;
use crate::io::vtk::Compression;
use crate::io::{FileError, atomic, pvd, vtk};
use crate::solver::{Clock, PartTime, Series, Solver, SolverError, StepInfo};

/// How a run ended.
#[derive(Debug)]
pub(crate) enum Outcome {
    /// It reached the end, or was steady before.
    Done,
    /// It was asked to stop, and can be resumed.
    Interrupted,
    /// The solver failed; its last good state was saved.
    Failed(SolverError),
}

/// Where a run stands after a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// What `time`, `end` and `dt` count.
    pub clock: Clock,
    /// Time in s.
    pub time: f64,
    /// End of the run in s.
    pub end: f64,
    /// Steps since time zero.
    pub step: u64,
    /// The last time step in s.
    pub dt: f64,
    /// The limit that ruled it.
    pub limit: &'static str,
}

impl Progress {
    /// Where a solver stands after a step towards the end of its run.
    pub(crate) fn after(solver: &dyn Solver, step: StepInfo, end: f64) -> Self {
        Self { clock: solver.clock(), time: solver.time(), end, step: solver.steps(), dt: step.dt, limit: step.limit }
    }
}

/// Someone who is told of each step: a progress bar, say.
pub trait Watcher {
    /// A step was done.
    fn stepped(&mut self, progress: &Progress);

    /// A row of the series is about to be recorded, and after it whatever else is due: the saved state never runs ahead of this.
    ///
    /// # Errors
    /// [`FileError`] where something cannot be written.
    fn recorded(&mut self, _: &dyn Solver) -> Result<(), FileError> {
        Ok(())
    }
}

/// No one.
pub struct Unwatched;

impl Watcher for Unwatched {
    fn stepped(&mut self, _: &Progress) {}
}

/// All that a run writes while it goes on, and the wall time it takes.
pub(crate) struct Records {
    series: SeriesSink,
    writer: Writer,
    processor_time: ProcessorTime,
    case_hash: u64,
    compression: Compression,
    seconds: [f64; 3],
}

impl Records {
    /// The records of a run in `folder`, which exists.
    ///
    /// # Errors
    /// [`FileError`] where files of a resumed run cannot be read.
    pub(crate) fn new(
        folder: &Path,
        case_hash: u64,
        start: Start,
        compression: Compression,
        processor_time: ProcessorTime,
    ) -> Result<Self, FileError> {
        let (written, list) = match start {
            Start::New => (Vec::new(), FrameList::new(folder)),
            Start::Resumed { frames, .. } => (frames::read(folder, frames)?, FrameList::resume(folder, frames)?),
        };
        pvd::rebuild(folder, &written)?;
        Ok(Self {
            series: SeriesSink::new(folder, start)?,
            writer: Writer::start(folder, VtkFiles::new(folder, written, compression), list)?,
            processor_time,
            case_hash,
            compression,
            seconds: [0.0; 3],
        })
    }

    /// The rows of the series so far.
    pub(crate) fn series(&self) -> &Series {
        self.series.series()
    }

    /// Processor time in s of all processes that worked at the run; none where one did not tell.
    pub(crate) fn processor_time(&self) -> Option<f64> {
        self.processor_time.seconds()
    }

    /// Waits until all records are written.
    ///
    /// # Errors
    /// [`FileError`] where one could not be written.
    pub(crate) fn finish(&mut self) -> Result<(), FileError> {
        self.writer.finish()
    }

    /// Wall time that records took from the solver, by part, in s.
    pub(crate) fn parts(&self) -> Vec<PartTime> {
        let names = ["output: series", "output: vtk", "output: restart"];
        names.into_iter().zip(self.seconds).map(|(part, seconds)| PartTime { part, seconds }).collect()
    }

    /// Records what is due. The saved state comes last: it never runs ahead of the other files. Files other than the series are written while the
    /// solver goes on.
    fn record(&mut self, solver: &dyn Solver, due: Due) -> Result<(), FileError> {
        let mut clock = Instant::now();
        let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
        if due.series {
            self.series.record(solver)?;
        }
        self.seconds[0] += lap();
        if due.vtk {
            self.writer.write(Record::Frame(Box::new(Frame::of(solver))))?;
        }
        self.seconds[1] += lap();
        if due.restart {
            let (time, step, state) = (solver.time(), solver.steps(), solver.state());
            let (series, frames) = (self.series.mark(), Mark::default());
            let saved = Saved { case_hash: self.case_hash, time, step, series, frames, state };
            self.writer.write(Record::State(saved, self.processor_time.seconds()))?;
        }
        self.seconds[2] += lap();
        Ok(())
    }
}

/// A run in progress.
pub(crate) struct Simulation<'a> {
    /// The solver.
    pub(crate) solver: &'a mut dyn Solver,
    /// When to record.
    pub(crate) schedule: Schedule,
    /// When the run ends before its end, where it does.
    pub(crate) steady: Option<SteadyStop>,
    /// What records.
    pub(crate) records: &'a mut Records,
    /// Set by others to stop the run after the present step.
    pub(crate) interrupt: &'a AtomicBool,
    /// Who is told of each step.
    pub(crate) watcher: &'a mut dyn Watcher,
}

impl Simulation<'_> {
    /// Writes `solid.vtu` and the record of time zero.
    pub(crate) fn begin(&mut self, folder: &Path) -> Result<(), FileError> {
        self.write_outline(folder)?;
        self.record(Due::ALL)
    }

    /// Writes anew what follows from the solver whatever its state: `solid.vtu` and `units.json`.
    pub(crate) fn go_on(&mut self, folder: &Path) -> Result<(), FileError> {
        self.write_outline(folder)?;
        write_units(folder, &Frame::of(self.solver))
    }

    fn write_outline(&self, folder: &Path) -> Result<(), FileError> {
        let path = folder.join("solid.vtu");
        let outline = vtk::lines(&self.solver.outline(), self.records.compression)
            .map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
        atomic::write(&path, &outline)
    }

    /// Whether the run ends here as it is steady: as its last row tells.
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
        self.records.record(self.solver, due)
    }

    /// Records what is due at a stop, row first, and everything where the run is steady by then.
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
    /// [`FileError`] where a record cannot be written.
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
