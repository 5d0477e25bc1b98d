//! Permeability tensor of a periodic cell from creeping flow under a body force along each axis in turn: u_i = k_ij f_j/μ (Darcy's law).

use super::subject::{Columns, Subject};
use crate::flow::Flow;
use crate::stages::Stages;
use meniscus_core::math::{Vec2, remaining};
use meniscus_core::solver::{Measure, Series, measure};

/// Off-diagonal entries may differ by this fraction of the diagonal ones without a warning: the discretization is not symmetric.
const ASYMMETRY: f64 = 0.01;

/// Reynolds number of mean velocity and square root of permeability above which a warning is issued. Conservative: a rotated array at
/// 1.5 differed from creeping flow by no more than 2 %, the effect of particle motion.
const CREEPING: f64 = 0.5;

/// A flow whose momentum changes at more than this fraction of the force is not steady, nor is an entry of the tensor with a larger fraction of it left to change.
const STEADY: f64 = 0.01;

/// An entry smaller than this fraction of the diagonal counts as that: zero in an isotropic cell, it has no scale of its own.
const SMALLEST: f64 = 0.1;

/// Intervals over which the remaining change of a flow is extrapolated, over the length of its stage.
const INTERVAL: f64 = 0.1;

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
    /// What both still have to change, in m².
    pub(crate) left: Vec2,
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
        let rows = stages.rows(series, stage);
        let &[.., before, last] = &rows[..] else { return None };
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
            left: fluid.viscosity / force.abs() * left(&rows, |row| read(row, MEANS)),
            unsteady_share: rate / (force.abs() * fluid_area),
            reynolds: fluid.density * mean.norm() * length / fluid.viscosity,
        })
    };
    stages.axes().iter().enumerate().filter_map(column).collect()
}

/// What `value` still has to change after the last of the `rows` of a stage: after changes d₁ and d₂ over two equal intervals an exponential approach
/// leaves |d₂| r/(1 − r) with r = d₂/d₁, the larger of both components: the slowest part of a flow is in both, and one that turns back hides it.
/// NaN with fewer than three rows.
fn left(rows: &[&[f64]], value: impl Fn(&[f64]) -> Vec2) -> Vec2 {
    let [first, .., last] = rows else { return Vec2::repeat(f64::NAN) };
    let interval = INTERVAL * (last[0] - first[0]);
    let before = |time: f64| rows.iter().rev().copied().find(|row| row[0] <= time + 1e-6 * interval).unwrap_or(first);
    let middle = before(last[0] - interval);
    let start = before(middle[0] - interval);
    let (early, late) = (middle[0] - start[0], last[0] - middle[0]);
    if early == 0.0 {
        return Vec2::repeat(f64::NAN);
    }
    let [from, half, to] = [start, middle, last].map(&value);
    let (d1, d2) = (half - from, to - half);
    // With unequal intervals, the ratio of the rates over the time between their middles.
    let ratio_of = |i: usize| match d1[i] * d2[i] {
        both if both > 0.0 => (d2[i] / late / (d1[i] / early)).powf(2.0 * late / (early + late)),
        both if both < 0.0 => 0.5,
        _ => 0.0,
    };
    let ratio = ratio_of(0).max(ratio_of(1));
    let change = |i: usize| if d1[i] * d2[i] < 0.0 { d1[i].abs().max(d2[i].abs()) } else { d2[i].abs() };
    Vec2::from_fn(|i, _| remaining(change(i), ratio))
}

pub(crate) fn measures(s: &Subject) -> Vec<Measure> {
    let Some(stages) = s.stages.filter(|_| !s.is_frozen) else { return Vec::new() };
    let columns = response(s.flow, stages, s.series);
    columns.iter().flat_map(column_measures).collect()
}

fn column_measures(column: &Column) -> Vec<Measure> {
    let Column { permeability: k, left, unsteady_share: share, .. } = *column;
    let force = ["x", "y"][column.axis];
    let of = |velocity: &str| {
        format!(
            "viscosity times the velocity along {velocity} averaged over the whole cell, solids at rest, over the force per volume along \
             {force}, at the end of the force along {force}; the bar is what an exponential approach still changes"
        )
    };
    let of_share = format!(
        "magnitude of the rate of change of momentum between the last two records of the force along {force}, over that force on the fluid"
    );
    if column.axis == 0 {
        vec![
            measure("permeability-xx-m2", k.x, "m2").by(of("x")).with_uncertainty(left.x),
            measure("permeability-yx-m2", k.y, "m2").by(of("y")).with_uncertainty(left.y),
            measure("unsteady-share-x", share, "").by(&of_share),
        ]
    } else {
        vec![
            measure("permeability-xy-m2", k.x, "m2").by(of("x")).with_uncertainty(left.x),
            measure("permeability-yy-m2", k.y, "m2").by(of("y")).with_uncertainty(left.y),
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
    found.extend(changing(&columns));
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

/// The warning if entries of the tensor are not steady, each by its own size.
fn changing(columns: &[Column]) -> Option<String> {
    let diagonal = columns.iter().map(|column| column.permeability[column.axis]).sum::<f64>() / columns.len() as f64;
    let entry = |column: &Column, i: usize| {
        let (k, left) = (column.permeability[i], column.left[i]);
        let name = format!("{}{}", ["x", "y"][i], ["x", "y"][column.axis]);
        (left > STEADY * k.abs().max(SMALLEST * diagonal)).then(|| format!("{name} by {left:.1e} of {k:.2e} m2"))
    };
    let entries: Vec<String> = columns.iter().flat_map(|column| [0, 1].map(|i| entry(column, i))).flatten().collect();
    (!entries.is_empty()).then(|| {
        format!(
            "entries of the permeability may still change: {}; a later time.end gives the flow more time",
            entries.join(", ")
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
        Column {
            stage: axis,
            axis,
            permeability: permeability.into(),
            left: Vec2::zeros(),
            unsteady_share,
            reynolds: 0.0,
        }
    }

    #[test]
    fn off_diagonals_may_differ_by_what_the_flows_had_left_to_change() {
        let warned = |share: f64| asymmetric(&column(0, [3.0, 1.0], share), &column(1, [1.1, 2.0], share)).is_some();
        assert!(warned(0.0) && !warned(0.05));
        assert!(asymmetric(&column(0, [3.0, 1.0], 0.0), &column(1, [1.01, 2.0], 0.0)).is_none());
    }

    #[test]
    fn the_remaining_change_of_an_exponential_does_not_depend_on_the_records() {
        let exact = (-5.0_f64).exp();
        for count in [10, 30, 200] {
            let rows: Vec<Vec<f64>> = (0..=count).map(|i| vec![f64::from(i) / f64::from(count)]).collect();
            let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
            let found = left(&rows, |row| Vec2::new(1.0 - (-5.0 * row[0]).exp(), 2.0));
            assert!((found.x / exact - 1.0).abs() < 1e-9 && found.y == 0.0, "{count}: {found:?}, {exact}");
        }
        // The last interval shorter than the others, and few rows.
        for times in [vec![0.0, 0.3, 0.6, 0.8, 1.0], vec![0.0, 0.5, 1.0], vec![0.0, 0.7, 1.0]] {
            let rows: Vec<Vec<f64>> = times.iter().map(|time| vec![*time]).collect();
            let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
            let found = left(&rows, |row| Vec2::new(1.0 - (-5.0 * row[0]).exp(), 2.0));
            assert!(found.x > 0.3 * exact && found.x < 5.0 * exact, "{times:?}: {found:?}, {exact}");
        }
    }

    #[test]
    fn a_small_entry_that_still_grows_is_told() {
        let told =
            |left: f64| changing(&[Column { left: Vec2::new(0.0, left), ..column(0, [7.0e-9, 2.2e-10], 1.6e-3) }]);
        assert!(told(0.5e-10).is_some_and(|text| text.contains("yx by 5.0e-11 of 2.20e-10 m2")));
        assert_eq!(told(1.0e-12), None);
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
