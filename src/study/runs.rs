//! The runs of a study: every value of an axis with every value of the others, each with a name that tells them, and
//! each with its case checked.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use toml::Value;

use super::base_case;
use super::comparison::{self, DirectRun, NetworkRun, PlannedNetwork};
use super::definition::{Assignment, Choice, Quantity, Study, Target};
use super::values::{number_of, same, shown};
use crate::case::Case;
use crate::case::Loaded;
use crate::input::{Document, InputError, Mistake, Problem};
use crate::io::checksum::fnv1a;

/// Longest name of a run; file systems take 255 bytes, and files in the folder are named too.
const LONGEST_NAME: usize = 120;

/// Most mistakes that are told.
const MOST_MISTAKES: usize = 50;

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
    /// Where the base case is named: a key path in the study file.
    pub case_origin: String,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// What differs from the base case.
    pub assignments: Vec<Assignment>,
    /// What it is compared with, where it is.
    pub network: Option<NetworkRun>,
}

/// A run with its checked case.
#[derive(Debug, Clone)]
pub struct PlannedRun {
    /// The run.
    pub run: Run,
    /// The case.
    pub case: Case,
    /// The case file with all that was filled in; with that of the network where it is compared with one.
    pub resolved: String,
    /// The text of the case file.
    pub document: Document,
    /// What it is compared with, where it is.
    pub network: Option<PlannedNetwork>,
}

impl PlannedRun {
    /// Tells whether a run is of this case: the hash of the resolved case.
    pub fn digest(&self) -> String {
        format!("{:016x}", fnv1a(self.resolved.as_bytes()))
    }
}

impl Run {
    /// The value of a parameter.
    pub(crate) fn value(&self, name: &str) -> Option<&Value> {
        self.parameters.iter().find(|parameter| parameter.name == name).map(|parameter| &parameter.value)
    }

    /// The number that a quantity is in this run.
    pub(crate) fn quantity(&self, quantity: &Quantity) -> Option<f64> {
        match quantity {
            Quantity::Number(number) => Some(*number),
            Quantity::Parameter(name) => self.value(name).and_then(number_of),
        }
    }

    /// Whether the run is among those chosen.
    pub(crate) fn is_in(&self, choice: &Choice) -> bool {
        choice.0.iter().all(|(name, value)| self.value(name).is_some_and(|found| same(found, value)))
    }

    /// What differs from the base case, as `--set` takes it.
    pub(crate) fn overrides(&self) -> Vec<String> {
        base_case::overrides(&self.assignments)
    }

    /// Loads the case of the run and holds it against its geometry.
    ///
    /// # Errors
    /// All mistakes; those of a value of the study at its place in the study file.
    pub fn plan(&self, study: &Study) -> Result<PlannedRun, InputError> {
        self.load(study).map_err(|error| self.placed(study, error))
    }

    fn load(&self, study: &Study) -> Result<PlannedRun, InputError> {
        let (loaded, network) = match &self.network {
            Some(network) => {
                let direct = DirectRun { case: &self.case, origin: &self.case_origin, assignments: &self.assignments };
                let (direct, network) = comparison::plan(study, &direct, network)?;
                (direct, Some(network))
            }
            None => (base_case::load(&self.case, &self.assignments)?, None),
        };
        let Loaded { case, resolved, document, .. } = loaded;
        Ok(PlannedRun { run: self.clone(), case, resolved, document, network })
    }

    /// Moves the mistakes of values that the study sets to their places in the study file.
    fn placed(&self, study: &Study, error: InputError) -> InputError {
        let mut mistakes = Vec::new();
        let of_network = self.network.iter();
        let assignments = || self.assignments.iter().chain(of_network.clone().flat_map(|network| &network.assignments));
        let cases = || {
            let network = of_network.clone().map(|network| (&network.case, comparison::NETWORK_KEY));
            std::iter::once((&self.case, self.case_origin.as_str())).chain(network)
        };
        for mistake in error.mistakes {
            let set_here = assignments().find(|one| mistake.name == format!("--set {}", one.text));
            let is_missing = |case: &Path| mistake.place.is_none() && mistake.name == case.display().to_string();
            let missing_case = cases().find(|(case, _)| is_missing(case));
            let problem = match set_here {
                Some(one) => {
                    let message = format!("{} (in `{}`)", mistake.message, one.text);
                    Some(Problem::new(&one.origin, message, mistake.help_text()))
                }
                None => missing_case.map(|(_, origin)| Problem::new(origin, &mistake.message, mistake.help_text())),
            };
            let moved = problem.and_then(|problem| study.refuse(vec![problem]).err());
            match moved {
                Some(error) => mistakes.extend(error.mistakes),
                None => mistakes.push(mistake),
            }
        }
        InputError { mistakes }
    }
}

/// All runs of a study; the last axis varies fastest.
pub fn runs(study: &Study) -> Vec<Run> {
    let count: usize = study.axes.iter().map(|axis| axis.len()).product();
    let mut names = BTreeSet::new();
    (0..count).map(|number| run(study, number, &mut names)).collect()
}

fn run(study: &Study, number: usize, names: &mut BTreeSet<String>) -> Run {
    let (mut case, mut case_origin) = (study.case.clone().unwrap_or_default(), "case".to_owned());
    let mut parameters = Vec::new();
    let mut assignments = study.set.clone();
    let mut labels = Vec::new();
    let mut rest = number;
    let mut places = vec![0; study.axes.len()];
    for (place, axis) in places.iter_mut().zip(&study.axes).rev() {
        *place = rest % axis.len().max(1);
        rest /= axis.len().max(1);
    }
    for (&place, axis) in places.iter().zip(&study.axes) {
        for (number, column) in axis.columns.iter().enumerate() {
            let Some(value) = column.values.get(place) else { continue };
            match &column.target {
                Target::Keys(keys) => {
                    let origin = column.origins.get(place).cloned().unwrap_or_default();
                    let set = |key: &String| Assignment { text: format!("{key}={value}"), origin: origin.clone() };
                    assignments.extend(keys.iter().map(set));
                }
                Target::Case(files) => {
                    case = files.get(place).cloned().unwrap_or_default();
                    case_origin = column.origins.get(place).cloned().unwrap_or_default();
                }
                Target::Nothing => {}
            }
            if number == 0 {
                labels.push(format!("{}={}", column.name, label(value)));
            }
            parameters.push(Parameter { name: column.name.clone(), value: value.clone() });
        }
    }
    let name = free_name(if labels.is_empty() { "only".to_owned() } else { labels.join("_") }, names);
    let network = study.compare.as_ref().map(|plan| comparison::split(plan, &mut assignments));
    Run { index: number + 1, name, case, case_origin, parameters, assignments, network }
}

/// A value as part of the name of a folder: of a path its last part, of an array its numbers.
fn label(value: &Value) -> String {
    let text = shown(value);
    let text = if value.is_str() { text.rsplit(['/', '\\']).next().unwrap_or_default() } else { text.as_str() };
    let kept = text.chars().filter(|c| !"[]{} \"".contains(*c));
    kept.map(|c| if c.is_ascii_alphanumeric() || "+-.,".contains(c) { c } else { '-' }).collect()
}

/// The name, cut where it is too long, with a number where it is taken.
fn free_name(name: String, taken: &mut BTreeSet<String>) -> String {
    let name = if name.len() > LONGEST_NAME {
        format!("{}-{:016x}", &name[..LONGEST_NAME], fnv1a(name.as_bytes()))
    } else {
        name
    };
    let mut candidate = name.clone();
    let mut number = 1;
    // File systems that do not tell capitals apart must not join two runs.
    while !taken.insert(candidate.to_lowercase()) {
        number += 1;
        candidate = format!("{name}-{number}");
    }
    candidate
}

/// All runs with their cases checked.
///
/// # Errors
/// All mistakes of all cases, each told once; then measures that the runs do not have.
pub fn plan(study: &Study) -> Result<Vec<PlannedRun>, InputError> {
    let (mut planned, mut mistakes) = (Vec::new(), Vec::<Mistake>::new());
    for run in runs(study) {
        match run.plan(study) {
            Ok(run) => planned.push(run),
            Err(error) => {
                for mistake in error.mistakes {
                    let told = mistakes.iter().any(|other: &Mistake| {
                        (&other.name, other.place, &other.message) == (&mistake.name, mistake.place, &mistake.message)
                    });
                    if !told && mistakes.len() < MOST_MISTAKES {
                        mistakes.push(mistake);
                    }
                }
            }
        }
    }
    if !mistakes.is_empty() {
        return Err(InputError { mistakes });
    }
    study.refuse(super::measured::problems(study, &planned))?;
    Ok(planned)
}
