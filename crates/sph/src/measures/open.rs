//! Measures of runs with open sides: mass balance, flow rates, breakthrough and burst pressure.

use super::subject::{Columns, Subject};
use crate::flow::Flow;
use crate::open::{BoundaryFluxes, GivenFlow, OpenSide};
use crate::particles::Phase;
use crate::unresolved::SMALLEST_PIECE;
use meniscus_core::solver::{Measure, measure};

fn is_open(flow: &Flow) -> bool {
    !flow.config.open.sides.is_empty() || !flow.config.open.through.is_empty()
}

/// With `pressure-steps`: pressure at that side minus that at the opposite side
pub const PRESSURE_DIFFERENCE: &str = "pressure_difference_Pa";

/// With a given velocity or flow rate: mean pressure within two spacings of that side minus the pressure given at the other one
pub const DRIVING_PRESSURE: &str = "driving_pressure_Pa";

/// Area of the invading phase that left through another side; with `pressure-steps`, of the phase at that side through the opposite one
pub(crate) const PASSED: &str = "passed_m2";

/// The first side whose pressure rises in steps.
fn rising(flow: &Flow) -> Option<&OpenSide> {
    flow.config.open.sides.iter().find(|side| side.steps.is_some())
}

/// Whether two phases can displace each other through open sides.
fn is_displacement(flow: &Flow) -> bool {
    flow.config.method.tension > 0.0 && !flow.config.open.sides.is_empty()
}

/// The invading phase, of which more came in, and the number of the side through which most of it did.
fn entering(flow: &Flow) -> (usize, usize) {
    let fluxes = &flow.state.fluxes;
    let (inflow, _) = fluxes.totals();
    let phase = usize::from(inflow[1] > inflow[0]);
    let entry = (0..fluxes.inflow.len()).max_by_key(|number| fluxes.inflow[*number][phase]).unwrap_or(0);
    (phase, entry)
}

/// An open side other than `side`.
fn opposite<'a>(flow: &'a Flow, side: &OpenSide) -> Option<&'a OpenSide> {
    flow.config.open.sides.iter().find(|other| other.number != side.number)
}

/// The particles of the invading phase that left through another side than that by which it came in.
fn passed(flow: &Flow) -> Option<u64> {
    let outflow = &flow.state.fluxes.outflow;
    if let Some(side) = rising(flow) {
        let phase = usize::from(side.main != Phase::Wetting);
        return Some(opposite(flow, side).map_or(0, |opposite| outflow[opposite.number][phase]));
    }
    is_displacement(flow).then(|| {
        let (phase, entry) = entering(flow);
        (0..outflow.len()).filter(|number| *number != entry).map(|number| outflow[number][phase]).sum()
    })
}

/// Whether the invading phase has passed another side; before as much came in, it is not known which phase invades.
pub(crate) fn has_passed(flow: &Flow) -> bool {
    let came_in = flow.state.fluxes.totals().0.into_iter().max();
    [came_in, passed(flow)].into_iter().all(|count| count.is_some_and(|count| count >= SMALLEST_PIECE as u64))
}

/// Columns of open sides, among them the areas in m² that came in and left since time zero, by phase: particle counts times V_0.
pub(crate) fn columns(flow: &Flow) -> Columns {
    if !is_open(flow) {
        return vec![];
    }
    let (inflow, outflow) = flow.state.fluxes.totals();
    let area = |count: u64| count as f64 * flow.config.method.volume;
    let mut columns = vec![
        // Area of the wetting phase that entered, counted in particles
        ("wetting_in_m2", area(inflow[0])),
        // Area of the wetting phase that left, counted in particles
        ("wetting_out_m2", area(outflow[0])),
        // Area of the non-wetting phase that entered, counted in particles
        ("non_wetting_in_m2", area(inflow[1])),
        // Area of the non-wetting phase that left, counted in particles
        ("non_wetting_out_m2", area(outflow[1])),
    ];
    let names = [
        (
            // Periodic sides: flow rate along x
            "flow_rate_x_m2_per_s",
            // Periodic sides: mean driving pressure gradient along x
            "driving_gradient_x_Pa_per_m",
        ),
        (
            // Periodic sides: flow rate along y
            "flow_rate_y_m2_per_s",
            // Periodic sides: mean driving pressure gradient along y
            "driving_gradient_y_Pa_per_m",
        ),
    ];
    if let Some(side) = rising(flow) {
        let [high, low] =
            [Some(side), opposite(flow, side)].map(|side| side.and_then(OpenSide::given_pressure).unwrap_or(0.0));
        columns.push((PRESSURE_DIFFERENCE, high - low));
    }
    columns.extend(passed(flow).map(|count| (PASSED, area(count))));
    if let Some(pressure) = driving_pressure(flow) {
        columns.push((DRIVING_PRESSURE, pressure));
    }
    for (side, given) in flow.view().given_flows() {
        let (rate, gradient) = names[side.axis()];
        let sign = side.inward_sign();
        columns.extend([(rate, sign * given.rate), (gradient, sign * given.gradient)]);
    }
    columns
}

/// Mean pressure in Pa of the particles within a few spacings on either side of the sides with a given velocity, minus that given at the others.
fn driving_pressure(flow: &Flow) -> Option<f64> {
    /// Half-width of that strip over the row spacing.
    const DEPTH: f64 = 2.0;
    let sides = &flow.config.open.sides;
    let outlet = sides.iter().find_map(OpenSide::given_pressure)?;
    let particles = &flow.state.particles;
    let lies_at = |side: &OpenSide, a: usize| side.overshoot(particles.position[a]).abs() < DEPTH * side.row_spacing;
    let driven: Vec<&OpenSide> = sides.iter().filter(|side| side.given_pressure().is_none()).collect();
    let there = (0..particles.moving()).filter(|&a| driven.iter().any(|side| lies_at(side, a)));
    let (sum, count) = there.fold((0.0, 0_usize), |(sum, count), a| (sum + particles.pressure[a], count + 1));
    (count > 0).then(|| sum / count as f64 - outlet)
}

/// Net inflow: areas in m² of the wetting and the non-wetting phase that came in minus those that left.
pub(crate) fn net(flow: &Flow) -> [f64; 2] {
    let (inflow, outflow) = flow.state.fluxes.totals();
    [0, 1].map(|i| (inflow[i] as f64 - outflow[i] as f64) * flow.config.method.volume)
}

pub(crate) fn measures(s: &Subject) -> Vec<Measure> {
    let flow = s.flow;
    if !is_open(flow) {
        return vec![];
    }
    let (fluxes, fluids) = (&flow.state.fluxes, flow.state.particles.fluids);
    let (inflow, outflow) = fluxes.totals();
    let inside = BoundaryFluxes::count(&flow.state.particles.phase[..fluids]);
    let start: u64 = fluxes.initial.iter().sum();
    let missing = |i: usize| (fluxes.initial[i] as f64 + inflow[i] as f64 - outflow[i] as f64 - inside[i] as f64).abs();
    let error = [0, 1].map(missing).into_iter().fold(0.0, f64::max) / start as f64;
    let net: f64 = net(flow).iter().sum();
    let area = |of: &meniscus_geometry::analysis::phases::PhaseAreas| of.wetting + of.non_wetting;
    let drift = (area(&s.observed.areas) - area(&s.start) - net) / area(&s.start);
    let mut found = vec![
        measure("balance-error", error, "")
            .by("particles at time zero plus those that came in minus those that left and those inside, larger of \
                 both phases, over all at time zero"),
        measure("open-area-drift", drift, "")
            .by("change of the area of both phases minus the net inflow through the sides, over the area at time \
                 zero"),
    ];
    if flow.state.time > 0.0 {
        found.extend(flow_rates(flow));
    }
    if is_displacement(flow) {
        found.extend(breakthrough(s));
    }
    found.extend(burst(s));
    found
}

/// Area in m² of 20 particles, the smallest resolved drop: fewer that leave may be stray particles ahead of the front.
fn smallest_passage(flow: &Flow) -> f64 {
    SMALLEST_PIECE as f64 * flow.config.method.volume
}

/// Breakthrough time of the invading phase and its saturation then: in the middle between two records.
fn breakthrough(s: &Subject) -> [Measure; 2] {
    let is_wetting = match rising(s.flow) {
        Some(side) => side.main == Phase::Wetting,
        None => entering(s.flow).0 == 0,
    };
    let [passed, time, wetting] =
        [PASSED, "time_s", "saturation"].map(|name| s.series.column(name).collect::<Vec<f64>>());
    // Of the invading phase, as for networks.
    let saturation: Vec<f64> = wetting.iter().map(|s| if is_wetting { *s } else { 1.0 - s }).collect();
    // At the very start, before much came in, the column can refer to the other phase.
    let before = passed.iter().rposition(|&area| area < smallest_passage(s.flow));
    let interval = before.map(|row| [row, row + 1]).filter(|[_, after]| *after < passed.len());
    let method = match interval {
        Some(_) => {
            "middle of the interval between records in which the invading phase left through another side, 20 particles of it: fewer may be \
             stray ones ahead of the front"
        }
        None => "the invading phase has not left through another side by the end",
    };
    let of = |name: &str, values: &[f64], unit: &str| {
        let ends = interval.map(|rows| rows.map(|row| values[row]));
        let middle = ends.map_or(f64::NAN, |[before, after]| 0.5 * (before + after));
        let uncertainty = ends.map(|[before, after]| 0.5 * (after - before).abs() / 3.0_f64.sqrt());
        measure(name, middle, unit).by(method).with_uncertainty(uncertainty)
    };
    [of("breakthrough-time-s", &time, "s"), of("saturation-at-breakthrough", &saturation, "")]
}

/// The pressure, rising in steps, at which the invading phase reaches the opposite side: between the last one with menisci at rest and the one
/// at which it arrives.
fn burst(s: &Subject) -> Option<Measure> {
    /// Menisci are at rest if the saturation changes by less than this in the last quarter of a step.
    const REST: f64 = 1e-3;
    let hold = rising(s.flow)?.steps?.hold;
    let [pressure, passed, time, saturation] =
        [PRESSURE_DIFFERENCE, PASSED, "time_s", "saturation"].map(|name| s.series.column(name).collect::<Vec<f64>>());
    let through = passed.iter().position(|&area| area >= smallest_passage(s.flow));
    let rests = |end: &usize| {
        let late = (0..*end).rev().find(|&row| time[row] <= time[*end] - 0.25 * hold);
        late.is_some_and(|late| (saturation[*end] - saturation[late]).abs() < REST)
    };
    let bracket = through.and_then(|through| {
        let ends = (1..through).filter(|&row| pressure[row + 1] > pressure[row]);
        Some([pressure[ends.rev().find(rests)?], pressure[through]])
    });
    Some(
        measure("burst-pressure-Pa", bracket.map_or(f64::NAN, |[low, high]| 0.5 * (low + high)), "Pa")
            .by(
                "middle between the last pressure difference with menisci at rest and that at which the invading phase \
             reached the opposite side, both within the uncertainty; needs one of each",
            )
            .with_uncertainty(bracket.map(|[low, high]| 0.5 * (high - low))),
    )
}

/// Mean flow rates since time zero and those that were requested.
fn flow_rates(flow: &Flow) -> Vec<Measure> {
    let (open, fluxes, time) = (&flow.config.open, &flow.state.fluxes, flow.state.time);
    let count = |counts: &[[u64; 2]; 4], number: usize| counts[number].iter().sum::<u64>() as f64;
    let through_open_side = |side: &OpenSide| {
        let requested = side.given_pressure().is_none().then(|| side.average_flow_rate(time));
        // Given velocities: by the displacements of the rows, since particle counts change by whole layers.
        let counted =
            || (count(&fluxes.inflow, side.number) - count(&fluxes.outflow, side.number)) * flow.config.method.volume;
        (if requested.is_some() { fluxes.passed[side.number] } else { counted() } / time, requested)
    };
    let through_period =
        |(side, given): (&OpenSide, &GivenFlow)| (given.passed / time, Some(side.average_flow_rate(time)));
    let rates = open.sides.iter().map(through_open_side).chain(flow.view().given_flows().map(through_period));
    let (mut came_in, mut requested_in, mut given_in) = (0.0, 0.0, 0.0);
    for (rate, requested) in rates {
        came_in += f64::max(rate, 0.0);
        requested_in += requested.unwrap_or(0.0);
        given_in += requested.map_or(0.0, |_| rate);
    }
    let method = "net inflow of area over the sides with inflow, divided by the time since time zero";
    let mut found = vec![measure("inflow-m2-per-s", came_in, "m2/s").by(method)];
    if requested_in > 0.0 {
        let method = "sum of the inward flow rates given in the case, on average over time";
        found.push(measure("asked-inflow-m2-per-s", requested_in, "m2/s").by(method));
        let method = "inflow through the sides with a given velocity or flow rate, over the requested one";
        found.push(measure("inflow-ratio", given_in / requested_in, "").by(method));
    }
    for (side, given) in flow.view().given_flows() {
        let drop = given.gradient * flow.config.domain.bounds.size()[side.axis()];
        let method = "largest relative error of the flow rate through the periodic side in a step, from the displacements of all particles";
        found.push(measure("largest-flow-rate-error", given.largest_error, "").by(method));
        let method = "mean pressure gradient that drives the given flow at the end, times the period";
        found.push(measure("driving-pressure-drop-Pa", drop, "Pa").by(method));
    }
    found
}
