//! The runs of a study: every value of an axis combined with every value of the others, each with a descriptive name and its checked case.

use std::collections::BTreeSet;

use toml::Value;

use super::definition::{Assignment, Study, Target};
use super::run::{Parameter, PlannedRun, Run, SAMPLE_MISTAKE};
use super::values::shown;
use super::{comparison, measured};
use meniscus_core::input::{InputError, Mistake};
use meniscus_output::checksum::fnv1a;

/// Longest name of a run; file systems allow 255 bytes, and files in the folder have names, too.
const LONGEST_NAME: usize = 120;

/// Most mistakes that are reported.
const MOST_MISTAKES: usize = 50;

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
    let mut indices = vec![0; study.axes.len()];
    for (index, axis) in indices.iter_mut().zip(&study.axes).rev() {
        *index = rest % axis.len().max(1);
        rest /= axis.len().max(1);
    }
    for (&index, axis) in indices.iter().zip(&study.axes) {
        for (number, column) in axis.columns.iter().enumerate() {
            let Some(value) = column.values.get(index) else { continue };
            match &column.target {
                Target::Keys(keys) => {
                    let origin = column.origins.get(index).cloned().unwrap_or_default();
                    let set = |key: &String| Assignment { text: format!("{key}={value}"), origin: origin.clone() };
                    assignments.extend(keys.iter().map(set));
                }
                Target::Case(files) => {
                    case = files.get(index).cloned().unwrap_or_default();
                    case_origin = column.origins.get(index).cloned().unwrap_or_default();
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

/// A value as part of the name of a folder: the last part of a path, the numbers of an array.
fn label(value: &Value) -> String {
    let text = shown(value);
    let text = if value.is_str() { text.rsplit(['/', '\\']).next().unwrap_or_default() } else { text.as_str() };
    let kept = text.chars().filter(|c| !"[]{} \"".contains(*c));
    kept.map(|c| if c.is_ascii_alphanumeric() || "+-.,".contains(c) { c } else { '-' }).collect()
}

/// The name, truncated if it is too long, with a number if it is taken.
fn free_name(name: String, taken: &mut BTreeSet<String>) -> String {
    let name = if name.len() > LONGEST_NAME {
        format!("{}-{:016x}", &name[..LONGEST_NAME], fnv1a(name.as_bytes()))
    } else {
        name
    };
    let mut candidate = name.clone();
    let mut number = 1;
    // Runs must stay distinct on case-insensitive file systems.
    while !taken.insert(candidate.to_lowercase()) {
        number += 1;
        candidate = format!("{name}-{number}");
    }
    candidate
}

/// The mistakes of the cases of many runs, each reported once.
#[derive(Default)]
pub(super) struct Mistakes {
    found: Vec<Mistake>,
    /// Number of further samples with the same mistake, at the location of a distribution.
    more: Vec<usize>,
}

impl Mistakes {
    /// Adds those of a run.
    pub(super) fn add(&mut self, error: InputError) {
        for mistake in error.mistakes {
            // Samples of a distribution differ in their values, and so in their messages.
            let is_sample = mistake.message.starts_with(SAMPLE_MISTAKE);
            let same = self.found.iter().position(|other| {
                (&other.name, other.location) == (&mistake.name, mistake.location)
                    && (other.message == mistake.message || is_sample && other.message.starts_with(SAMPLE_MISTAKE))
            });
            match same {
                Some(same) => self.more[same] += usize::from(is_sample),
                None if self.found.len() < MOST_MISTAKES => {
                    self.found.push(mistake);
                    self.more.push(0);
                }
                None => {}
            }
        }
    }

    /// # Errors
    /// The mistakes, if there are any.
    pub(super) fn finish(self) -> Result<(), InputError> {
        let merged = |(mut mistake, more): (Mistake, usize)| {
            if more > 0 {
                mistake.message += &format!("; {more} more samples are refused here");
            }
            mistake
        };
        let mistakes: Vec<Mistake> = self.found.into_iter().zip(self.more).map(merged).collect();
        if mistakes.is_empty() { Ok(()) } else { Err(InputError { mistakes }) }
    }
}

/// All runs with their cases checked.
///
/// # Errors
/// All mistakes of all cases, each reported once; then measures that the runs do not have.
pub fn plan(study: &Study) -> Result<Vec<PlannedRun>, InputError> {
    let (mut planned, mut mistakes) = (Vec::new(), Mistakes::default());
    for run in runs(study) {
        match run.plan(study) {
            Ok(run) => planned.push(run),
            Err(error) => mistakes.add(error),
        }
    }
    mistakes.finish()?;
    study.refuse(measured::problems(study, &planned))?;
    Ok(planned)
}
