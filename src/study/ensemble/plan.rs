//! The samples of networks with their checked cases; samples with equal shapes share a geometry.

use std::sync::Arc;

use crate::case::{Case, KeptGeometry, Loaded};
use crate::input::InputError;
use crate::io::checksum::fnv1a;
use crate::math;
use crate::run::ensemble::{Costly, is_of_network, shared_by};
use crate::study::definition::Study;
use crate::study::measured;
use crate::study::run::Run;
use crate::study::runs::{Mistakes, runs};
use crate::study::values::shown;

/// A sample.
pub(crate) struct PlannedSample {
    /// Its run.
    pub(crate) run: Run,
    /// Identifies the case and the map of a result.
    pub(crate) digest: u64,
    /// Index of the values of all other axes.
    pub(crate) group: usize,
    /// The case without its shapes, and the index of these; `None` if shapes are uncertain, too, and each case is read when it is run.
    pub(crate) known: Option<(Case, usize)>,
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
    /// A case for each geometry shared by samples.
    pub(crate) grounds: Vec<Case>,
    /// The geometry last read.
    pub(crate) kept: KeptGeometry,
    /// Which of the measures that take long the study names.
    pub(crate) costly: Costly,
}

/// The geometry of the cases, and everything else that determines a network.
type Key = (u64, String);

/// The samples of a study that runs within this process: one of networks with uncertain values. `None` if runs are processes.
///
/// # Errors
/// All mistakes of the cases of all samples.
pub(crate) fn plan(study: &Study) -> Result<Option<Ensemble>, InputError> {
    let Some(sampling) = study.sampling.as_ref().filter(|it| !it.processes && study.compare.is_none()) else {
        return Ok(None);
    };
    let is_of_shapes = |key: &String| key.starts_with("geometry.") && key != "geometry.depth";
    let shapes_vary = sampling.inputs.iter().any(|input| input.keys.iter().any(is_of_shapes));
    let kept = KeptGeometry::default();
    let mut mistakes = Mistakes::default();
    let names = measured::names(study);
    let costly = names.map_or(Costly::ALL, |names| Costly::wanted(|name| names.contains(&name)));
    let (samples, groups, grounds) = (Vec::new(), Vec::new(), Vec::new());
    let mut ensemble = Ensemble { samples, groups, grounds, kept: KeptGeometry::default(), costly };
    let mut keys: Vec<Key> = Vec::new();
    let mut representatives = Vec::new();
    for (index, run) in runs(study).into_iter().enumerate() {
        let Loaded { mut case, resolved, .. } = match run.case(study, &kept) {
            Ok(loaded) => loaded,
            Err(error) => {
                mistakes.add(error);
                continue;
            }
        };
        if !is_of_network(&case) {
            return Ok(None);
        }
        let name = name_of_group(study, &run);
        let group = ensemble.groups.iter().position(|group| group.name == name).unwrap_or_else(|| {
            ensemble.groups.push(Group { name, first: index });
            representatives.push(run.clone());
            ensemble.groups.len() - 1
        });
        let shapes = case.geometry.digest();
        let complete = (!shapes_vary).then(|| case.clone());
        case.geometry.shapes = Vec::new();
        let own = math::fnv1a(shapes, resolved.bytes()).to_le_bytes();
        let own = fnv1a(&[&own[..], &[costly.permeabilities.into(), costly.entry_pressures.into()]].concat());
        let known = complete.map(|complete| {
            let key = (shapes, shared_by(&complete));
            let ground = keys.iter().position(|other| *other == key).unwrap_or_else(|| {
                keys.push(key);
                ensemble.grounds.push(complete);
                keys.len() - 1
            });
            (case, ground)
        });
        let first =
            ensemble.samples.get(ensemble.groups[group].first).map_or(own, |first: &PlannedSample| first.digest);
        let digest = fnv1a(&[own.to_le_bytes(), first.to_le_bytes()].concat());
        // The digest of a first sample is the reference for others.
        let digest = if ensemble.groups[group].first == index { own } else { digest };
        ensemble.samples.push(PlannedSample { run, digest, group, known });
    }
    mistakes.finish()?;
    let planned = representatives.iter().map(|run| run.plan(study)).collect::<Result<Vec<_>, _>>()?;
    study.refuse(measured::problems(study, &planned))?;
    ensemble.kept = kept;
    Ok(Some(ensemble))
}

/// The values of a run along all axes except that of the samples, as text.
pub(crate) fn name_of_group(study: &Study, run: &Run) -> String {
    let is_other = |name: &str| study.sampling.as_ref().is_none_or(|sampling| !sampling.has(name));
    let others = run.parameters.iter().filter(|parameter| is_other(&parameter.name));
    others.map(|one| format!("{} = {}", one.name, shown(&one.value))).collect::<Vec<_>>().join(", ")
}

impl Ensemble {
    /// The case of a sample, with the index of its geometry if it is shared.
    ///
    /// # Errors
    /// The mistakes of a case that has changed since the check.
    pub(crate) fn case(&self, study: &Study, index: usize) -> Result<(Arc<Case>, Option<usize>), InputError> {
        let sample = &self.samples[index];
        match &sample.known {
            Some((case, ground)) => Ok((Arc::new(case.clone()), Some(*ground))),
            None => Ok((Arc::new(sample.run.case(study, &self.kept)?.case), None)),
        }
    }
}
