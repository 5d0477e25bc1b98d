//! All runs of a study on this machine: each in a process of its own, as many at once as cores and memory allow.

use std::collections::VecDeque;
use std::fs::OpenOptions;
use std::path::Path;
use std::process::{Child, ExitStatus};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::child::Program;
use super::estimate::{Cores, Estimate};
use super::folder::StudyFolder;
use super::results::{Standing, is_complete, standing};
use super::run::{PlannedRun, Run};
use crate::io::{FileError, atomic};
use crate::run::memory;

/// Exit codes of a process that does one run.
pub(crate) mod code {
    /// Complete.
    pub(crate) const DONE: u8 = 0;
    /// The solver failed.
    pub(crate) const FAILED: u8 = 4;
    /// Interrupted; it can be taken up.
    pub(crate) const INTERRUPTED: u8 = 130;
}

/// Memory that a run is given over what its first steps took: later states take more.
const MEMORY_MARGIN: f64 = 1.5;

/// Memory in bytes for the files and the picture, which the first steps do not write: 10 MiB were measured.
const MEMORY_OF_OUTPUT: f64 = 16.0 * 1_048_576.0;

/// Share of the free memory that runs may take.
const MEMORY_SHARE: f64 = 0.9;

/// Time between two looks at the processes.
const BETWEEN_LOOKS: Duration = Duration::from_millis(10);

/// What is to be done.
#[derive(Debug)]
pub(crate) struct Work<'a> {
    /// The runs.
    pub runs: &'a [PlannedRun],
    /// What each is expected to take.
    pub estimates: &'a [Estimate],
    /// Where the results go; claimed by the caller.
    pub folder: &'a StudyFolder,
    /// This program.
    pub program: &'a Program,
    /// Threads and runs at once.
    pub cores: Cores,
    /// Memory for all runs at once in bytes; absent where it is not known.
    pub memory: Option<u64>,
    /// Set by others to stop.
    pub interrupt: &'a AtomicBool,
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// It was complete before.
    WasComplete,
    /// It is complete now.
    Complete,
    /// It stopped, and can be taken up.
    Interrupted,
    /// It failed: why.
    Failed(String),
}

/// What happened.
#[derive(Debug)]
pub(crate) enum Event<'a> {
    /// A run was begun or taken up.
    Started(&'a Run),
    /// A run ended after so long.
    Ended(&'a Run, &'a End, Duration),
}

/// A process at work.
struct Worker {
    number: usize,
    child: Child,
    memory: u64,
    begun: Instant,
}

/// Memory that runs may take in bytes, where the system tells: a share of what is free.
pub(crate) fn free_memory() -> Option<u64> {
    memory::free().map(|free| (free as f64 * MEMORY_SHARE) as u64)
}

/// Memory that is kept for a run in bytes; 0 where it is not known.
pub(crate) fn memory_of(estimate: Option<&Estimate>) -> u64 {
    let known = estimate.and_then(|estimate| estimate.as_ref().ok()).and_then(|trial| trial.memory_bytes);
    known.map_or(0, |bytes| (bytes as f64 * MEMORY_MARGIN + MEMORY_OF_OUTPUT) as u64)
}

/// Does all runs that are not complete, those that take longest first, and goes on after a failed one. After an interrupt all
/// processes save their states and end.
///
/// # Errors
/// [`FileError`] where a log cannot be written.
pub(crate) fn work(work: &Work<'_>, told: &mut dyn FnMut(&Event<'_>)) -> Result<Vec<End>, FileError> {
    let complete = |planned: &PlannedRun| is_complete(&work.folder.run(&planned.run.name), planned);
    let mut ends: Vec<End> =
        work.runs.iter().map(|run| if complete(run) { End::WasComplete } else { End::Interrupted }).collect();
    let mut queue = longest_first(work, &ends);
    let mut workers: Vec<Worker> = Vec::new();
    while !(workers.is_empty() && queue.is_empty()) {
        if work.interrupt.load(Ordering::Relaxed) {
            queue.clear();
            // The closed pipe asks the process to stop.
            workers.iter_mut().for_each(|worker| drop(worker.child.stdin.take()));
        }
        while let Some(&number) = queue.front()
            && has_room(work, &workers, number)
        {
            queue.pop_front();
            match start(work, number)? {
                Ok(worker) => {
                    workers.push(worker);
                    told(&Event::Started(&work.runs[number].run));
                }
                Err(why) => {
                    ends[number] = End::Failed(why);
                    told(&Event::Ended(&work.runs[number].run, &ends[number], Duration::ZERO));
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
            told(&Event::Ended(&work.runs[worker.number].run, &ends[worker.number], worker.begun.elapsed()));
        }
        workers = at_work;
        std::thread::sleep(BETWEEN_LOOKS);
    }
    Ok(ends)
}

/// The runs to do; those of unknown duration come first.
fn longest_first(work: &Work<'_>, ends: &[End]) -> VecDeque<usize> {
    let seconds = |number: &usize| match work.estimates.get(*number) {
        Some(Ok(trial)) => trial.duration_s,
        _ => f64::INFINITY,
    };
    let mut open: Vec<usize> = (0..work.runs.len()).filter(|&number| ends[number] != End::WasComplete).collect();
    open.sort_by(|a, b| seconds(b).total_cmp(&seconds(a)));
    open.into()
}

/// Whether cores and memory are left for one more run.
fn has_room(work: &Work<'_>, workers: &[Worker], number: usize) -> bool {
    let taken: Vec<u64> = workers.iter().map(|worker| worker.memory).collect();
    fits(work.cores.jobs, work.memory, &taken, memory_of(work.estimates.get(number)))
}

/// Whether a run fits beside others of so much memory. One alone always does: what is known of it may be wrong.
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
            let standing = standing(&work.folder.run(&planned.run.name), &planned.resolved);
            let why = match standing {
                Standing::Failed(report) => report.error,
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
