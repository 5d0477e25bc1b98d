//! A run of a study with its parameters, and its loaded and checked case.

use std::path::{Path, PathBuf};

use toml::Value;

use super::base_case;
use super::comparison::{self, NetworkRun, PlannedNetwork};
use super::definition::{Assignment, Choice, Quantity, Study};
use super::values::{number_of, same, shown};
use meniscus_case::{Case, KeptGeometry, Loaded};
use meniscus_core::input::{Document, InputError, Mistake, Problem};
use meniscus_output::checksum::fnv1a;

/// Prefix of the message of a mistake in a sampled value.
pub(super) const SAMPLE_MISTAKE: &str = "a sample is refused: ";

/// Suffix of the key path of such a value.
const OF_DISTRIBUTION: &str = ".distribution";

/// The remedy.
const IN_RANGE: &str =
    "truncate a normal distribution by `at-least` and `at-most`, or take one that ends within the range";

/// A parameter with its value in a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name.
    pub name: String,
    /// Value.
    pub value: Value,
}

/// A run of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Number from 1, in the order of the axes.
    pub index: usize,
    /// Name of its folder.
    pub name: String,
    /// The base case.
    pub case: PathBuf,
    /// Where the base case is given: a key path in the study file.
    pub case_origin: String,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// The differences from the base case.
    pub assignments: Vec<Assignment>,
    /// The network that it is compared with, if any.
    pub network: Option<NetworkRun>,
}

/// A run with its checked case.
#[derive(Debug, Clone)]
pub struct PlannedRun {
    /// The run.
    pub run: Run,
    /// The case.
    pub case: Case,
    /// The case file with all defaults filled in; with that of the network if it is compared with one.
    pub resolved: String,
    /// The text of the case file.
    pub document: Document,
    /// The network that it is compared with, if any.
    pub network: Option<PlannedNetwork>,
}

impl PlannedRun {
    /// Identifies the case of a run: the hash of the resolved case.
    pub fn digest(&self) -> String {
        format!("{:016x}", fnv1a(self.resolved.as_bytes()))
    }
}

impl Run {
    /// The value of a parameter.
    pub(crate) fn value(&self, name: &str) -> Option<&Value> {
        self.parameters.iter().find(|parameter| parameter.name == name).map(|parameter| &parameter.value)
    }

    /// The values of some parameters as text.
    pub(crate) fn values(&self, is_shown: impl Fn(&str) -> bool) -> String {
        let parameters = self.parameters.iter().filter(|one| is_shown(&one.name));
        parameters.map(|one| format!("{} = {}", one.name, shown(&one.value))).collect::<Vec<_>>().join(", ")
    }

    /// The values of some parameters alone, as text.
    pub(crate) fn plain_values(&self, names: &[String]) -> String {
        names.iter().filter_map(|name| self.value(name)).map(shown).collect::<Vec<_>>().join(", ")
    }

    /// The values along all axes except that of the samples, as text.
    pub(crate) fn name_of_group(&self, study: &Study) -> String {
        self.values(|name| study.sampling.as_ref().is_none_or(|sampling| !sampling.has(name)))
    }

    /// The value of a quantity in this run.
    pub(crate) fn quantity(&self, quantity: &Quantity) -> Option<f64> {
        match quantity {
            Quantity::Number(number) => Some(*number),
            Quantity::Parameter(name) => self.value(name).and_then(number_of),
        }
    }

    /// Whether the run is selected.
    pub(crate) fn is_in(&self, choice: &Choice) -> bool {
        choice.0.iter().all(|(name, value)| self.value(name).is_some_and(|found| same(found, value)))
    }

    /// The differences from the base case in the form of `--set`.
    pub(crate) fn overrides(&self) -> Vec<String> {
        base_case::overrides(&self.assignments)
    }

    /// Loads the case of the run and checks it against its geometry.
    ///
    /// # Errors
    /// All mistakes; those of a value of the study with its location in the study file.
    pub fn plan(&self, study: &Study) -> Result<PlannedRun, InputError> {
        self.load(study).map_err(|error| self.placed(study, error))
    }

    /// Loads the case of the run, one of a network, its resolved text without shapes; `kept` has the geometry of the previous run.
    ///
    /// # Errors
    /// As [`plan`](Self::plan).
    pub(crate) fn case(&self, study: &Study, kept: &KeptGeometry) -> Result<Loaded, InputError> {
        base_case::load(&self.case, &self.assignments, Some(kept)).map_err(|error| self.placed(study, error))
    }

    fn load(&self, study: &Study) -> Result<PlannedRun, InputError> {
        let (loaded, network) = match &self.network {
            Some(network) => {
                let (direct, network) =
                    comparison::plan(study, &self.case, &self.case_origin, &self.assignments, network)?;
                (direct, Some(network))
            }
            None => (base_case::load(&self.case, &self.assignments, None)?, None),
        };
        let Loaded { case, resolved, document, .. } = loaded;
        Ok(PlannedRun { run: self.clone(), case, resolved, document, network })
    }

    /// Relocates the mistakes of values set by the study to the study file.
    fn placed(&self, study: &Study, error: InputError) -> InputError {
        let placed = |mistake: Mistake| {
            let moved = self.problem(&mistake).and_then(|problem| study.refuse(vec![problem]).err());
            moved.map_or_else(|| vec![mistake], |error| error.mistakes)
        };
        InputError { mistakes: error.mistakes.into_iter().flat_map(placed).collect() }
    }

    /// A mistake as a problem of the study file, if that gives the value or the base case.
    fn problem(&self, mistake: &Mistake) -> Option<Problem> {
        let help = mistake.help_text();
        let of_network = self.network.iter().flat_map(|network| &network.assignments);
        let set_here =
            self.assignments.iter().chain(of_network).find(|one| mistake.name == format!("--set {}", one.text));
        if let Some(one) = set_here {
            let message = format!("{} (in `{}`)", mistake.message, one.text);
            if !one.origin.ends_with(OF_DISTRIBUTION) {
                return Some(Problem::new(&one.origin, message, help));
            }
            let help = if help.is_empty() { IN_RANGE.to_owned() } else { format!("{help}; {IN_RANGE}") };
            return Some(Problem::new(&one.origin, format!("{SAMPLE_MISTAKE}{message}"), help));
        }
        let network = self.network.iter().map(|network| (&network.case, comparison::NETWORK_KEY));
        let is_missing = |case: &Path| mistake.location.is_none() && mistake.name == case.display().to_string();
        let mut cases = std::iter::once((&self.case, self.case_origin.as_str())).chain(network);
        let (_, origin) = cases.find(|(case, _)| is_missing(case))?;
        Some(Problem::new(origin, &mistake.message, help))
    }
}
