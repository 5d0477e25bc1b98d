//! Permeability tensor of a periodic cell from creeping flow under a body force along each axis in turn: u_i = k_ij f_j/μ (Darcy's law).

use super::subject::{Columns, Subject};
use crate::flow::Flow;
use crate::stages::Stages;
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, Series, measure};

/// Off-diagonal entries may differ by this fraction of the diagonal ones without a warning: the discretization is not symmetric.
const ASYMMETRY: f64 = 0.01;

/// Reynolds number of mean velocity and square root of permeability above which a warning is issued. Conservative: a rotated array at
/// 1.5 differed from creeping flow by no more than 2 %, the effect of particle motion.
const CREEPING: f64 = 0.5;

/// A flow whose momentum changes at more than this fraction of the force is not steady.
const STEADY: f64 = 0.01;

const MEANS: [&str; 2] = ["mean_velocity_x_m_per_s", "mean_velocity_y_m_per_s"];
const AREAS: [&str; 2] = ["wetting_area_m2", "non_wetting_area_m2"];
const MOMENTA: [&str; 2] = ["momentum_x_kg_per_m_s", "momentum_y_kg_per_m_s"];

/// Superficial velocity in m/s: averaged over the whole cell, zero in solids.
pub(crate) fn columns(flow: &Flow) -> Columns {
    let p = &flow.state.particles;
    let flux: Vec2 = (0..p.fluids).map(|a| flow.fields.bulk.volume[a] * p.velocity[a]).sum();
    let mean = flux / flow.config.domain.bounds.area();
    MEANS.into_iter().zip([mean.x, mean.y]).collect()
}

/// Column of the tensor: response to the force along one axis, in its stage.
pub(super) struct Column {
    /// Number of the stage.
    pub(crate) stage: usize,
    /// Axis of the force: 0 for x, 1 for y.
    pub(crate) axis: usize,
    /// Permeabilities in m² from the velocities along x and y.
    pub(crate) permeability: Vec2,
    /// Magnitude of the rate of change of momentum over the force on the fluid.
    pub(crate) unsteady_share: f64,
    /// Reynolds number of mean velocity and square root of permeability.
    pub(crate) reynolds: f64,
}

/// The response to each force whose stage has two rows.
pub(super) fn response(flow: &Flow, stages: &Stages, series: &Series) -> Vec<Column> {
    let fluid = &flow.config.method.wetting_fluid;
    let read = |row: &[f64], names: [&str; 2]| {
        let value = |name: &str| series.columns.iter().position(|column| column == name).map_or(f64::NAN, |i| row[i]);
        Vec2::from(names.map(value))
    };
    let column = |(stage, &axis): (usize, &usize)| {
        let [before, last] = stages.last_rows(series, stage)?;
        // Force per volume.
        let force = fluid.density * stages.force_of(stage)[axis];
        let mean = read(last, MEANS);
        let fluid_area = read(last, AREAS).sum();
        let rate = (read(last, MOMENTA) - read(before, MOMENTA)).norm() / (last[0] - before[0]);
        let permeability = fluid.viscosity * mean / force;
        let length = permeability.norm().sqrt();
        Some(Column {
            stage,
            axis,
            permeability,
            unsteady_share: rate / (force.abs() * fluid_area),
            reynolds: fluid.density * mean.norm() * length / fluid.viscosity,
        })
    };
    stages.axes().iter().enumerate().filter_map(column).collect()
}

pub(crate) fn measures(s: &Subject) -> Vec<Measure> {
    let Some(stages) = s.stages.filter(|_| !s.is_frozen) else { return Vec::new() };
    let columns = response(s.flow, stages, s.series);
    columns.iter().flat_map(column_measures).collect()
}

fn column_measures(column: &Column) -> Vec<Measure> {
    let Column { permeability: k, unsteady_share: share, .. } = *column;
    let force = ["x", "y"][column.axis];
    let of = |velocity: &str| {
        format!(
            "viscosity times the velocity along {velocity} averaged over the whole cell, solids at rest, over the force per volume along \
             {force}, at the end of the force along {force}"
        )
    };
    let of_share = format!(
        "magnitude of the rate of change of momentum between the last two records of the force along {force}, over that force on the fluid"
    );
    if column.axis == 0 {
        vec![
            measure("permeability-xx-m2", k.x, "m2").by(of("x")),
            measure("permeability-yx-m2", k.y, "m2").by(of("y")),
            measure("unsteady-share-x", share, "").by(&of_share),
        ]
    } else {
        vec![
            measure("permeability-xy-m2", k.x, "m2").by(of("x")),
            measure("permeability-yy-m2", k.y, "m2").by(of("y")),
            measure("unsteady-share-y", share, "").by(&of_share),
        ]
    }
}

/// Warnings about the validity of the tensor.
pub(crate) fn warnings(s: &Subject) -> Vec<String> {
    let Some(stages) = s.stages.filter(|_| !s.is_frozen) else { return Vec::new() };
    let columns = response(s.flow, stages, s.series);
    let named = |column: &Column| format!("the flow under the force along {}", ["x", "y"][column.axis]);
    let mut found: Vec<String> = columns
        .iter()
        .flat_map(|column| [unsteady(column, &named(column)), inertial(column, &named(column))])
        .flatten()
        .collect();
    if let [x, y] = &columns[..] {
        found.extend(asymmetric(x, y));
    }
    found
}

/// The warning if the `named` flow was not steady.
pub(super) fn unsteady(column: &Column, named: &str) -> Option<String> {
    let share = column.unsteady_share;
    (share > STEADY).then(|| {
        format!(
            "{named} was not steady: {:.1} % of the force still changed its momentum; a later time.end gives it more time",
            100.0 * share
        )
    })
}

/// The warning if the `named` flow is too fast.
pub(super) fn inertial(column: &Column, named: &str) -> Option<String> {
    let reynolds = column.reynolds;
    (reynolds > CREEPING).then(|| {
        format!(
            "{named} has a Reynolds number of {reynolds:.2} with the square root of the permeability: above \
             {CREEPING} inertia can change the permeability; lower sph.gravity"
        )
    })
}

/// The warning if the tensor is not symmetric, as that of creeping flow is (Lorentz reciprocal theorem).
fn asymmetric(x: &Column, y: &Column) -> Option<String> {
    let (xy, yx) = (y.permeability.x, x.permeability.y);
    let diagonal = 0.5 * (x.permeability.x + y.permeability.y);
    let of_unsteadiness = x.unsteady_share * x.permeability.norm() + y.unsteady_share * y.permeability.norm();
    let allowed = of_unsteadiness + ASYMMETRY * diagonal;
    ((xy - yx).abs() > allowed).then(|| {
        format!(
            "permeability-xy-m2 = {xy:.3e} and permeability-yx-m2 = {yx:.3e} differ by more than the unsteady shares allow, and in a slow flow \
             they are equal: lower sph.gravity or sph.spacing"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(axis: usize, permeability: [f64; 2], unsteady_share: f64) -> Column {
        Column { stage: axis, axis, permeability: permeability.into(), unsteady_share, reynolds: 0.0 }
    }

    #[test]
    fn off_diagonals_may_differ_by_what_the_flows_had_left_to_change() {
        let warned = |share: f64| asymmetric(&column(0, [3.0, 1.0], share), &column(1, [1.1, 2.0], share)).is_some();
        assert!(warned(0.0) && !warned(0.05));
        assert!(asymmetric(&column(0, [3.0, 1.0], 0.0), &column(1, [1.01, 2.0], 0.0)).is_none());
    }

    #[test]
    fn what_is_not_steady_or_not_slow_is_told() {
        assert!(
            unsteady(&column(0, [3.0, 1.0], 0.02), "it").is_some_and(|text| text.contains("it was not steady: 2.0 %"))
        );
        assert!(unsteady(&column(0, [3.0, 1.0], 1e-3), "it").is_none());
        let fast = Column { reynolds: 3.0, ..column(1, [3.0, 1.0], 0.0) };
        assert!(inertial(&fast, "it").is_some_and(|text| text.contains("it has a Reynolds number of 3.00")));
        assert!(inertial(&column(1, [3.0, 1.0], 0.0), "it").is_none());
    }
}
