//! One avalanche of a slow displacement: the events triggered by one rise of the pressure, and the pressures around it.
//!
//! A direct simulation that starts at rest before it, at a slightly higher pressure, shows its dynamics.

use serde::Serialize;

use super::compare::outlet_elements;
use super::setup::SetupError;
use meniscus_case::{Case, FluidPhase, Model};
use meniscus_core::solver::{Solver, SolverError};
use meniscus_network::displacement::{EventKind, Phase};
use meniscus_network::solver::NetworkSolver;
use meniscus_network::state;

/// Name of the text of a network's final state.
const AT_END: &str = "at-end.json";

/// Selects an avalanche: the one with the first such event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// The invading phase reaches the outlet.
    Breakthrough,
    /// Two menisci meet.
    Overlap,
    /// The invading phase enters the pore with this number.
    Pore(usize),
}

/// A displacement in which the avalanche cannot be found.
#[derive(Debug, thiserror::Error)]
pub(crate) enum AvalancheError {
    /// The case is not a slow displacement in a network.
    #[error("the first case has no slow displacement in a network; give [network] an inlet, and no [network.dynamic]")]
    NoNetwork,
    /// There is no such event.
    #[error(
        "no event of the displacement does this; the network has {pores} pores, numbered from 0, and the table events.csv of a run lists its events"
    )]
    NoEvent {
        /// Number of pores.
        pores: usize,
    },
    /// The requested event has happened before the first one.
    #[error("this holds from the start, without an event; choose a later one")]
    FromTheBeginning,
    /// The case cannot be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The network failed.
    #[error(transparent)]
    Solver(#[from] SolverError),
}

/// An avalanche of the first half cycle.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Avalanche {
    /// The phase that invades.
    pub(crate) invading: FluidPhase,
    /// Capillary pressure p_n - p_w in Pa at which it begins.
    pub(crate) pressure_pa: f64,
    /// A pressure at which the menisci are at rest before it, in Pa.
    pub(crate) rest_pressure_pa: f64,
    /// Tension times the magnitude of the in-plane curvature then, in Pa: with a depth, less than the pressure.
    #[serde(skip)]
    pub(crate) in_plane_pa: f64,
    /// Saturation of the wetting phase before and after it.
    pub(crate) saturation: [f64; 2],
    /// Number of its events.
    pub(crate) events: usize,
    /// Number of the inlet's side: left, right, bottom, top are 0 to 3.
    pub(crate) inlet: usize,
}

/// Finds an avalanche.
pub(crate) fn find(case: &Case, wanted: Wanted) -> Result<Avalanche, AvalancheError> {
    let Model::Network(network) = &case.model else { return Err(AvalancheError::NoNetwork) };
    if network.is_dynamic() {
        return Err(AvalancheError::NoNetwork);
    }
    let mut solver = meniscus_network::setup::build_quasi_static(case, network).map_err(SetupError::from)?;
    let cycles = solver.cycles().ok_or(AvalancheError::NoNetwork)?;
    let state = state::state(solver.config(), cycles.half_cycles(), &cycles.moment());
    let outlet = outlet_elements(&state);
    let before = cycles.saturation();
    if is_so(&solver, wanted, &outlet) {
        return Err(AvalancheError::FromTheBeginning);
    }
    let mut target = None;
    while !solver.is_done() {
        solver.step(f64::INFINITY)?;
        let Some(cycles) = solver.cycles().filter(|cycles| cycles.half_cycle_index() == 0) else { break };
        if target.is_none() && is_so(&solver, wanted, &outlet) {
            target = cycles.history().len().checked_sub(1);
        }
    }
    let (Some(target), Some(cycles)) = (target, solver.cycles()) else {
        return Err(AvalancheError::NoEvent { pores: solver.config().pores.main_region.len() });
    };
    let history: Vec<_> = cycles.history().iter().filter(|entry| entry.half_cycle == 0).collect();
    let applied = history[target].applied;
    let first = history.iter().position(|entry| entry.applied == applied).unwrap_or(target);
    let events = history[first..].iter().take_while(|entry| entry.applied == applied).count();
    let tension = solver.config().tension.ok_or(AvalancheError::NoNetwork)?;
    let earlier = first.checked_sub(1).map(|index| history[index]);
    let direction = if state.invading == FluidPhase::NonWetting { 1.0 } else { -1.0 };
    let at_rest = earlier.map_or(applied - direction * applied.abs(), |entry| 0.5 * (entry.applied + applied));
    Ok(Avalanche {
        invading: state.invading,
        pressure_pa: solver.config().pressure(state.invading, applied),
        rest_pressure_pa: solver.config().pressure(state.invading, at_rest),
        in_plane_pa: tension * applied.abs(),
        saturation: [earlier.map_or(before, |entry| entry.saturation), history[first + events - 1].saturation],
        events,
        inlet: solver.config().inlet.ok_or(AvalancheError::NoNetwork)?,
    })
}

/// The text of the final state of a displacement.
pub(crate) fn state_at_end(case: &Case) -> Result<String, AvalancheError> {
    let mut solver = super::setup::build(&case.with_all_results())?;
    while !solver.is_done() {
        solver.step(f64::INFINITY)?;
    }
    let documents = solver.results().documents;
    documents.iter().find(|one| one.name == AT_END).map(|one| one.text()).ok_or(AvalancheError::NoNetwork)
}

/// Whether the requested event has happened.
fn is_so(solver: &NetworkSolver, wanted: Wanted, outlet: &[usize]) -> bool {
    let Some(cycles) = solver.cycles() else { return false };
    let displacement = &cycles.displacement;
    let has = |element: usize| displacement.phase(element) == Phase::Invading;
    match wanted {
        Wanted::Breakthrough => outlet.iter().any(|&element| has(element)),
        Wanted::Overlap => cycles.history().iter().any(|entry| entry.kind == EventKind::Overlap),
        Wanted::Pore(pore) => (0..displacement.elements().len()).any(|element| {
            has(element) && solver.config().pores.pore_of[displacement.elements()[element].region] == pore
        }),
    }
}
