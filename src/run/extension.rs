//! Extension of a finished run to a later `time.end`: its case is the same but for the end, what is recorded and what is expected.

use std::path::Path;

use serde_json::Value;

use super::report::REPORT;
use meniscus_case::{Case, Model};
use meniscus_output::restart;

/// Keys of a case that do not affect the results so far: intervals of the output follow from the end if not given.
const FREE: [&str; 4] = ["end", "output", "expect", "title"];

/// The hash of the saved state in `folder`, if the run in it ended and `case` is its continuation to a later end.
pub(super) fn hash_of_shorter(folder: &Path, case: &Case) -> Option<u64> {
    let saved = restart::load(folder).ok()?;
    let report: Value = serde_json::from_slice(&std::fs::read(folder.join(REPORT)).ok()?).ok()?;
    let is_of_state = report["steps"].as_u64() == Some(saved.step);
    let [before, now] = [report["case"].clone(), serde_json::to_value(case).ok()?].map(without_free);
    let ends_later = case.end > saved.time && report["case"]["end"].as_f64().is_some_and(|end| case.end > end);
    // A tensor is measured by forces in turn, each for a fraction of the time until the end.
    let has_turns =
        matches!(&case.model, Model::Sph(sph) if sph.measure.permeability || sph.measure.relative_permeability);
    (is_of_state && before == now && ends_later && !has_turns).then_some(saved.case_hash)
}

fn without_free(mut case: Value) -> Value {
    if let Some(keys) = case.as_object_mut() {
        keys.retain(|key, _| !FREE.contains(&key.as_str()));
    }
    case
}
