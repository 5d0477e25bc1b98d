//! Runs of networks within this process, many of which share a network: no output folder; selected results are kept of each.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::schedule::Schedule;
use super::setup::SetupError;
use crate::case::network::PoreNetwork;
use crate::case::{Case, Model};
use crate::io::picture::region_map_picture;
use crate::io::vtk::{self, Compression};
use crate::io::{FileError, atomic, table};
use crate::network::ensemble::{Reference, Sample};
use crate::network::setup;

pub(crate) use crate::network::ensemble::SATURATIONS;
pub(crate) use crate::network::measures::Costly;

/// The network of a case; `None` if it has another model.
fn network(case: &Case) -> Option<&PoreNetwork> {
    match &case.model {
        Model::Network(network) => Some(network),
        _ => None,
    }
}

/// Whether the model of a case is a network.
pub(crate) fn is_of_network(case: &Case) -> bool {
    network(case).is_some()
}

/// What a network depends on besides its shapes: cases of the same shapes with the same text share it.
pub(crate) fn shared_by(case: &Case) -> String {
    network(case).map_or(String::new(), |network| format!("{:?} {:?}", network.sides, network.persistence))
}

/// An extracted network before any displacement.
pub(crate) struct Ground(setup::Ground);

/// The partition of the pore space of a network, on which maps are drawn.
pub(crate) struct Map(Reference);

/// The results kept of a run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Outcome {
    /// Name, unit and value of each measure.
    pub(crate) measures: Vec<(String, String, f64)>,
    /// For each half cycle the capillary pressure in Pa at [`SATURATIONS`] equidistant saturations of the wetting phase from 0 to 1.
    pub(crate) curves: Vec<Vec<f64>>,
    /// Which parts of the map the invading phase had filled at breakthrough, or at the end of the first half cycle.
    pub(crate) invaded: Vec<bool>,
    /// Number of events or steps.
    pub(crate) steps: u64,
    /// Number of pores.
    pub(crate) pores: usize,
}

/// The error of a case without a network.
const NO_NETWORK: &str = "the case has no network";

impl Ground {
    /// The network of a case, and the map of it.
    ///
    /// # Errors
    /// What is wrong, as text.
    pub(crate) fn of(case: &Case) -> Result<Self, String> {
        let network = network(case).ok_or(NO_NETWORK)?;
        setup::Ground::of(case, network)
            .map(|ground| Self(ground.shared()))
            .map_err(|error| SetupError::from(error).to_string())
    }

    /// The parts of the pore space as a case divides it.
    ///
    /// # Errors
    /// What is wrong, as text.
    pub(crate) fn map(&self, case: &Case) -> Result<Map, String> {
        Ok(Map(self.sample(case)?.reference()))
    }

    fn sample(&self, case: &Case) -> Result<Sample, String> {
        let network = network(case).ok_or(NO_NETWORK)?;
        Sample::on(&self.0, case, network).map_err(|error| error.to_string())
    }

    /// Runs a case on this network, without the costly measures that are left out; `None` if it was interrupted.
    ///
    /// # Errors
    /// What is wrong, as text.
    pub(crate) fn run(
        &self,
        case: &Case,
        map: &Map,
        costly: Costly,
        interrupt: &AtomicBool,
    ) -> Result<Option<Outcome>, String> {
        let schedule = Schedule::new(&case.output, case.end);
        let stop = |time: f64| schedule.next_after(time).map(|stop| (stop.time, stop.due.series));
        let sample = self.sample(case)?;
        let observed = sample.observed(&map.0, costly, &stop, interrupt).map_err(|error| error.to_string())?;
        Ok(observed.map(|observed| Outcome {
            measures: observed.measures.into_iter().map(|one| (one.name, one.unit, one.value)).collect(),
            curves: observed.curves,
            invaded: observed.invaded,
            steps: observed.steps,
            pores: observed.pores,
        }))
    }
}

impl Map {
    /// The moment that the map shows.
    pub(crate) fn moment(&self) -> &'static str {
        self.0.moment()
    }

    /// Number of its parts.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// Names of the half cycles of a quasi-static displacement.
    pub(crate) fn processes(&self) -> &[&'static str] {
        self.0.processes()
    }

    /// Writes the probability with which each part is invaded as `invasion.csv`, `invasion.vtu` and `invasion.png`, their names followed by `suffix`.
    ///
    /// # Errors
    /// [`FileError`] with the path and a remedy.
    pub(crate) fn write(
        &self,
        folder: &Path,
        suffix: &str,
        probability: &[f64],
        (title, note): (&str, String),
    ) -> Result<(), FileError> {
        let path = |ending: &str| folder.join(format!("invasion{suffix}.{ending}"));
        table::write_at(&path("csv"), &self.0.table(probability))?;
        let failed = |ending: &str, what: String| FileError::Format { path: path(ending), what };
        let layer = vtk::layer(&self.0.layer(probability), Compression::default());
        atomic::write(&path("vtu"), &layer.map_err(|error| failed("vtu", error.to_string()))?)?;
        let picture = region_map_picture(&self.0.region_map(probability, note), title);
        atomic::write(&path("png"), &picture.map_err(|error| failed("png", error.to_string()))?)
    }
}
