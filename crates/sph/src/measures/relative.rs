//! Relative permeability of each phase with a frozen interface: the permeability to the phase alone, with the other phase as part of the solid,
//! over that of the whole pore.

use super::permeability::{Column, inertial, response, unsteady};
use super::subject::Subject;
use meniscus_core::solver::{Measure, measure};

/// The flows in the order of their stages.
const FLOWS: [&str; 3] = ["of the whole pore", "of the wetting phase", "of the non-wetting phase"];

pub(crate) fn measures(s: &Subject) -> Vec<Measure> {
    let columns = columns(s);
    let [whole, wetting, other] = &columns[..] else { return Vec::new() };
    let along = ["x", "y"][whole.axis];
    let [k, of_wetting, of_other] = [whole, wetting, other].map(|column| column.permeability[column.axis]);
    let of_whole = format!(
        "viscosity times the velocity along {along} averaged over the whole cell, over the force per volume, with one fluid in the whole pore"
    );
    let relative = |phase: &str| {
        format!(
            "the same with the {phase} phase as the only fluid and the other one as a part of the solid, over permeability-m2"
        )
    };
    let share = columns.iter().map(|column| column.unsteady_share).fold(0.0, f64::max);
    let of_share =
        "largest rate of change of momentum between the last two records of a flow, over the force on its fluid";
    let of_saturation = "area of the wetting phase over that of both at time zero";
    vec![
        measure("permeability-m2", k, "m2").by(&of_whole),
        measure("relative-permeability-wetting", of_wetting / k, "").by(relative("wetting")),
        measure("relative-permeability-non-wetting", of_other / k, "").by(relative("non-wetting")),
        measure("saturation", s.start.saturation(), "").by(of_saturation),
        measure("unsteady-share", share, "").by(of_share),
    ]
}

/// Warnings about the validity of the measures.
pub(crate) fn warnings(s: &Subject) -> Vec<String> {
    let of_column = |column: &Column| {
        let named = format!("the flow {}", FLOWS[column.stage]);
        [unsteady(column, &named), inertial(column, &named)]
    };
    columns(s).iter().flat_map(of_column).flatten().collect()
}

/// The response of each finished flow.
fn columns(s: &Subject) -> Vec<Column> {
    s.stages.filter(|_| s.is_frozen).map(|stages| response(s.flow, stages, s.series)).unwrap_or_default()
}
