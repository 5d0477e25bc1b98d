//! The parameters that keep the runs of a diagram apart.

use std::collections::BTreeSet;

use super::results::RunResult;
use super::values::shown;

/// Runs in a diagram that shows some of their parameters by place.
pub(crate) struct Apart<'a> {
    /// Parameters along its axes.
    pub(crate) shown: &'a [&'a str],
    /// The runs.
    pub(crate) results: &'a [RunResult],
}

impl Apart<'_> {
    /// Number of runs with the same place and values as another one.
    fn shared(&self, names: &[String]) -> usize {
        let text = |result: &RunResult, name: &str| result.run.value(name).map(shown);
        let key = |result: &RunResult| {
            let place = self.shown.iter().map(|name| text(result, name));
            place.chain(names.iter().map(|name| text(result, name))).collect::<Vec<_>>()
        };
        let different: BTreeSet<_> = self.results.iter().map(key).collect();
        self.results.len() - different.len()
    }

    /// The parameters that separate runs at one place: those of `names` and others that are allowed and vary there.
    pub(crate) fn names(&self, mut names: Vec<String>, is_allowed: impl Fn(&str) -> bool) -> Vec<String> {
        let all: Vec<&String> = self.results.iter().take(1).flat_map(|r| &r.run.parameters).map(|p| &p.name).collect();
        for name in all.into_iter().filter(|name| !self.shown.contains(&name.as_str()) && is_allowed(name)) {
            let added = [&names[..], std::slice::from_ref(name)].concat();
            if !names.contains(name) && self.shared(&added) < self.shared(&names) {
                names = added;
            }
        }
        names
    }
}
