//! The network of a comparison, from event to event.

use super::pair::CompareError;
use super::track::{Grid, Record, Track};
use crate::case::network::PoreNetwork;
use crate::case::network::state::NetworkState;
use crate::case::{Case, FluidPhase, Side};
use crate::geometry::curve::Curve;
use crate::math::Vec2;
use crate::network::displacement::Phase;
use crate::network::dynamic::solver::DynamicSolver;
use crate::network::setup;
use crate::network::solver::NetworkSolver;
use crate::network::state;
use crate::run::setup::SetupError;
use crate::solver::{Series, Solver};

/// The present state; `None` if there is no displacement.
pub(crate) fn state(solver: &NetworkSolver) -> Option<NetworkState> {
    let cycles = solver.cycles()?;
    Some(state::state(solver.config(), cycles.half_cycles(), &cycles.moment()))
}

/// Runs the first half cycle.
pub(crate) fn track(solver: &mut NetworkSolver, grid: &Grid) -> Result<Track, CompareError> {
    let mut records = vec![record(solver, grid)];
    let elements = solver.cycles().map_or(0, |cycles| cycles.displacement().elements().len());
    let mut filled = vec![None; elements];
    note_filled(solver, 0, &mut filled);
    while !solver.is_done() {
        solver.step(f64::INFINITY)?;
        let Some(cycles) = solver.cycles().filter(|cycles| cycles.half_cycle_index() == 0) else { break };
        if cycles.history().len() + 1 > records.len() {
            records.push(record(solver, grid));
            note_filled(solver, records.len() - 1, &mut filled);
        }
    }
    Ok(Track { records, filled, ..totals(solver) })
}

/// The cost of a network, its permeability and its warnings.
fn totals(solver: &dyn Solver) -> Track {
    let statistics = solver.statistics();
    let wall_time_s = statistics.parts.iter().map(|part| part.seconds).sum();
    let measures = solver.measures(&Series::default());
    let permeability = measures.iter().find(|it| it.name == "permeability-x-m2").map(|it| it.value);
    let permeability = permeability.filter(|value| value.is_finite());
    Track {
        records: Vec::new(),
        filled: Vec::new(),
        wall_time_s,
        // It runs in a single thread.
        processor_time_s: Some(wall_time_s),
        unknowns: statistics.unknowns,
        steps: statistics.steps,
        permeability,
        breakthrough: None,
        warnings: solver.warnings(&Series::default()),
    }
}

/// Runs a displacement in time with `records` states until the time `end` in s, or to its own end.
pub(crate) fn track_in_time(
    (case, wanted): (&Case, &PoreNetwork),
    grid: &Grid,
    (end, records): (f64, usize),
) -> Result<Track, CompareError> {
    let solver = setup::build_in_time(case, wanted).map_err(SetupError::from)?;
    let mut solver = solver.ok_or(CompareError::NoNetwork)?;
    let mut found = vec![record_in_time(&solver, grid)];
    let mut filled: Vec<Option<usize>> = solver.shares().map(|fraction| (fraction > 0.5).then_some(0)).collect();
    for number in 1..=records {
        let until = end * number as f64 / records as f64;
        while !solver.is_done() && solver.time() < until {
            solver.step(until)?;
        }
        found.push(record_in_time(&solver, grid));
        for (filled, _) in filled.iter_mut().zip(solver.shares()).filter(|(_, fraction)| *fraction > 0.5) {
            filled.get_or_insert(number);
        }
        if solver.is_done() {
            break;
        }
    }
    let breakthrough = solver.breakthrough().map(|it| {
        let is_wetting = solver.invading() == FluidPhase::Wetting;
        [it.time, if is_wetting { it.saturation } else { 1.0 - it.saturation }]
    });
    Ok(Track { records: found, filled, breakthrough, ..totals(&solver) })
}

fn record_in_time(solver: &DynamicSolver, grid: &Grid) -> Record {
    let sample = solver.sample();
    let value = |name: &str| sample.iter().find(|it| it.name == name).map_or(f64::NAN, |it| it.value);
    let shares: Vec<f64> = solver.shares().collect();
    // There is no flow yet at the start.
    let pressure = if solver.steps() > 0 { value("pressure_difference_Pa") } else { f64::NAN };
    Record {
        time: solver.time(),
        saturation: value("saturation"),
        pressure,
        invaded: grid.cells.iter().map(|&(_, element)| shares[element] > 0.5).collect(),
    }
}

fn record(solver: &NetworkSolver, grid: &Grid) -> Record {
    let Some(cycles) = solver.cycles() else {
        return Record { time: f64::NAN, saturation: f64::NAN, pressure: f64::NAN, invaded: Vec::new() };
    };
    let holds = |element: usize| cycles.displacement().phase(element) == Phase::Invading;
    Record {
        time: f64::NAN,
        saturation: cycles.saturation(),
        pressure: cycles
            .applied()
            .map_or(f64::NAN, |applied| solver.config().pressure(cycles.half_cycle().invading, applied)),
        invaded: grid.cells.iter().map(|&(_, element)| holds(element)).collect(),
    }
}

fn note_filled(solver: &NetworkSolver, record: usize, filled: &mut [Option<usize>]) {
    let Some(cycles) = solver.cycles() else { return };
    for (element, filled) in filled.iter_mut().enumerate() {
        if cycles.displacement().phase(element) == Phase::Invading {
            filled.get_or_insert(record);
        }
    }
}

/// The elements that are open at the outlet.
pub(crate) fn outlet_elements(state: &NetworkState) -> Vec<usize> {
    let Some(side) = state.sides.iter().position(|&side| side == Side::Outlet) else { return Vec::new() };
    let [min, max] = state.domain_m.map(Vec2::from);
    let (axis, at) = (side / 2, if side.is_multiple_of(2) { min[side / 2] } else { max[side / 2] });
    // Openings lie on the side, within rounding errors.
    let same = 1e-9 * (max - min).max();
    let lies_there = |curve: &Curve| match curve {
        Curve::Segment { a, b } => (a[axis] - at).abs() < same && (b[axis] - at).abs() < same,
        Curve::Arc { .. } => false,
    };
    let is_open = |element: &usize| NetworkState::curves(&state.elements[*element].boundary).iter().any(lies_there);
    (0..state.elements.len()).filter(is_open).collect()
}
