//! The expected cost of each run: particles, memory, time. Estimated from the first steps of each in a separate process, and kept in the study folder for
//! unchanged runs.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::child::Program;
use super::run::PlannedRun;
use crate::run::trial::Trial;
use meniscus_output::atomic;

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

/// Estimates of runs in their order. `path` is a file of earlier ones, which is read if it exists and written if `write` is set; an interrupt leaves the rest
/// unknown.
pub(crate) fn estimates(
    runs: &[PlannedRun],
    program: &Program,
    cores: Cores,
    path: &Path,
    write: bool,
    interrupt: &AtomicBool,
) -> Vec<Estimate> {
    // A missing or damaged file only costs another trial.
    let kept = std::fs::read(path).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let mut known: BTreeMap<String, Trial> = kept.unwrap_or_default();
    let key = |run: &PlannedRun| format!("{}-{}", run.digest(), cores.threads);
    let estimate = |run: &PlannedRun| {
        if interrupt.load(Ordering::Relaxed) {
            return Err("interrupted".to_owned());
        }
        known.get(&key(run)).map_or_else(|| tried(program, run, cores.threads), |trial| Ok(trial.clone()))
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(cores.jobs.min(runs.len()).max(1)).build();
    let estimates: Vec<Estimate> = match pool {
        Ok(pool) => pool.install(|| runs.par_iter().map(estimate).collect()),
        Err(_) => runs.iter().map(estimate).collect(),
    };
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

fn tried(program: &Program, run: &PlannedRun, threads: usize) -> Estimate {
    let text = program.check(&run.run, threads)?;
    serde_json::from_slice(&text).map_err(|error| error.to_string())
}
