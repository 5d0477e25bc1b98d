//! Runs the samples of an ensemble in parallel within this process. No result depends on the number of threads.

use std::collections::BTreeMap;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::plan::{Ensemble, PlannedSample};
use super::store::{self, Done, Kept};
use crate::case::Case;
use crate::input::InputError;
use crate::io::FileError;
use crate::run::ensemble::{Ground, Map};
use crate::run::report::{Reading, Status};
use crate::study::definition::Study;
use crate::study::folder::StudyFolder;
use crate::study::results::{RunReport, RunResult, RunState, Total, Unknowns};

/// Time between two saves.
const BETWEEN_SAVES: Duration = Duration::from_secs(5);

/// Samples per thread between two checks of the time.
const PER_THREAD: usize = 4;

/// Why an ensemble cannot be run.
#[derive(Debug, thiserror::Error)]
pub(crate) enum EnsembleError {
    /// The case of the map.
    #[error(transparent)]
    Case(#[from] InputError),
    /// Its network.
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

/// Runs samples; each part is created on first use.
pub(crate) struct Engine<'a> {
    study: &'a Study,
    ensemble: &'a Ensemble,
    grounds: Vec<OnceLock<Result<Ground, String>>>,
    /// The finished samples.
    pub(crate) done: Vec<Option<Done>>,
}

impl<'a> Engine<'a> {
    /// The engine of an ensemble with the samples finished so far.
    pub(crate) fn new(study: &'a Study, ensemble: &'a Ensemble, folder: &StudyFolder) -> Self {
        let digests: Vec<u64> = ensemble.samples.iter().map(|sample| sample.digest).collect();
        let grounds = ensemble.grounds.iter().map(|_| OnceLock::new()).collect();
        Self { study, ensemble, grounds, done: store::load(folder.root(), &digests) }
    }

    /// Number of finished samples, without failed ones.
    pub(crate) fn count(&self) -> usize {
        self.done.iter().flatten().filter(|done| done.ended.is_ok()).count()
    }

    fn shared(&self, ground: usize) -> Result<&Ground, String> {
        let made = self.grounds[ground].get_or_init(|| Ground::of(&self.ensemble.grounds[ground]));
        made.as_ref().map_err(Clone::clone)
    }

    /// Applies a function to the case of a sample and its network.
    fn with<T>(&self, index: usize, act: impl FnOnce(&Case, &Ground) -> Result<T, String>) -> Result<T, String> {
        let (case, ground) = self.ensemble.case(self.study, index).map_err(|error| error.render())?;
        match ground {
            Some(ground) => act(&case, self.shared(ground)?),
            None => act(&case, &Ground::of(&case)?),
        }
    }

    /// The map of each group.
    ///
    /// # Errors
    /// [`EnsembleError`] if the network of its first sample cannot be set up.
    pub(crate) fn maps(&self) -> Result<Vec<Map>, EnsembleError> {
        let of_group = |first: usize| {
            let map = self.with(first, |case, ground| ground.map(case));
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
        let open = |done: &Option<Done>| done.as_ref().is_none_or(|done| done.ended.is_err());
        let todo: Vec<usize> = (0..self.done.len()).filter(|&index| open(&self.done[index])).collect();
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
        let ended = self.with(index, |case, ground| ground.run(case, &maps[group], self.ensemble.costly, interrupt));
        let ended = ended.transpose()?.map(|outcome| Kept::of(outcome, clock.elapsed().as_secs_f64()));
        Some(Done { digest, ended })
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
        Some(Ok(kept)) => {
            let reading = |(name, unit, value): &(String, String, f64)| {
                let value = Some(*value).filter(|value| value.is_finite());
                let unit = unit.clone();
                (name.clone(), Reading { value, unit, uncertainty: None, method: String::new(), not_at_rest: None })
            };
            RunState::Complete(Box::new(RunReport {
                steps: kept.steps,
                measures: kept.measures.iter().map(reading).collect(),
                wall_time_s: Total { total: kept.seconds },
                solver: Unknowns { unknowns: kept.pores, wall_time_s: None },
                ..report(Status::Done, None)
            }))
        }
    };
    RunResult { run: sample.run.clone(), state }
}
