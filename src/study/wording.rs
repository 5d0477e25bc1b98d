//! Words and units of the parameters and measures of a study, for its diagrams and tables.

use std::collections::BTreeMap;

use super::axis::last_part;
use super::definition::{Column, Study, Target};
use super::results::{RunResult, measures};
use super::run::Run;
use super::values::{number_of, shown};
use meniscus_case::unit_of_key;
use meniscus_core::label::Label;
use toml::Value;

/// The labels of all names of a study.
#[derive(Debug, Clone, Default)]
pub(crate) struct Wording {
    parameters: BTreeMap<String, Label>,
    /// Units of measures.
    units: BTreeMap<String, String>,
}

impl Wording {
    /// The words of a study, with units as far as its runs tell them.
    pub(crate) fn of(study: &Study, results: &[RunResult]) -> Self {
        let units = measures(results);
        let measured: Vec<String> = units.keys().map(|name| Label::of(name, None).words).collect();
        let depth = has_depth(results);
        let parameters = study.parameters().map(|column| (column.name.clone(), label(column, depth, &measured)));
        Self { parameters: parameters.collect(), units }
    }

    /// The words and the unit of a parameter, a measure or a number of a run.
    pub(crate) fn label(&self, name: &str) -> Label {
        let measure = || Label::of(name, self.units.get(name).map(String::as_str));
        self.parameters.get(name).cloned().unwrap_or_else(measure)
    }

    /// A parameter with its value: `contact angle = 60 degrees`.
    pub(crate) fn value(&self, name: &str, value: &Value) -> String {
        let label = self.label(name);
        let text = shown(value);
        let text = if number_of(value).is_some() { label.valued(&text) } else { text };
        format!("{} = {text}", label.words)
    }

    /// The labels of some names, one after the other.
    pub(crate) fn labels(&self, names: &[String]) -> String {
        names.iter().map(|name| self.label(name).to_string()).collect::<Vec<_>>().join(", ")
    }

    /// Some parameters of a run with their values.
    pub(crate) fn values(&self, run: &Run, is_shown: impl Fn(&str) -> bool) -> String {
        let parameters = run.parameters.iter().filter(|one| is_shown(&one.name));
        parameters.map(|one| self.value(&one.name, &one.value)).collect::<Vec<_>>().join(", ")
    }
}

/// The words of the key that a parameter sets where its name is a part of them and no measure has the same; else those of its name.
fn label(column: &Column, depth: Option<bool>, measured: &[String]) -> Label {
    let name = Label::of(&column.name, None);
    let Target::Keys(keys) = &column.target else { return name };
    let Some(key) = keys.first() else { return name };
    let unit = unit_of_key(key, depth);
    let of_key = Label::of(&last_part(key), unit);
    let says_more = of_key.words.contains(&name.words) && !measured.contains(&of_key.words);
    if says_more { of_key } else { of_key.in_words(name.words) }
}

/// Whether the chips of the complete runs have a depth, if their cases tell.
fn has_depth(results: &[RunResult]) -> Option<bool> {
    let case = &results.iter().find_map(|result| result.state.report())?.resolved_case;
    let case: toml::Table = case.parse().ok()?;
    Some(case.get("geometry")?.get("depth").is_some())
}

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, study};
    use super::*;

    #[test]
    fn parameters_have_the_words_and_units_of_their_keys_or_of_their_names() {
        let study = study(
            "[[axis]]\nname = 'angle'\nkey = 'network.wetting.young.contact-angle-deg'\nvalues = [30, 60]\n\
             [[axis]]\nname = 'wall-shift'\nkey = 'geometry.etch-offset'\nvalues = [1e-6]\n\
             [[axis]]\nkey = 'network.films'\nvalues = ['none']\n\
             [[axis]]\npair = [{ name = 'width-um', values = [1] }]\n",
        );
        let results = complete(&study, |_| 1.0);
        let wording = Wording::of(&study, &results);
        let labels =
            ["angle", "wall-shift", "films", "width-um", "m", "wall-time-s"].map(|n| wording.label(n).to_string());
        assert_eq!(
            labels,
            ["contact angle (degrees)", "wall shift (m)", "films", "width (µm)", "m (degrees)", "wall time (s)"]
        );
        assert_eq!(wording.labels(&["films", "angle"].map(str::to_owned)), "films, contact angle (degrees)");
        let values = wording.values(&results[0].run, |name| name != "width-um");
        assert_eq!(values, "contact angle = 30 degrees, wall shift = 1e-6 m, films = none");
    }

    #[test]
    fn a_parameter_is_not_called_as_a_measure_is() {
        let study = study("[[axis]]\nname = 'angle'\nkey = 'sph.wetting.young.contact-angle-deg'\nvalues = [30]\n");
        let mut results = complete(&study, |_| 1.0);
        let super::super::results::RunState::Complete(report) = &mut results[0].state else { panic!("complete") };
        report.measures.insert("contact-angle-deg".into(), report.measures["m"].clone());
        let labels = ["angle", "contact-angle-deg"].map(|name| Wording::of(&study, &results).label(name).to_string());
        assert_eq!(labels, ["angle (degrees)", "contact angle (degrees)"]);
    }
}
