//! Measures of a flow: those of every run, and the groups that a case requests.
//!
//! Every run has the measures of `every_run`, those of its open sides ([`open`]) and, where its body force acts along each axis in turn, the
//! [`permeability`]; with a frozen interface the [`relative`] one. [`stream`] is the force of the other fluid. The groups are those of
//! `crates/validation/src`, passed to the solver as a list: the solver depends on none of them.

mod chip;
mod every_run;
pub mod open;
pub(crate) mod permeability;
pub(crate) mod relative;
pub mod stream;
mod subject;

pub(crate) use open::has_passed;
pub use subject::{Columns, DiscOf, Group, Subject};

use crate::flow::Flow;
use crate::observe::Observation;
use meniscus_core::solver::{Measure, Sample};

/// All measures of a run.
pub(crate) fn all(subject: &Subject, groups: &[Group]) -> Vec<Measure> {
    let mut measures = every_run::measures(subject);
    measures.extend(open::measures(subject));
    measures.extend(permeability::measures(subject));
    measures.extend(relative::measures(subject));
    measures.extend(groups.iter().flat_map(|group| (group.measures)(subject)));
    let of_chip: Vec<Measure> =
        measures.iter().filter_map(|one| chip::measure(&subject.flow.config.method, one)).collect();
    measures.extend(of_chip);
    measures
}

/// The samples for the full depth of those values of a row that are per meter of depth; none in the plane.
pub(crate) fn samples_of_chip(flow: &Flow, row: &[Sample]) -> Vec<Sample> {
    row.iter().filter_map(|one| chip::sample(&flow.config.method, *one)).collect()
}

/// Further columns of the time series: of open sides, of the permeability where it is measured, and of the groups.
pub(crate) fn columns(
    flow: &Flow,
    observed: &Observation,
    is_permeability_measured: bool,
    groups: &[Group],
) -> Columns {
    let mut columns = open::columns(flow);
    if is_permeability_measured {
        columns.extend(permeability::columns(flow));
    }
    for column in groups.iter().flat_map(|group| (group.columns)(flow, observed)) {
        // Two groups may need the same column.
        if columns.iter().all(|(name, _)| *name != column.0) {
            columns.push(column);
        }
    }
    columns
}
