//! Runs that compare their case, a direct simulation, with a network of the same geometry: the assignment of the values of a run to the two cases, and their
//! consistency.

use std::path::{Path, PathBuf};

use super::base_case::load;
use super::definition::{Assignment, ComparisonPlan, Study};
use crate::run::compare::{self, CompareError, Of, Pair};
use meniscus_case::{Case, Loaded};
use meniscus_core::input::{Document, InputError, Problem};

/// The table that only the case of a network has.
const OF_NETWORK: &str = "network";
/// The table common to both cases.
const OF_BOTH: &str = "geometry";
/// The key that names the case of the network.
pub(super) const NETWORK_KEY: &str = "compare.network";

/// The network that the case of a run is compared with.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkRun {
    /// Its base case.
    pub case: PathBuf,
    /// The differences from it.
    pub assignments: Vec<Assignment>,
    /// Number of compared states of the direct simulation.
    pub records: usize,
}

/// The network of a run with its checked case.
#[derive(Debug, Clone)]
pub struct PlannedNetwork {
    /// The case.
    pub case: Case,
    /// The text of its file.
    pub document: Document,
    /// Number of compared states of the direct simulation.
    pub records: usize,
    /// The case file of the direct simulation with all defaults filled in.
    pub of_direct: String,
}

impl PlannedNetwork {
    /// This network and the direct simulation of a case.
    pub(super) fn with<'a>(&'a self, direct: &'a Case) -> Pair<'a> {
        Pair { network: &self.case, direct, records: self.records }
    }
}

/// Distributes the values of a run to the cases that have their keys: those of `[network]` to the network, those of `[geometry]` to both, all others to the
/// direct simulation, for which they remain in `assignments`.
pub(super) fn split(plan: &ComparisonPlan, assignments: &mut Vec<Assignment>) -> NetworkRun {
    let is_in = |one: &Assignment, table: &str| one.text.split(['.', '[', '=']).next().map(str::trim) == Some(table);
    let of_network = assignments.iter().filter(|one| is_in(one, OF_NETWORK) || is_in(one, OF_BOTH)).cloned().collect();
    assignments.retain(|one| !is_in(one, OF_NETWORK));
    NetworkRun { case: plan.network.clone(), assignments: of_network, records: plan.records }
}

/// Loads both cases and compares their geometry and sides. The resolved text is that of both, which identifies a comparison.
///
/// # Errors
/// All mistakes of both, or why they cannot be compared.
pub(super) fn plan(
    study: &Study,
    case: &Path,
    origin: &str,
    assignments: &[Assignment],
    network: &NetworkRun,
) -> Result<(Loaded, PlannedNetwork), InputError> {
    let (mut direct, other) = both(load(case, assignments, None), load(&network.case, &network.assignments, None))?;
    let records = network.records;
    let of_direct = direct.resolved;
    direct.resolved = format!("# direct simulation, {records} records\n{of_direct}\n# network\n{}", other.resolved);
    let other = PlannedNetwork { case: other.case, document: other.document, records, of_direct };
    if let Err(error) = compare::check(&other.with(&direct.case)) {
        // The study determines which two cases are compared, not one of them.
        let here = match &error {
            CompareError::NoNetwork => Some((NETWORK_KEY, error.to_string())),
            CompareError::OtherGeometry(_) => Some((NETWORK_KEY, format!("{error}: that of {}", case.display()))),
            CompareError::NoDirect => Some((origin, error.to_string())),
            _ => None,
        };
        match here {
            Some((key, text)) => study.refuse(vec![Problem::of_text(key, &text)])?,
            None => refuse(&error, &other.document, &direct.document)?,
        }
    }
    Ok((direct, other))
}

/// Two cases, or the mistakes of both.
fn both<T>(one: Result<T, InputError>, other: Result<T, InputError>) -> Result<(T, T), InputError> {
    match (one, other) {
        (Ok(one), Ok(other)) => Ok((one, other)),
        (one, other) => {
            let mistakes = [one.err(), other.err()].into_iter().flatten().flat_map(|error| error.mistakes);
            Err(InputError { mistakes: mistakes.collect() })
        }
    }
}

/// Locates what is wrong with two cases in one of them.
///
/// # Errors
/// [`InputError`] if something is wrong with a case.
pub(super) fn refuse(error: &CompareError, network: &Document, direct: &Document) -> Result<(), InputError> {
    match error.problems() {
        Some((Of::Network, problems)) => network.refuse(problems),
        Some((Of::Direct, problems)) => direct.refuse(problems),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_go_to_the_case_that_has_their_keys() {
        let plan = ComparisonPlan { network: "network.toml".into(), records: 10 };
        let one = |text: &str| Assignment { text: text.to_owned(), origin: "set[0]".to_owned() };
        let texts = |all: &[Assignment]| all.iter().map(|one| one.text.clone()).collect::<Vec<_>>();
        let mut direct =
            ["sph.spacing=1e-5", "network.inlet=\"left\"", "geometry={file=\"a.toml\"}", "time.end=1", "networks.a=1"]
                .map(one)
                .to_vec();
        let network = split(&plan, &mut direct);
        assert_eq!(texts(&network.assignments), ["network.inlet=\"left\"", "geometry={file=\"a.toml\"}"]);
        assert_eq!(texts(&direct), ["sph.spacing=1e-5", "geometry={file=\"a.toml\"}", "time.end=1", "networks.a=1"]);
    }
}
