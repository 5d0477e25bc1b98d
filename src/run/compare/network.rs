//! The network of a comparison, from event to event.

use super::comparison::Side;
use super::pair::CompareError;
use super::track::{Grid, Record, Track};
use crate::run::setup::SetupError;
use meniscus_case::network::PoreNetwork;
use meniscus_case::network::state::NetworkState;
use meniscus_case::{self, Case};
use meniscus_core::math::Vec2;
use meniscus_core::solver::{Series, Solver};
use meniscus_geometry::curve::Curve;
use meniscus_network::displacement::Phase;
use meniscus_network::setup;
use meniscus_network::solver::NetworkSolver;
use meniscus_network::state;

/// The present state; `None` if there is no displacement.
pub(crate) fn state(solver: &NetworkSolver) -> Option<NetworkState> {
    let cycles = solver.cycles()?;
    Some(state::state(solver.config(), cycles.half_cycles(), &cycles.moment()))
}

/// Runs the first half cycle.
pub(crate) fn track(solver: &mut NetworkSolver, grid: &Grid) -> Result<Track, CompareError> {
    let mut track = Track::default();
    while let Some(cycles) = solver.cycles().filter(|cycles| cycles.half_cycle_index() == 0) {
        if cycles.history().len() + 1 > track.records.len() {
            let displacement = &cycles.displacement;
            let holds = |element: usize| displacement.phase(element) == Phase::Invading;
            let pressure = |applied| solver.config().pressure(cycles.half_cycle().invading, applied);
            let record = Record {
                time: f64::NAN,
                saturation: cycles.saturation(),
                pressure: cycles.applied().map_or(f64::NAN, pressure),
                invaded: grid.in_filled(holds),
            };
            track.filled.resize(displacement.elements().len(), None);
            track.add(record, holds);
        }
        if solver.is_done() {
            break;
        }
        solver.step(f64::INFINITY)?;
    }
    Ok(Track { totals: totals(solver), ..track })
}

/// The cost of a network, its permeability and its warnings.
fn totals(solver: &dyn Solver) -> Side {
    let statistics = solver.statistics();
    let wall_time_s = statistics.parts.iter().map(|part| part.seconds).sum();
    let measures = solver.measures(&Series::default());
    let permeability = measures.iter().find(|it| it.name == "permeability-x-m2").map(|it| it.value);
    Side {
        wall_time_s,
        // It runs in a single thread.
        processor_time_s: Some(wall_time_s),
        unknowns: statistics.unknowns,
        steps: statistics.steps,
        permeability_m2: permeability.filter(|value| value.is_finite()),
        warnings: solver.warnings(&Series::default()),
        ..Side::default()
    }
}

/// Runs a displacement in time with `records` states until the time `end` in s, or to its own end.
pub(crate) fn track_in_time(
    case: &Case,
    wanted: &PoreNetwork,
    grid: &Grid,
    end: f64,
    records: usize,
) -> Result<Track, CompareError> {
    let solver = setup::build_in_time(case, wanted).map_err(SetupError::from)?;
    let mut solver = solver.ok_or(CompareError::NoNetwork)?;
    let mut track = Track { filled: vec![None; solver.elements().len()], ..Track::default() };
    for number in 0..=records {
        let until = end * number as f64 / records as f64;
        while !solver.is_done() && solver.time() < until {
            solver.step(until)?;
        }
        let sample = solver.sample();
        let value = |name: &str| sample.iter().find(|it| it.name == name).map_or(f64::NAN, |it| it.value);
        let shares: Vec<f64> = solver.shares().collect();
        let record = Record {
            time: solver.time(),
            saturation: value("saturation"),
            // There is no flow yet at the start.
            pressure: if solver.steps() > 0 { value("pressure_difference_Pa") } else { f64::NAN },
            invaded: grid.in_filled(|element| shares[element] > 0.5),
        };
        track.add(record, |element| shares[element] > 0.5);
        if number > 0 && solver.is_done() {
            break;
        }
    }
    let breakthrough = solver.breakthrough().map(|it| [it.time, it.saturation]);
    Ok(Track { breakthrough, totals: totals(&solver), ..track })
}

/// The elements that are open at the outlet.
pub(crate) fn outlet_elements(state: &NetworkState) -> Vec<usize> {
    let Some(side) = state.sides.iter().position(|&side| side == meniscus_case::Side::Outlet) else {
        return Vec::new();
    };
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
