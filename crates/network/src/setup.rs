//! Construction of the network and the displacement of a validated case.

use std::sync::Arc;

use super::angles::{angles, depth_for, film_terms};
use super::cycles::{Cycles, FluidPhase, HalfCycle};
use super::displacement::{Beginning, Conditions, Displacement, Element, MeasuredBurst, OpenDisc};
use super::dynamic::solver::DynamicSolver;
use super::dynamic::{Drive, Dynamic, Terms};
use super::graph::Network;
use super::gravity::Gravity;
pub use super::ground::{Ground, geometry};
use super::model::Configuration;
use super::region::{Counted, porosity};
pub use super::setup_error::SetupError;
use super::solver::NetworkSolver;
use super::state;
use meniscus_case::network::measured::MeasuredThroat;
use meniscus_case::network::state::{ElementState, Start};
use meniscus_case::network::{
    DynamicDrive, FilmModel, NetworkDisplacement, NetworkInterface, PoreNetwork, Process, Region, Stop,
};
use meniscus_case::{Case, SIDES, Side};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_core::solver::Solver;
use meniscus_geometry::interface::films::WallFilms;

/// The solver of a case in its initial state.
pub fn build(case: &Case, wanted: &PoreNetwork) -> Result<Box<dyn Solver>, SetupError> {
    let quasi_static = build_quasi_static(case, wanted)?;
    Ok(match in_time(wanted, &quasi_static)? {
        Some(solver) => Box::new(solver),
        None => Box::new(quasi_static),
    })
}

/// The solver of a dynamic displacement in its initial state; `None` if the case has none.
pub fn build_in_time(case: &Case, wanted: &PoreNetwork) -> Result<Option<DynamicSolver>, SetupError> {
    in_time(wanted, &build_quasi_static(case, wanted)?)
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
    if let Some(region) = solver
        .config()
        .region
        .and(wanted.region)
        .filter(|_| solver.cycles().is_some_and(|cycles| !(cycles.counted.sum > 0.0)))
    {
        return Err(SetupError::EmptyRegion { min: region.min, max: region.max });
    }
    if let Some(disc) = wanted.inlet_disc.filter(|_| solver.config().inlet_regions.is_empty()) {
        return Err(SetupError::NoPoreUnderDisc { center: disc.center, radius: disc.radius });
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
    let half_cycles = half_cycles(wanted, ground, network);
    let Some(first) = half_cycles.into_iter().next() else { return Err(SetupError::NoPore) };
    let fresh = Displacement::new(network, &ground.pores, first.conditions);
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
    let half_cycles = if wanted.is_dynamic() { Vec::new() } else { half_cycles(wanted, ground, &network) };
    let entry = wanted.interface.as_ref().map(|interface| Conditions {
        measured: measured(wanted),
        ..Conditions::new(angles(interface, walls, FluidPhase::NonWetting))
    });
    let division = half_cycles.first().and_then(|half| ground.division(half.conditions.events));
    let mut config = Configuration {
        network: Arc::clone(&network),
        pores: Arc::clone(&pores),
        bounds: ground.geometry.bounds(),
        periodic: ground.geometry.periodic(),
        inlet: wanted.sides.each().iter().position(|&side| side == Side::Inlet),
        inlet_disc: wanted.inlet_disc,
        inlet_regions: wanted.inlet_disc.map_or_else(Vec::new, |disc| ground.under(&OpenDisc::inlet(disc))),
        outlet: wanted.sides.each().map(|side| side == Side::Outlet),
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
        gravity: gravity(wanted, &network, ground.geometry.bounds(), first_invading(wanted)),
        region: wanted.region.map(Region::bounds),
        results: wanted.results,
        derived: if network.depth == ground.network.depth { Arc::clone(&ground.derived) } else { Arc::default() },
    };
    let periods = config.periods();
    let given = wanted.region.is_some_and(|region| !region.is_pack);
    let region = &mut config.region;
    let counted = |displacement: &Displacement| {
        let within = region.map(|region| Counted::within(displacement, region, periods));
        within.filter(|counted| given || counted.sum > 0.0).unwrap_or_else(|| {
            *region = None;
            Counted::everywhere(displacement)
        })
    };
    let cycles = Cycles::new(&network, &pores, half_cycles, initial, division, counted);
    if let Some(region) = config.region {
        config.porosity = porosity(&network, region, config.periods());
    }
    NetworkSolver::new(config, cycles)
}

/// The solver of the dynamic displacement of a case, on the network of another one.
pub(crate) fn in_time(wanted: &PoreNetwork, quasi_static: &NetworkSolver) -> Result<Option<DynamicSolver>, SetupError> {
    let Some((displacement, interface, driven, viscosities)) = asked_in_time(wanted) else { return Ok(None) };
    let config = quasi_static.config();
    let invading = first_invading(wanted);
    let [wetting, non_wetting] = viscosities;
    let sides = wanted.sides.each();
    let [inlet, outlet] = [Side::Inlet, Side::Outlet].map(|kind| sides.map(|side| side == kind));
    let walls = config.entry.as_ref().map_or(SIDES.len(), |entry| entry.angle.len());
    let conditions = Conditions {
        // Pores at the inlet that are not full initially are displaced like others.
        inlet: if driven.initial_saturation.is_some() { [false; 4] } else { inlet },
        outlet,
        disc: wanted.inlet_disc.filter(|_| driven.initial_saturation.is_none()).map(OpenDisc::inlet),
        ..Conditions::new(angles(interface, walls, invading))
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
        inlet_disc: wanted.inlet_disc.map(OpenDisc::inlet),
        outlet,
        depth: config.depth_for(invading).map(|depth| (invading, depth)),
        gravity: config.gravity,
    };
    let start = Displacement::new(&config.network, &config.pores, conditions);
    let mut dynamic = Dynamic::new(Arc::clone(&config.network), start, terms);
    if let Some(wetting) = driven.initial_saturation {
        let asked = invading.saturation(wetting);
        dynamic = dynamic.beginning_with(asked).map_err(|found| SetupError::InletTooSmall { asked, found })?;
    }
    Ok(Some(DynamicSolver::new(quasi_static.clone(), dynamic, invading, displacement.stop)))
}

/// Parameters of a dynamic displacement: fluids, drive, viscosities in Pa s of the wetting and the non-wetting phase.
fn asked_in_time(wanted: &PoreNetwork) -> Option<(&NetworkDisplacement, &NetworkInterface, DynamicDrive, [f64; 2])> {
    let displacement = wanted.displacement.as_ref()?;
    let viscosities = [wanted.wetting?.viscosity, wanted.non_wetting?.viscosity];
    Some((displacement, wanted.interface.as_ref()?, displacement.dynamic?, viscosities))
}

/// The phase that invades first.
fn first_invading(wanted: &PoreNetwork) -> FluidPhase {
    match wanted.displacement.as_ref().map(|displacement| displacement.process) {
        Some(Process::Imbibition) => FluidPhase::Wetting,
        _ => FluidPhase::NonWetting,
    }
}

/// Gravity for invasion by a phase; the pressure is applied in the middle of the inlet.
fn gravity(wanted: &PoreNetwork, network: &Network, bounds: Bounds, invading: FluidPhase) -> Option<Gravity> {
    let (acceleration, interface) = (Vec2::from(wanted.gravity?), wanted.interface.as_ref()?);
    let difference = wanted.non_wetting?.density - wanted.wetting?.density;
    let mut reference = 0.5 * (bounds.min + bounds.max);
    if let Some(disc) = wanted.inlet_disc {
        reference = Vec2::from(disc.center);
    } else if let Some(side) = wanted.sides.each().iter().position(|&side| side == Side::Inlet) {
        let end = if side.is_multiple_of(2) { bounds.min } else { bounds.max };
        reference[side / 2] = end[side / 2];
    }
    let depth = network.depth.map(|depth| depth_for(invading, depth, interface));
    Some(Gravity { gradient: difference * acceleration / interface.tension, reference, invading, depth })
}

/// The half cycles of a case; none without a displacement.
fn half_cycles(wanted: &PoreNetwork, ground: &Ground, network: &Network) -> Vec<HalfCycle> {
    let (Some(displacement), Some(interface)) = (&wanted.displacement, &wanted.interface) else { return Vec::new() };
    let (walls, bounds) = (ground.walls(), ground.geometry.bounds());
    let open = |kind: Side| wanted.sides.each().map(|side| side == kind);
    let half = |invading: FluidPhase, [from, to]: [Side; 2], stop: Stop| {
        let sign = if invading == FluidPhase::NonWetting { 1.0 } else { -1.0 };
        let in_plane = |pressure: f64| {
            let curvature = pressure / interface.tension;
            network.depth.map_or(curvature, |depth| depth_for(invading, depth, interface).plane(curvature))
        };
        let gravity = gravity(wanted, network, bounds, invading);
        let corners = network.depth.map(|depth| film_terms(invading, depth, interface, (walls, gravity)));
        HalfCycle {
            invading,
            conditions: Conditions {
                inlet: open(from),
                outlet: open(to),
                disc: wanted.inlet_disc.map(|disc| OpenDisc { is_inlet: from == Side::Inlet, ..OpenDisc::inlet(disc) }),
                trapping: displacement.trapping,
                events: displacement.events,
                largest_curvature: stop.capillary_pressure.map_or(f64::INFINITY, |pressure| sign * in_plane(pressure)),
                measured: measured(wanted),
                gravity,
                ..Conditions::new(angles(interface, walls, invading))
            },
            stop,
            returning: angles(interface, walls, invading.other()),
            films: None,
            corners: corners.filter(|terms| terms.walls.iter().any(WallFilms::exist)),
            film_model: FilmModel::None,
        }
        .with_films(displacement.films.unwrap_or(FilmModel::None), network)
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
