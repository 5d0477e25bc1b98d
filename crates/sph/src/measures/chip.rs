//! Values of a chip: areas, flow rates, energies, momenta and forces of a flow are per meter of depth, as their names say. Between a floor and
//! a lid each is also reported for the full depth, under the name with that unit.

use crate::method::Method;
use meniscus_core::solver::{Measure, Sample};

/// Columns of the time series per meter of depth, and those for the full depth.
const COLUMNS: [(&str, &str); 17] = [
    ("kinetic_energy_J_per_m", "kinetic_energy_J"),
    ("wetting_area_m2", "wetting_volume_m3"),
    ("non_wetting_area_m2", "non_wetting_volume_m3"),
    ("momentum_x_kg_per_m_s", "momentum_x_kg_m_per_s"),
    ("momentum_y_kg_per_m_s", "momentum_y_kg_m_per_s"),
    ("wetting_in_m2", "wetting_in_m3"),
    ("wetting_out_m2", "wetting_out_m3"),
    ("non_wetting_in_m2", "non_wetting_in_m3"),
    ("non_wetting_out_m2", "non_wetting_out_m3"),
    ("passed_m2", "passed_m3"),
    ("flow_rate_x_m2_per_s", "flow_rate_x_m3_per_s"),
    ("flow_rate_y_m2_per_s", "flow_rate_y_m3_per_s"),
    ("drive_N_per_m", "drive_N"),
    ("wall_friction_N_per_m", "wall_friction_N"),
    ("stream_pressure_N_per_m", "stream_pressure_N"),
    ("stream_friction_N_per_m", "stream_friction_N"),
    ("drop_momentum_kg_per_m_s", "drop_momentum_kg_m_per_s"),
];

/// Measures per meter of depth, and those for the full depth with their unit.
const MEASURES: [(&str, &str, &str); 6] = [
    ("inflow-m2-per-s", "inflow-m3-per-s", "m3/s"),
    ("asked-inflow-m2-per-s", "asked-inflow-m3-per-s", "m3/s"),
    ("retention-N-per-m", "retention-N", "N"),
    ("wall-retention-N-per-m", "wall-retention-N", "N"),
    ("stream-drag-N-per-m", "stream-drag-N", "N"),
    ("net-drag-N-per-m", "net-drag-N", "N"),
];

/// The sample for the full depth of one per meter of depth, `None` in the plane or for other quantities.
pub(super) fn sample(method: &Method, one: Sample) -> Option<Sample> {
    let depth = method.plates?.depth.distance();
    let (_, name) = COLUMNS.iter().find(|(of_meter, _)| *of_meter == one.name)?;
    Some(Sample { name, value: depth * one.value })
}

/// The measure for the full depth of one per meter of depth, `None` in the plane or for other quantities.
pub(super) fn measure(method: &Method, one: &Measure) -> Option<Measure> {
    let depth = method.plates?.depth.distance();
    let (of_meter, name, unit) = MEASURES.iter().find(|(of_meter, ..)| *of_meter == one.name)?;
    Some(Measure {
        name: (*name).to_owned(),
        value: depth * one.value,
        unit: (*unit).to_owned(),
        uncertainty: one.uncertainty.map(|uncertainty| depth * uncertainty),
        method: format!("{of_meter} times the depth"),
        moves_with: None,
    })
}
