//! Runs the samples of an ensemble in parallel within this process. No result depends on the number of threads.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::plan::{Ensemble, PlannedSample};
use super::store::{self, Done};
use crate::run::ensemble::{Map, Observed};
use crate::run::report::{Reading, Status};
use crate::study::definition::Study;
use crate::study::folder::StudyFolder;
use crate::study::results::{RunReport, RunResult, RunState, Total, Unknowns};
use meniscus_output::FileError;

/// Time between two saves.
const BETWEEN_SAVES: Duration = Duration::from_secs(5);

/// Samples per thread between two checks of the time.
const PER_THREAD: usize = 4;

/// Why an ensemble cannot be run.
#[derive(Debug, thiserror::Error)]
pub(crate) enum EnsembleError {
    /// The network of a map.
    #[error("the network of run {run} cannot be set up: {why}")]
    Network {
        /// Number of the run.
        run: usize,
        /// What is wrong.
        why: String,
    },
    /// A file error.
    #[error(transparent)]
    File(#[from] FileError),
}

/// Runs samples.
pub(crate) struct Engine<'a> {
    /// The study.
    pub(crate) study: &'a Study,
    /// Its samples.
    pub(crate) ensemble: &'a Ensemble,
    /// The finished samples.
    pub(crate) done: Vec<Option<Done>>,
}

impl<'a> Engine<'a> {
    /// The engine of an ensemble with the samples finished so far.
    pub(crate) fn new(study: &'a Study, ensemble: &'a Ensemble, folder: &StudyFolder) -> Self {
        let digests: Vec<u64> = ensemble.samples.iter().map(|sample| sample.digest).collect();
        Self { study, ensemble, done: store::load(folder.root(), &digests) }
    }

    /// Number of finished samples, without failed ones.
    pub(crate) fn count(&self) -> usize {
        self.done.iter().flatten().filter_map(Done::observed).count()
    }

    /// The map of each group.
    ///
    /// # Errors
    /// [`EnsembleError`] if the network of its first sample cannot be set up.
    pub(crate) fn maps(&self) -> Result<Vec<Map>, EnsembleError> {
        let of_group = |first: usize| {
            let map = self.ensemble.with(self.study, first, |case, ground| ground.map(case));
            map.map_err(|why| EnsembleError::Network { run: self.ensemble.samples[first].run.index, why })
        };
        self.ensemble.groups.iter().map(|group| of_group(group.first)).collect()
    }

    /// Runs all unfinished samples. Finished ones are saved every few seconds, and at an interrupt; `progress` is called with the number of samples that have
    /// ended.
    ///
    /// # Errors
    /// [`EnsembleError`]; a failing sample is not an error.
    pub(crate) fn run(
        &mut self,
        maps: &[Map],
        folder: &StudyFolder,
        interrupt: &AtomicBool,
        progress: &mut dyn FnMut(usize),
    ) -> Result<(), EnsembleError> {
        let is_open = |index: &usize| self.done[*index].as_ref().and_then(Done::observed).is_none();
        let todo: Vec<usize> = (0..self.done.len()).filter(is_open).collect();
        let mut last_save = Instant::now();
        for some in todo.chunks(PER_THREAD * rayon::current_num_threads()) {
            if interrupt.load(Ordering::Relaxed) {
                break;
            }
            let ended: Vec<Option<Done>> = some.par_iter().map(|&index| self.one(index, maps, interrupt)).collect();
            for (&index, done) in some.iter().zip(ended) {
                self.done[index] = done;
            }
            if last_save.elapsed() > BETWEEN_SAVES {
                store::save(folder.root(), &self.done)?;
                last_save = Instant::now();
                progress(self.count());
            }
        }
        Ok(store::save(folder.root(), &self.done)?)
    }

    fn one(&self, index: usize, maps: &[Map], interrupt: &AtomicBool) -> Option<Done> {
        let PlannedSample { digest, group, .. } = self.ensemble.samples[index];
        let clock = Instant::now();
        let run = self
            .ensemble
            .with(self.study, index, |case, ground| ground.run(case, &maps[group], self.ensemble.costly, interrupt));
        let seconds = clock.elapsed().as_secs_f64();
        Some(Done { digest, ended: run.transpose()?.map(|observed| Observed { seconds, ..observed }) })
    }

    /// The samples as runs of the study.
    pub(crate) fn results(&self) -> Vec<RunResult> {
        self.ensemble.samples.iter().zip(&self.done).map(|(sample, done)| result(sample, done.as_ref())).collect()
    }
}

fn result(sample: &PlannedSample, done: Option<&Done>) -> RunResult {
    let report = |status: Status, error: Option<String>| RunReport {
        status,
        error,
        steps: 0,
        measures: BTreeMap::new(),
        resolved_case: String::new(),
        wall_time_s: Total { total: 0.0 },
        cpu_s: None,
        solver: Unknowns { unknowns: 0, wall_time_s: None },
    };
    let state = match done.map(|done| &done.ended) {
        None => RunState::New,
        Some(Err(why)) => RunState::Failed(Box::new(report(Status::Failed, Some(why.clone())))),
        Some(Ok(observed)) => {
            let reading = |(name, unit, value): &(String, String, f64)| {
                let value = Some(*value).filter(|value| value.is_finite());
                let unit = unit.clone();
                (name.clone(), Reading { value, unit, uncertainty: None, method: String::new(), not_at_rest: None })
            };
            RunState::Complete(Box::new(RunReport {
                steps: observed.steps,
                measures: observed.measures.iter().map(reading).collect(),
                wall_time_s: Total { total: observed.seconds },
                solver: Unknowns { unknowns: observed.pores, wall_time_s: None },
                ..report(Status::Done, None)
            }))
        }
    };
    RunResult { run: sample.run.clone(), state }
}
