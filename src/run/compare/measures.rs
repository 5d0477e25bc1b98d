//! The numbers of a comparison, as measures of a run.

use super::comparison::{Comparison, Side};
use meniscus_core::solver::{self, Measure};

/// Those of both together, then each of the network and of the direct simulation.
pub(crate) fn measures(found: &Comparison) -> Vec<Measure> {
    let Comparison { network, direct, .. } = found;
    let threshold = "capillary pressure p_n - p_w until an element at the outlet was filled: the largest of a drainage, the smallest of an imbibition";
    let reached = "when the invading phase reached the outlet, of displacements in time";
    let largest = |side: &Side| side.breakthrough_pressure_pa;
    let saturation = |side: &Side| side.saturation_at_breakthrough;
    vec![
        measure("mean-overlap", found.mean_overlap, "")
            .by("area that both have invaded over the area that either has, at the nearest saturation; mean over the \
                 records"),
        measure("rank-correlation", found.rank_correlation, "")
            .by("Spearman's, of the order in which elements were filled that both filled"),
        measure("elements-in-both", Some(found.elements_in_both as f64), "").by("elements that both filled"),
        measure("network-breakthrough-pressure-Pa", largest(network), "Pa").by(threshold),
        measure("direct-breakthrough-pressure-Pa", largest(direct), "Pa").by(threshold),
        measure("network-saturation-at-breakthrough", saturation(network), "").by("of the invading phase"),
        measure("direct-saturation-at-breakthrough", saturation(direct), "").by("of the invading phase"),
        measure("network-breakthrough-time-s", network.breakthrough_time_s, "s").by(reached),
        measure("direct-breakthrough-time-s", direct.breakthrough_time_s, "s").by(reached),
        measure("network-permeability-m2", network.permeability_m2, "m2").by("along x, of the network"),
        measure("direct-permeability-m2", direct.permeability_m2, "m2").by("along x, where the case measures it"),
        measure("network-pores", Some(network.unknowns as f64), "").by("pores of the network"),
        measure("direct-particles", Some(direct.unknowns as f64), "").by("particles of the direct simulation"),
        measure("network-cpu-s", network.processor_time_s, "s").by("processor time of the network"),
        measure("direct-cpu-s", direct.processor_time_s, "s").by("processor time of the direct simulation"),
    ]
}

/// A measure without an uncertainty; NaN if it was not measured.
fn measure(name: &str, value: Option<f64>, unit: &str) -> Measure {
    solver::measure(name, value.unwrap_or(f64::NAN), unit)
}
