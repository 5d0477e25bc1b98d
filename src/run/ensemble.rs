//! Runs of networks within this process, many of which share a network: no output folder; selected results are kept of each.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::schedule::Schedule;
use super::setup::SetupError;
use meniscus_case::network::PoreNetwork;
use meniscus_case::{Case, Model};
use meniscus_network::ensemble::Sample;
use meniscus_network::setup;
use meniscus_output::picture::region_map_picture;
use meniscus_output::vtk::{self, Compression};
use meniscus_output::{FileError, atomic, table};

/// The partition of the pore space of a network, on which maps are drawn.
pub(crate) use meniscus_network::ensemble::Reference as Map;
pub(crate) use meniscus_network::ensemble::{Observed, SATURATIONS};
pub(crate) use meniscus_network::measures::Costly;

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
        Ok(self.sample(case)?.reference())
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
    ) -> Result<Option<Observed>, String> {
        let schedule = Schedule::new(&case.output, case.end);
        let stop = |time: f64| schedule.next_after(time).map(|stop| (stop.time, stop.due.series));
        let sample = self.sample(case)?;
        sample.observed(map, costly, &stop, interrupt).map_err(|error| error.to_string())
    }
}

/// Writes the probability with which each part of a map is invaded as `invasion.csv`, `invasion.vtu` and `invasion.png`, their names followed by `suffix`;
/// `note` is printed below the title of the picture.
///
/// # Errors
/// [`FileError`] with the path and a remedy.
pub(crate) fn write_map(
    map: &Map,
    probability: &[f64],
    folder: &Path,
    suffix: &str,
    title: &str,
    note: String,
) -> Result<(), FileError> {
    let path = |ending: &str| folder.join(format!("invasion{suffix}.{ending}"));
    table::write_at(&path("csv"), &map.table(probability))?;
    let failed = |ending: &str, what: String| FileError::Format { path: path(ending), what };
    let layer = vtk::layer(&map.layer(probability), Compression::default());
    atomic::write(&path("vtu"), &layer.map_err(|error| failed("vtu", error.to_string()))?)?;
    let picture = region_map_picture(&map.region_map(probability, note), title);
    let picture = picture.and_then(|picture| picture.png());
    atomic::write(&path("png"), &picture.map_err(|error| failed("png", error.to_string()))?)
}
