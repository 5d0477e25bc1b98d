//! Construction of the network and the displacement of a validated case.

use std::sync::Arc;

use super::angles::{angles, depth_for, film_terms};
use super::cycles::{Cycles, End, FluidPhase, HalfCycle};
use super::displacement::{Beginning, Conditions, CornerFilms, Displacement, Element, Events, MeasuredBurst};
use super::dynamic::solver::DynamicSolver;
use super::dynamic::{self, Drive, Dynamic, Terms};
use super::graph::Network;
pub(crate) use super::ground::{Ground, geometry};
use super::model::Configuration;
use super::region::{Counted, porosity};
pub use super::setup_error::SetupError;
use super::solver::NetworkSolver;
use super::state;
use crate::case::network::measured::MeasuredThroat;
use crate::case::network::state::{ElementState, Start};
use crate::case::network::{
    DynamicDrive, NetworkDisplacement, NetworkInterface, PoreNetwork, Process, Region, Stop, Trapping,
};
use crate::case::{Case, SIDES, Side};
use crate::solver::Solver;

/// The solver of a case in its initial state.
pub(crate) fn build(case: &Case, wanted: &PoreNetwork) -> Result<Box<dyn Solver>, SetupError> {
    let quasi_static = build_quasi_static(case, wanted)?;
    Ok(match in_time(wanted, &quasi_static)? {
        Some((dynamic, invading, end)) => Box::new(DynamicSolver::new(quasi_static, dynamic, invading, end)),
        None => Box::new(quasi_static),
    })
}

/// The solver of a dynamic displacement in its initial state; `None` if the case has none.
pub(crate) fn build_in_time(case: &Case, wanted: &PoreNetwork) -> Result<Option<DynamicSolver>, SetupError> {
    let quasi_static = build_quasi_static(case, wanted)?;
    let found = in_time(wanted, &quasi_static)?;
    Ok(found.map(|(dynamic, invading, end)| DynamicSolver::new(quasi_static, dynamic, invading, end)))
}

/// The solver of a quasi-static displacement; without a displacement if the case has a dynamic one.
pub fn build_quasi_static(case: &Case, wanted: &PoreNetwork) -> Result<NetworkSolver, SetupError> {
    build_on(&Ground::of(case, wanted)?, wanted, case.depth)
}

/// The same on a given ground, that of a case of the same geometry, sides and persistence ratio, at the depth in m of the case.
pub(crate) fn build_on(ground: &Ground, wanted: &PoreNetwork, depth: Option<f64>) -> Result<NetworkSolver, SetupError> {
    let network = ground.with_depth(depth);
    let initial = match wanted.displacement.as_ref().and_then(|displacement| displacement.initial.as_ref()) {
        Some(start) => Some(Arc::new(beginning(start, wanted, ground, &network)?)),
        None => None,
    };
    let solver = assemble(wanted, ground, network, initial).timed(ground.seconds);
    if let Some(region) = wanted.region.filter(|_| solver.cycles().is_some_and(|cycles| !(cycles.counted().sum > 0.0)))
    {
        return Err(SetupError::EmptyRegion { min: region.min, max: region.max });
    }
    let found = &solver.config().geometry_hash;
    match wanted.measured.as_ref().map(|measured| &measured.geometry_hash) {
        Some(expected) if expected != found => {
            Err(SetupError::OtherGeometry { expected: expected.clone(), found: found.clone() })
        }
        _ => Ok(solver),
    }
}

/// The measured bursts of a case.
fn measured(wanted: &PoreNetwork) -> Vec<MeasuredBurst> {
    let burst = |one: &MeasuredThroat| MeasuredBurst {
        throat: one.index,
        formula: one.formula_curvature,
        curvature: one.entry_curvature,
    };
    wanted.measured.iter().flat_map(|measured| &measured.throats).map(burst).collect()
}

/// The phases of a saved state for the first half cycle.
fn beginning(start: &Start, wanted: &PoreNetwork, ground: &Ground, network: &Network) -> Result<Beginning, SetupError> {
    let (walls, pores) = (ground.walls(), &ground.pores);
    let half = match (&wanted.displacement, &wanted.interface) {
        (Some(displacement), Some(interface)) => {
            half_cycles(displacement, interface, wanted.sides.each(), (walls, network, &measured(wanted)))
        }
        _ => Vec::new(),
    };
    let Some(first) = half.into_iter().next() else { return Err(SetupError::NoPore) };
    let fresh = Displacement::new(network, pores, first.conditions);
    let elements = fresh.elements();
    let other = |why| SetupError::OtherState {
        file: start.file.clone(),
        found: start.state.elements.len(),
        expected: elements.len(),
        why,
    };
    if start.state.elements.len() != elements.len() {
        return Err(other("it was written with other network.events or another persistence ratio"));
    }
    // Rounding of areas by writing and reading.
    const SAME: f64 = 1e-9;
    let is_same =
        |(state, element): (&ElementState, &Element)| (state.area_m2 - element.area).abs() <= SAME * element.area;
    if !start.state.elements.iter().zip(elements).all(is_same) {
        return Err(other("their areas differ"));
    }
    Ok(state::beginning(&start.state, first.invading))
}

/// The solver of a given network; `initial` are the initial phases of its displacement.
fn assemble(
    wanted: &PoreNetwork,
    ground: &Ground,
    network: Arc<Network>,
    initial: Option<Arc<Beginning>>,
) -> NetworkSolver {
    let (walls, pores) = (ground.walls(), Arc::clone(&ground.pores));
    let half_cycles = match (&wanted.displacement, &wanted.interface) {
        (Some(displacement), Some(interface)) if displacement.dynamic.is_none() => {
            half_cycles(displacement, interface, wanted.sides.each(), (walls, &network, &measured(wanted)))
        }
        _ => Vec::new(),
    };
    let entry = wanted.interface.as_ref().map(|interface| Conditions {
        angle: angles(interface, walls, FluidPhase::NonWetting),
        inlet: [false; 4],
        outlet: [false; 4],
        trapping: Trapping::None,
        events: Events::All,
        largest_curvature: f64::INFINITY,
        measured: measured(wanted),
        films: CornerFilms::Absent,
    });
    let division = half_cycles.first().and_then(|half| ground.division(half.conditions.events));
    let mut config = Configuration {
        network: Arc::clone(&network),
        pores: Arc::clone(&pores),
        bounds: ground.geometry.bounds(),
        periodic: ground.geometry.periodic(),
        inlet: wanted.sides.each().iter().position(|&side| side == Side::Inlet),
        outlet: wanted.sides.each().iter().position(|&side| side == Side::Outlet),
        outline: Arc::clone(&ground.outline),
        porosity: network.regions.iter().map(|region| region.area).sum::<f64>() / ground.geometry.bounds().area(),
        tension: wanted.interface.as_ref().map(|interface| interface.tension),
        depth: network.depth.zip(wanted.interface.as_ref()).map(|(depth, interface)| {
            [FluidPhase::NonWetting, FluidPhase::Wetting].map(|invading| depth_for(invading, depth, interface))
        }),
        viscosities: [wanted.wetting, wanted.non_wetting].map(|fluid| fluid.map(|fluid| fluid.viscosity)),
        entry,
        geometry_hash: ground.hash.clone(),
        sides: wanted.sides.each(),
        region: wanted.region.map(Region::bounds),
    };
    let counted = |displacement: &Displacement| match config.region {
        Some(region) => Counted::within(displacement, region, config.periods()),
        None => Counted::everywhere(displacement),
    };
    let cycles = Cycles::new(Arc::clone(&network), pores, half_cycles, (initial, division), counted);
    if let Some(region) = config.region {
        config.porosity = porosity(&network, region, config.periods());
    }
    NetworkSolver::new(config, cycles)
}

/// A dynamic displacement with the invading phase and its end.
pub(crate) type InTime = (Dynamic, FluidPhase, dynamic::solver::End);

/// The dynamic displacement of a case.
pub(crate) fn in_time(wanted: &PoreNetwork, quasi_static: &NetworkSolver) -> Result<Option<InTime>, SetupError> {
    let Some((displacement, interface, driven, viscosities)) = asked_in_time(wanted) else { return Ok(None) };
    let config = quasi_static.config();
    let invading =
        if displacement.process == Process::Imbibition { FluidPhase::Wetting } else { FluidPhase::NonWetting };
    let [wetting, non_wetting] = viscosities;
    let sides = wanted.sides.each();
    let [inlet, outlet] = [Side::Inlet, Side::Outlet].map(|kind| sides.map(|side| side == kind));
    let walls = config.entry.as_ref().map_or(SIDES.len(), |entry| entry.angle.len());
    let conditions = Conditions {
        angle: angles(interface, walls, invading),
        // Pores at the inlet that are not full initially are displaced like others.
        inlet: if driven.initial_saturation.is_some() { [false; 4] } else { inlet },
        outlet,
        trapping: Trapping::None,
        events: Events::All,
        largest_curvature: f64::INFINITY,
        measured: Vec::new(),
        films: CornerFilms::Absent,
    };
    let terms = Terms {
        viscosity: if invading == FluidPhase::Wetting { [wetting, non_wetting] } else { [non_wetting, wetting] },
        tension: interface.tension,
        drive: match driven.drive {
            Drive::Rate(rate) => Drive::Rate(rate / config.thickness()),
            pressure @ Drive::PressureDrop(_) => pressure,
        },
        largest_step: driven.largest_step,
        inlet,
        outlet,
        depth: config.depth_for(invading).map(|depth| (invading, depth)),
    };
    let start = Displacement::new(&config.network, &config.pores, conditions);
    let end = dynamic::solver::End {
        at_breakthrough: displacement.stop.breakthrough,
        at_saturation: displacement.stop.saturation.map(|wetting| match invading {
            FluidPhase::Wetting => wetting,
            FluidPhase::NonWetting => 1.0 - wetting,
        }),
        at_injected: displacement.stop.injected,
    };
    let mut dynamic = Dynamic::new(Arc::clone(&config.network), start, terms);
    if let Some(wetting) = driven.initial_saturation {
        let asked = if invading == FluidPhase::Wetting { wetting } else { 1.0 - wetting };
        dynamic = dynamic.beginning_with(asked).map_err(|found| SetupError::InletTooSmall { asked, found })?;
    }
    Ok(Some((dynamic, invading, end)))
}

/// Parameters of a dynamic displacement: fluids, drive, viscosities in Pa s of the wetting and the non-wetting phase.
fn asked_in_time(wanted: &PoreNetwork) -> Option<(&NetworkDisplacement, &NetworkInterface, DynamicDrive, [f64; 2])> {
    let displacement = wanted.displacement.as_ref()?;
    let viscosities = [wanted.wetting?.viscosity, wanted.non_wetting?.viscosity];
    Some((displacement, wanted.interface.as_ref()?, displacement.dynamic?, viscosities))
}

fn half_cycles(
    displacement: &NetworkDisplacement,
    interface: &NetworkInterface,
    sides: [Side; 4],
    (walls, network, measured): (usize, &Network, &[MeasuredBurst]),
) -> Vec<HalfCycle> {
    let open = |kind: Side| sides.map(|side| side == kind);
    let half = |invading: FluidPhase, [from, to]: [Side; 2], stop: Stop| {
        let sign = if invading == FluidPhase::NonWetting { 1.0 } else { -1.0 };
        let in_plane = |pressure: f64| {
            let curvature = pressure / interface.tension;
            network.depth.map_or(curvature, |depth| depth_for(invading, depth, interface).plane(curvature))
        };
        let depth = network.depth.filter(|_| displacement.films);
        let films = depth.map(|depth| film_terms(invading, depth, interface, walls));
        HalfCycle {
            invading,
            conditions: Conditions {
                angle: angles(interface, walls, invading),
                inlet: open(from),
                outlet: open(to),
                trapping: displacement.trapping,
                events: displacement.events,
                largest_curvature: stop.capillary_pressure.map_or(f64::INFINITY, |pressure| sign * in_plane(pressure)),
                measured: measured.to_vec(),
                films: match &films {
                    None => CornerFilms::Absent,
                    Some(_) if invading == FluidPhase::NonWetting => CornerFilms::Drain,
                    Some(terms) => CornerFilms::Join { meeting: terms.meeting(network) },
                },
            },
            films,
            end: End {
                at_breakthrough: stop.breakthrough,
                at_saturation: stop.saturation.map(|wetting| match invading {
                    FluidPhase::Wetting => wetting,
                    FluidPhase::NonWetting => 1.0 - wetting,
                }),
            },
        }
    };
    let forwards = [Side::Inlet, Side::Outlet];
    let backwards = [Side::Outlet, Side::Inlet];
    match displacement.process {
        Process::Drainage => vec![half(FluidPhase::NonWetting, forwards, displacement.stop)],
        Process::Imbibition => vec![half(FluidPhase::Wetting, forwards, displacement.stop)],
        Process::Cycle(cycles) => (0..cycles)
            .flat_map(|_| {
                [
                    half(FluidPhase::NonWetting, forwards, displacement.stop),
                    half(FluidPhase::Wetting, backwards, Stop::default()),
                ]
            })
            .collect(),
    }
}
