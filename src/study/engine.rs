//! All runs of a study on this machine: each as a process, with as many concurrent ones as cores and memory allow.

use std::collections::VecDeque;
use std::fs::OpenOptions;
use std::path::Path;
use std::process::{Child, ExitStatus};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::child::Program;
use super::estimate::{Cores, Estimate};
use super::folder::StudyFolder;
use super::results::{RunState, is_complete, run_state};
use super::run::{PlannedRun, Run};
use crate::run::memory;
use meniscus_output::{FileError, atomic};

/// Exit codes of a process that does one run.
pub(crate) mod code {
    /// Complete.
    pub(crate) const DONE: u8 = 0;
    /// The solver failed.
    pub(crate) const FAILED: u8 = 4;
    /// Interrupted; it can be resumed.
    pub(crate) const INTERRUPTED: u8 = 130;
}

/// Memory reserved for a run relative to that of its first steps: later states need more.
const MEMORY_MARGIN: f64 = 1.5;

/// Memory in bytes for the files and the picture, which the first steps do not write: 10 MiB were measured.
const MEMORY_OF_OUTPUT: f64 = 16.0 * 1_048_576.0;

/// Fraction of the free memory available to runs.
const MEMORY_SHARE: f64 = 0.9;

/// Polling interval of the processes.
const POLLING_INTERVAL: Duration = Duration::from_millis(10);

/// The work to do.
#[derive(Debug)]
pub(crate) struct Work<'a> {
    /// The runs.
    pub runs: &'a [PlannedRun],
    /// The expected cost of each.
    pub estimates: &'a [Estimate],
    /// Folder of the results; claimed by the caller.
    pub folder: &'a StudyFolder,
    /// This program.
    pub program: &'a Program,
    /// Threads and concurrent runs.
    pub cores: Cores,
    /// Memory for all concurrent runs in bytes; `None` if not known.
    pub memory: Option<u64>,
    /// Set from outside to stop.
    pub interrupt: &'a AtomicBool,
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// It had been complete before.
    WasComplete,
    /// It is complete now.
    Complete,
    /// It stopped, and can be resumed.
    Interrupted,
    /// It failed, for this reason.
    Failed(String),
}

/// Progress of the study.
#[derive(Debug)]
pub(crate) enum Event<'a> {
    /// A run was started or resumed.
    Started(&'a Run),
    /// A run ended after this time.
    Ended(&'a Run, &'a End, Duration),
}

/// A running process.
struct Worker {
    number: usize,
    child: Child,
    memory: u64,
    begun: Instant,
}

/// Memory in bytes available to runs, if the system reports it: a fraction of the free memory.
pub(crate) fn free_memory() -> Option<u64> {
    memory::free().map(|free| (free as f64 * MEMORY_SHARE) as u64)
}

/// Memory in bytes reserved for a run; 0 if not known.
pub(crate) fn memory_of(estimate: Option<&Estimate>) -> u64 {
    let known = estimate.and_then(|estimate| estimate.as_ref().ok()).and_then(|trial| trial.memory_bytes);
    known.map_or(0, |bytes| (bytes as f64 * MEMORY_MARGIN + MEMORY_OF_OUTPUT) as u64)
}

/// Does all incomplete runs, the longest first, and continues after a failed one. After an interrupt all processes save their states and end.
///
/// # Errors
/// [`FileError`] if a log cannot be written.
pub(crate) fn work(work: &Work<'_>, progress: &mut dyn FnMut(&Event<'_>)) -> Result<Vec<End>, FileError> {
    let complete = |planned: &PlannedRun| is_complete(&work.folder.run(&planned.run.name), planned);
    let mut ends: Vec<End> =
        work.runs.iter().map(|run| if complete(run) { End::WasComplete } else { End::Interrupted }).collect();
    let mut queue = longest_first(work, &ends);
    let mut workers: Vec<Worker> = Vec::new();
    while !(workers.is_empty() && queue.is_empty()) {
        if work.interrupt.load(Ordering::Relaxed) {
            queue.clear();
            // The closed pipe requests the process to stop.
            workers.iter_mut().for_each(|worker| drop(worker.child.stdin.take()));
        }
        while let Some(&number) = queue.front()
            && has_room(work, &workers, number)
        {
            queue.pop_front();
            match start(work, number)? {
                Ok(worker) => {
                    workers.push(worker);
                    progress(&Event::Started(&work.runs[number].run));
                }
                Err(why) => {
                    ends[number] = End::Failed(why);
                    progress(&Event::Ended(&work.runs[number].run, &ends[number], Duration::ZERO));
                }
            }
        }
        let mut at_work = Vec::new();
        for mut worker in workers {
            let ended = match worker.child.try_wait() {
                Ok(None) => {
                    at_work.push(worker);
                    continue;
                }
                Ok(Some(status)) => end_of(work, worker.number, status),
                Err(error) => End::Failed(error.to_string()),
            };
            ends[worker.number] = ended;
            progress(&Event::Ended(&work.runs[worker.number].run, &ends[worker.number], worker.begun.elapsed()));
        }
        workers = at_work;
        std::thread::sleep(POLLING_INTERVAL);
    }
    Ok(ends)
}

/// The runs to do, longest first; those of unknown duration come before them.
fn longest_first(work: &Work<'_>, ends: &[End]) -> VecDeque<usize> {
    let seconds = |number: &usize| match work.estimates.get(*number) {
        Some(Ok(trial)) => trial.duration_s,
        _ => f64::INFINITY,
    };
    let mut open: Vec<usize> = (0..work.runs.len()).filter(|&number| ends[number] != End::WasComplete).collect();
    open.sort_by(|a, b| seconds(b).total_cmp(&seconds(a)));
    open.into()
}

/// Whether there are cores and memory for one more run.
fn has_room(work: &Work<'_>, workers: &[Worker], number: usize) -> bool {
    let taken: Vec<u64> = workers.iter().map(|worker| worker.memory).collect();
    fits(work.cores.jobs, work.memory, &taken, memory_of(work.estimates.get(number)))
}

/// Whether a run fits beside others with this memory. A single one is always started: its estimate may be wrong.
fn fits(jobs: usize, memory: Option<u64>, taken: &[u64], wanted: u64) -> bool {
    let sum: u64 = taken.iter().sum();
    taken.is_empty() || (taken.len() < jobs && memory.is_none_or(|all| sum + wanted <= all))
}

fn start(work: &Work<'_>, number: usize) -> Result<Result<Worker, String>, FileError> {
    let planned = &work.runs[number];
    let path = work.folder.log(&planned.run.name);
    atomic::make_folder(path.parent().unwrap_or(Path::new("")))?;
    let log = OpenOptions::new().create(true).append(true).open(&path).map_err(FileError::write(&path))?;
    let folder = work.folder.root();
    let started = work.program.start(&planned.run, &planned.digest(), folder, work.cores.threads, log);
    let memory = memory_of(work.estimates.get(number));
    Ok(started
        .map(|child| Worker { number, child, memory, begun: Instant::now() })
        .map_err(|error| format!("cannot be started: {error}")))
}

fn end_of(work: &Work<'_>, number: usize, status: ExitStatus) -> End {
    let planned = &work.runs[number];
    let log = work.folder.log(&planned.run.name);
    match status.code().and_then(|code| u8::try_from(code).ok()) {
        Some(code::DONE) => End::Complete,
        Some(code::INTERRUPTED) => End::Interrupted,
        Some(code::FAILED) => {
            let state = run_state(&work.folder.run(&planned.run.name), &planned.resolved);
            let why = match state {
                RunState::Failed(report) => report.error,
                _ => None,
            };
            End::Failed(why.unwrap_or_else(|| format!("the solver failed; see {}", log.display())))
        }
        _ => End::Failed(format!("its process ended with {status}; see {}", log.display())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_start_while_jobs_and_memory_last_and_one_always_does() {
        assert!(fits(2, Some(100), &[], 500));
        assert!(fits(2, Some(100), &[60], 40) && !fits(2, Some(100), &[60], 41));
        assert!(fits(2, None, &[60], 500) && !fits(2, None, &[1, 1], 1));
    }

    #[test]
    fn the_memory_of_a_run_has_a_margin_and_is_nothing_where_it_is_not_known() {
        assert_eq!(memory_of(Some(&Err("unknown".to_owned()))), 0);
        assert_eq!(memory_of(None), 0);
    }
}
