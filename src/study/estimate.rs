//! The expected cost of each run: particles, memory, time. Estimated from the first steps of each in a separate process, and kept in the study folder for
//! unchanged runs.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::child::Program;
use super::run::PlannedRun;
use crate::io::atomic;
use crate::run::trial::Trial;

/// The expected cost of a run, or why it is not known.
pub(crate) type Estimate = Result<Trial, String>;

/// Number of concurrent processes, and threads of each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cores {
    /// Threads of each run.
    pub(crate) threads: usize,
    /// Concurrent runs.
    pub(crate) jobs: usize,
}

/// Estimates of runs in their order. `kept` is a file of earlier ones, which is read if it exists and written if `write` is set; an interrupt leaves the rest
/// unknown.
pub(crate) fn estimates(
    runs: &[PlannedRun],
    program: &Program,
    cores: Cores,
    kept: (&Path, bool),
    interrupt: &AtomicBool,
) -> Vec<Estimate> {
    let (path, write) = kept;
    let mut known: BTreeMap<String, Trial> = read(path);
    let key = |run: &PlannedRun| format!("{}-{}", run.digest(), cores.threads);
    let next = AtomicUsize::new(0);
    let found: Mutex<BTreeMap<usize, Estimate>> = Mutex::new(BTreeMap::new());
    let work = || {
        while let Some((number, run)) = take(&next, runs) {
            let estimate = if interrupt.load(Ordering::Relaxed) {
                Err("interrupted".to_owned())
            } else if let Some(trial) = known.get(&key(run)) {
                Ok(trial.clone())
            } else {
                tried(program, run, cores.threads)
            };
            // A poisoned lock means that another thread panicked, which ends the program anyway.
            if let Ok(mut found) = found.lock() {
                found.insert(number, estimate);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..cores.jobs.min(runs.len()) {
            scope.spawn(work);
        }
    });
    let mut found = found.into_inner().unwrap_or_default();
    let estimates: Vec<Estimate> =
        (0..runs.len()).map(|number| found.remove(&number).unwrap_or_else(|| Err("not tried".to_owned()))).collect();
    for (run, estimate) in runs.iter().zip(&estimates) {
        if let Ok(trial) = estimate {
            known.insert(key(run), trial.clone());
        }
    }
    if write && let Ok(text) = serde_json::to_vec_pretty(&known) {
        // Without it, the next start tries again.
        let _ = atomic::write(path, &text);
    }
    estimates
}

/// The next run that is not taken.
fn take<'a>(next: &AtomicUsize, runs: &'a [PlannedRun]) -> Option<(usize, &'a PlannedRun)> {
    let number = next.fetch_add(1, Ordering::Relaxed);
    runs.get(number).map(|run| (number, run))
}

fn read(path: &Path) -> BTreeMap<String, Trial> {
    // A missing or damaged file only costs another trial.
    std::fs::read(path).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok()).unwrap_or_default()
}

fn tried(program: &Program, run: &PlannedRun, threads: usize) -> Estimate {
    let text = program.check(&run.run, threads)?;
    serde_json::from_slice(&text).map_err(|error| error.to_string())
}
