//! The samples of networks with their checked cases; samples with equal shapes share a network.

use std::sync::LazyLock;

use crate::run::ensemble::{Costly, Ground, is_of_network, shared_by};
use crate::study::definition::{Sampling, Study};
use crate::study::measured;
use crate::study::run::Run;
use crate::study::runs::{Mistakes, runs};
use meniscus_case::{Case, KeptGeometry, Loaded};
use meniscus_core::input::InputError;
use meniscus_core::math;
use meniscus_output::checksum::fnv1a;

/// A network, extracted on first use.
type SharedGround = LazyLock<Result<Ground, String>, Box<dyn FnOnce() -> Result<Ground, String> + Send + Sync>>;

/// A sample.
pub(crate) struct PlannedSample {
    /// Its run.
    pub(crate) run: Run,
    /// Identifies the case and the map of a result.
    pub(crate) digest: u64,
    /// Index of the values of all other axes.
    pub(crate) group: usize,
    /// The case without its shapes, and the index of its network; `None` if shapes are uncertain, too, and each case is read when it is run.
    known: Option<(Case, usize)>,
}

/// All samples that have the same values along the other axes.
pub(crate) struct Group {
    /// These values as text; empty if there are no other axes.
    pub(crate) name: String,
    /// Index of the first sample, whose pore space defines the map.
    pub(crate) first: usize,
}

/// Samples of networks.
pub(crate) struct Ensemble {
    /// The samples in the order of the runs.
    pub(crate) samples: Vec<PlannedSample>,
    /// Their groups.
    pub(crate) groups: Vec<Group>,
    /// Which of the measures that take long the study names.
    pub(crate) costly: Costly,
    /// The networks shared by samples, each with what determines it: a digest of its shapes, and everything else.
    grounds: Vec<((u64, String), SharedGround)>,
    /// The geometry last read.
    kept: KeptGeometry,
}

/// The samples of a study that runs within this process: one of networks with uncertain values. `None` if runs are processes.
///
/// # Errors
/// All mistakes of the cases of all samples.
pub(crate) fn plan(study: &Study) -> Result<Option<Ensemble>, InputError> {
    let Some(sampling) = study.sampling.as_ref().filter(|it| !it.processes && study.compare.is_none()) else {
        return Ok(None);
    };
    let shapes_vary = shapes_vary(sampling);
    // A report without a list shows all measures.
    let names = study.report.measures.is_some().then(|| measured::names(study).collect::<Vec<_>>());
    let mut ensemble = Ensemble {
        samples: Vec::new(),
        groups: Vec::new(),
        costly: names.map_or(Costly::ALL, |names| Costly::wanted(|name| names.contains(&name))),
        grounds: Vec::new(),
        kept: KeptGeometry::default(),
    };
    let mut mistakes = Mistakes::default();
    for run in runs(study) {
        match run.case(study, &ensemble.kept) {
            Ok(loaded) if is_of_network(&loaded.case) => ensemble.add(study, run, loaded, shapes_vary),
            Ok(_) => return Ok(None),
            Err(error) => mistakes.add(error),
        }
    }
    mistakes.finish()?;
    let of_groups = ensemble.groups.iter().map(|group| ensemble.samples[group.first].run.plan(study));
    study.refuse(measured::problems(study, &of_groups.collect::<Result<Vec<_>, _>>()?))?;
    Ok(Some(ensemble))
}

/// Whether a key of the shapes is uncertain.
fn shapes_vary(sampling: &Sampling) -> bool {
    let is_of_shapes = |key: &String| key.starts_with("geometry.") && key != "geometry.depth";
    sampling.inputs.iter().any(|input| input.keys.iter().any(is_of_shapes))
}

impl Ensemble {
    /// Adds a sample with its case.
    fn add(&mut self, study: &Study, run: Run, loaded: Loaded, shapes_vary: bool) {
        let Loaded { mut case, resolved, .. } = loaded;
        let shapes = case.geometry.digest();
        let ground = (!shapes_vary).then(|| self.ground(&case, shapes));
        case.geometry.shapes = Vec::new();
        let group = self.group(run.name_of_group(study));
        let own = math::fnv1a(shapes, resolved.bytes()).to_le_bytes();
        let own = fnv1a(
            &[
                &own[..],
                &[
                    self.costly.permeabilities.into(),
                    self.costly.entry_pressures.into(),
                    self.costly.other_films.into(),
                ],
            ]
            .concat(),
        );
        // A result depends on the map, too, which is that of the first sample.
        let digest = match self.samples.get(self.groups[group].first) {
            Some(first) => fnv1a(&[own.to_le_bytes(), first.digest.to_le_bytes()].concat()),
            None => own,
        };
        self.samples.push(PlannedSample { run, digest, group, known: ground.map(|ground| (case, ground)) });
    }

    /// The index of the group with a name, which begins with the next sample if it is new.
    fn group(&mut self, name: String) -> usize {
        self.groups.iter().position(|group| group.name == name).unwrap_or_else(|| {
            self.groups.push(Group { name, first: self.samples.len() });
            self.groups.len() - 1
        })
    }

    /// The index of the network of a case, whose shapes have this digest.
    fn ground(&mut self, case: &Case, shapes: u64) -> usize {
        let key = (shapes, shared_by(case));
        self.grounds.iter().position(|(other, _)| *other == key).unwrap_or_else(|| {
            let case = case.clone();
            self.grounds.push((key, LazyLock::new(Box::new(move || Ground::of(&case)))));
            self.grounds.len() - 1
        })
    }

    /// Applies a function to the case of a sample and its network.
    ///
    /// # Errors
    /// Those of the function, why there is no such network, or the mistakes of a case that has changed since the check, as text.
    pub(crate) fn with<T>(
        &self,
        study: &Study,
        index: usize,
        act: impl FnOnce(&Case, &Ground) -> Result<T, String>,
    ) -> Result<T, String> {
        let sample = &self.samples[index];
        if let Some((case, ground)) = &sample.known {
            return act(case, self.grounds[*ground].1.as_ref().map_err(Clone::clone)?);
        }
        let case = sample.run.case(study, &self.kept).map_err(|error| error.render())?.case;
        act(&case, &Ground::of(&case)?)
    }
}
