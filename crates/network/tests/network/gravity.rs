//! Gravity in networks: capillary pressures over height, at rest and in time, and the fronts that follow.

use std::sync::Arc;

use meniscus_case::FluidPhase;
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::interface::depth::Depth;
use meniscus_geometry::spec::{GeometrySpec, ShapeSpec, SolidSide};
use meniscus_network::displacement::{Conditions, Displacement, Event, EventKind};
use meniscus_network::dynamic::{Drive, Dynamic, StepEnd, Terms};
use meniscus_network::extract;
use meniscus_network::graph::{Network, Pores};
use meniscus_network::gravity::Gravity;

use crate::cases::{loaded, measures, to_the_end};
use crate::scenes::{TOP_BOTTOM, disc, grains};

const BOTTOM: [bool; 4] = [false, false, true, false];
const TOP: [bool; 4] = [false, false, false, true];
const LEFT: [bool; 4] = [true, false, false, false];
const RIGHT: [bool; 4] = [false, true, false, false];

/// Equal throats one above the other, between discs of radius .35 whose centers lie on both walls of a channel of width 1.
fn column(throats: usize) -> (Network, Pores) {
    let discs = (0..throats).flat_map(|k| [0.0, 1.0].map(|x| disc(x, k as f64 + 0.5, 0.35)));
    let geometry = grains([1.0, throats as f64], discs.collect()).with_wall_sides([true, true, false, false]);
    let network = extract(&geometry, TOP_BOTTOM).unwrap();
    let pores = Pores::merged(&network, 0.95);
    (network, pores)
}

fn gravity(gradient: [f64; 2], reference: [f64; 2], invading: FluidPhase, depth: Option<Depth>) -> Gravity {
    Gravity { gradient: gradient.into(), reference: reference.into(), invading, depth }
}

fn upwards(shapes: usize, angle: f64, gravity: Option<Gravity>) -> Conditions {
    Conditions {
        inlet: BOTTOM,
        outlet: TOP,
        trapping: true.into(),
        gravity,
        ..Conditions::new(vec![angle; shapes + 4])
    }
}

/// In the plane, between plates with and without corner films, for both invading phases.
#[test]
fn the_pressures_of_equal_throats_differ_by_their_head() {
    let (network, pores) = column(6);
    let depths = [None, Some(Depth::new(0.5, 1.2, [1.2; 2])), Some(Depth::new(0.5, 0.3, [0.3; 2]))];
    for depth in depths {
        for invading in [FluidPhase::NonWetting, FluidPhase::Wetting] {
            let sign = if invading == FluidPhase::NonWetting { 1.0 } else { -1.0 };
            let total = |plane: f64| depth.map_or(plane, |depth| sign * depth.curvature(sign * plane));
            for fall in [0.4, -0.4] {
                let gravity = gravity([0.0, sign * fall], [0.5, 0.0], invading, depth);
                let conditions = upwards(12, 0.3, Some(gravity));
                let events: Vec<Event> = Displacement::new(&network, &pores, conditions)
                    .filter(|event| event.throat.is_some() && event.kind == EventKind::Burst)
                    .collect();
                assert_eq!(events.len(), 6);
                let own = events[0].curvature;
                for (k, event) in events.iter().enumerate() {
                    assert!((event.curvature - own).abs() < 1e-12 * own, "{event:?}");
                    // Downwards the head rises along the way: the first throat holds the front back, and the others follow at its pressure.
                    let height = if fall < 0.0 { k as f64 + 0.5 } else { 0.5 };
                    let exact = total(own) - fall * height;
                    let found = total(event.applied);
                    assert!(
                        (found - exact).abs() < 1e-12 * exact.abs(),
                        "{depth:?} {invading:?} {fall} {k}: {found} {exact}"
                    );
                }
            }
        }
    }
}

/// A chamber with a wide throat at the height `high` and a narrow one below it, both to the right.
fn two_throats(high: f64) -> (Network, Pores) {
    let posts =
        [disc(2.0, 0.0, 0.8), disc(2.0, 1.9, 0.8), disc(2.0, high + 1.0, high - 1.5), disc(2.0, 2.0 * high + 0.8, 0.8)];
    let geometry = grains([4.0, 2.0 * high + 0.8], posts.to_vec()).with_wall_sides([false, false, true, true]);
    let network = extract(&geometry, [true, true, false, false]).unwrap();
    let pores = Pores::merged(&network, 0.95);
    (network, pores)
}

#[test]
fn two_throats_change_their_order_at_the_head_of_their_difference() {
    let (network, pores) = two_throats(4.0);
    let conditions = |gradient: f64| Conditions {
        inlet: LEFT,
        outlet: RIGHT,
        gravity: Some(gravity([0.0, gradient], [0.0; 2], FluidPhase::NonWetting, None)),
        ..Conditions::new(vec![0.0; 8])
    };
    let first = |gradient: f64| {
        let mut events = Displacement::new(&network, &pores, conditions(gradient));
        events.find(|event| event.throat.is_some()).and_then(|event| event.throat).unwrap()
    };
    let entries =
        Displacement::new(&network, &pores, conditions(0.0)).entry_curvatures(&conditions(0.0), network.throats.len());
    let mut order: Vec<usize> = (0..network.throats.len()).filter(|&k| entries[k].is_finite()).collect();
    order.sort_by(|&a, &b| entries[a].total_cmp(&entries[b]));
    let [wide, next] = [order[0], order[1]];
    let height = |throat: usize| network.throats[throat].middle().y;
    // The head that makes up for the difference of the entry curvatures.
    let equal = (entries[next] - entries[wide]) / (height(next) - height(wide));
    assert_eq!(first(0.0), wide);
    assert_eq!(first(equal * (1.0 - 1e-6)), wide);
    assert_eq!(first(equal * (1.0 + 1e-6)), next);
}

/// Menisci at rest have the applied curvature and the head of their throat; so have those around what is trapped.
#[test]
fn in_time_a_slow_front_takes_the_pressures_of_rest() {
    let (network, pores) = column(6);
    let (network, tension, own) = (Arc::new(network), 0.03, 1.0);
    for fall in [0.4, -0.4, 0.0] {
        let gravity = gravity([0.0, fall], [0.5, 0.0], FluidPhase::NonWetting, None);
        let at_rest: Vec<Event> = Displacement::new(&network, &pores, upwards(12, 0.3, Some(gravity))).collect();
        let terms = Terms {
            viscosity: [1e-3; 2],
            tension,
            drive: Drive::Rate(1e-6 * tension / 1e-3),
            largest_step: 1e-3,
            inlet: BOTTOM,
            inlet_disc: None,
            outlet: TOP,
            depth: None,
            gravity: Some(gravity),
        };
        let conditions = Conditions { trapping: false.into(), ..upwards(12, 0.3, None) };
        let start = Displacement::new(&network, &pores, conditions);
        let mut dynamic = Dynamic::new(Arc::clone(&network), start, terms);
        while dynamic.breakthrough().is_none() {
            assert_ne!(dynamic.advance(f64::INFINITY).unwrap(), StepEnd::Closed);
        }
        let bursts = |throat: Option<usize>| throat.is_some();
        let slow: Vec<_> = dynamic.history().iter().filter(|event| bursts(event.throat)).collect();
        let rest: Vec<&Event> = at_rest.iter().filter(|event| bursts(event.throat)).collect();
        assert_eq!(slow.len(), rest.len());
        let mut largest = f64::NEG_INFINITY;
        for (slow, rest) in slow.iter().zip(&rest) {
            assert_eq!(slow.throat, rest.throat);
            largest = largest.max(slow.pressure / tension);
            assert!((largest - rest.applied).abs() < 2e-3 * own, "{fall}: {largest} {}", rest.applied);
        }
    }
}

/// Discs at random places in a column between walls.
fn pack(seed: u64, size: [f64; 2]) -> (Network, Pores, usize) {
    let discs = crate::support::dice::scattered_discs(seed, 20_000, size, [0.3, 0.5], [0.1, 0.4]);
    let shapes: Vec<ShapeSpec> = discs.into_iter().map(ShapeSpec::Disc).collect();
    let walls = shapes.len();
    let spec = GeometrySpec { min: [0.0; 2], max: size, solid: SolidSide::Inside, shapes };
    let geometry = Geometry::new(&spec).unwrap().with_wall_sides([true, true, false, false]);
    let network = extract(&geometry, TOP_BOTTOM).unwrap();
    let pores = Pores::merged(&network, 0.95);
    (network, pores, walls)
}

/// Upside down with gravity reversed and the sides exchanged, all pressures at the inlet are the same.
#[test]
fn a_front_that_falls_is_one_that_rises_upside_down() {
    let (network, pores, shapes) = pack(3, [12.0, 16.0]);
    let up = gravity([0.0, -1.0], [6.0, 0.0], FluidPhase::NonWetting, None);
    let down = gravity([0.0, -1.0], [6.0, 16.0], FluidPhase::NonWetting, None);
    let saturation = |conditions: Conditions| {
        let mut state = Displacement::new(&network, &pores, conditions);
        while !state.reached_outlet() && state.next().is_some() {}
        let areas = state.elements().iter().enumerate();
        let invaded = areas.filter(|(k, _)| state.phase(*k) == meniscus_network::displacement::Phase::Invading);
        invaded.map(|(_, element)| element.area).sum::<f64>() / 192.0
    };
    let stable = saturation(upwards(shapes, 0.0, Some(up)));
    let unstable = saturation(Conditions { inlet: TOP, outlet: BOTTOM, ..upwards(shapes, 0.0, Some(down)) });
    let without = saturation(upwards(shapes, 0.0, None));
    assert!(stable > 1.5 * without && unstable < without, "{stable} {without} {unstable}");
    // The reference only shifts the pressures.
    let shifted = Gravity { reference: Vec2::new(-3.0, 5.0), ..up };
    let applied = |gravity: Gravity| -> Vec<f64> {
        Displacement::new(&network, &pores, upwards(shapes, 0.0, Some(gravity))).map(|event| event.applied).collect()
    };
    let (one, other) = (applied(up), applied(shifted));
    assert_eq!(one.len(), other.len());
    assert!(one.iter().zip(&other).all(|(one, other)| (one - 5.0 - other).abs() < 1e-9));
}

const GANGLION: &str = r#"format = 1
title = "A ganglion between two throats"
[geometry]
min = [0.0, 0.0]
max = [2.2e-3, 4.0e-3]
shapes = [
  { disc = { center = [1.0e-3, 0.0], radius = 3.0e-4 } },
  { disc = { center = [1.0e-3, 4.0e-3], radius = 3.0e-4 } },
  { capsule = { ends = [[1.0e-3, 1.0e-3], [1.0e-3, 3.0e-3]], radius = 3.0e-4 } },
  { rectangle = { center = [1.65e-3, 1.25e-4], size = [1.1e-3, 2.5e-4] } },
  { rectangle = { center = [1.65e-3, 3.875e-3], size = [1.1e-3, 2.5e-4] } },
]
[network]
inlet = "bottom"
outlet = "top"
[network.phases.wetting]
density = 1000.0
viscosity = 1.0e-3
[network.phases.non-wetting]
density = 1.0
viscosity = 1.0e-5
[network.interface]
tension = 0.05
[network.wetting.young]
contact-angle-deg = 0.0
"#;

/// What is trapped below right has a slit of .9 mm at its top, 1.5 mm above a throat at its side. Air enters the slit from 2/.9 per mm on, and water leaves the
/// throat, between discs that end at their widest place at the edge of the domain, once its meniscus is flat.
#[test]
fn a_trapped_ganglion_would_move_where_its_head_exceeds_what_its_throats_hold() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.toml");
    std::fs::write(&path, GANGLION).unwrap();
    let (tension, difference) = (0.05, 999.0);
    let exact = 2.0 / 9e-4 / 1.5e-3 * tension / difference;
    for (share, moves) in [(0.5, false), (0.9995, false), (1.0005, true), (1.5, true)] {
        let found =
            measures(to_the_end(&loaded(&path, &[&format!("network.gravity=[0.0, {}]", -share * exact)])).as_ref());
        let (trapped, movable) = (found["trapped-saturation"], found["movable-trapped-saturation"]);
        assert!(trapped > 0.2);
        assert_eq!(movable, if moves { trapped } else { 0.0 }, "{share}");
    }
}
