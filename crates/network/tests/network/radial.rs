//! A disc as the inlet: displacement from a hole outwards.

use std::f64::consts::PI;
use std::sync::Arc;

use meniscus_case::network::InletDisc;
use meniscus_geometry::spec::ShapeSpec;
use meniscus_network::displacement::{Conditions, Displacement, Event, EventKind, OpenDisc, Phase};
use meniscus_network::dynamic::{Drive, Dynamic, StepEnd, Terms};
use meniscus_network::extract;
use meniscus_network::graph::{Network, Pores};

use crate::scenes::{disc, grains};
use crate::support::dice::scattered_discs;

const ALL: [bool; 4] = [true; 4];

fn conditions(walls: usize, angle_deg: f64, center: [f64; 2], radius: f64) -> Conditions {
    Conditions {
        outlet: ALL,
        disc: Some(OpenDisc::inlet(InletDisc { center, radius })),
        ..Conditions::new(vec![angle_deg.to_radians(); walls])
    }
}

/// Eight equal discs of radius .5 around the center of a domain of the size 6.
fn ring() -> (Network, Pores, f64) {
    let (count, around) = (8_u32, 1.8);
    let place = |k: u32| (2.0 * PI * (f64::from(k) + 0.3) / f64::from(count)).sin_cos();
    let discs = (0..count).map(place).map(|(sin, cos)| disc(3.0 + around * cos, 3.0 + around * sin, 0.5));
    let network = extract(&grains([6.0; 2], discs.collect()), ALL).unwrap();
    let pores = Pores::merged(&network, 0.95);
    (network, pores, 2.0 * around * (PI / f64::from(count)).sin())
}

#[test]
fn all_throats_of_a_ring_are_passed_at_their_entry_pressure() {
    let (network, pores, distance) = ring();
    let deg = 40.0_f64;
    let angle = PI - deg.to_radians();
    let exact = 1.0 / (0.5 * angle.cos() + (0.25 * distance * distance - 0.25 * angle.sin().powi(2)).sqrt());
    let displacement = Displacement::new(&network, &pores, conditions(12, deg, [3.0; 2], 0.2));
    let filled = (0..displacement.elements().len()).filter(|&element| displacement.phase(element) == Phase::Invading);
    assert!((1..displacement.elements().len()).contains(&filled.count()));
    let events: Vec<Event> = displacement.collect();
    let bursts: Vec<&Event> = events.iter().filter(|event| event.kind == EventKind::Burst).collect();
    assert!(!bursts.is_empty());
    assert!((bursts[0].curvature - exact).abs() < 1e-9, "{} {exact}", bursts[0].curvature);
    assert!(events.iter().all(|event| event.applied <= exact + 1e-9));
}

#[test]
fn a_mirrored_pack_is_invaded_from_the_mirrored_hole_alike() {
    for seed in 0..6 {
        let (size, hole) = ([12.0, 9.0], [5.2, 4.1]);
        let discs = scattered_discs(seed, 4000, size, [0.35, 0.6], [0.12, 0.1]);
        let events = |flip: bool| -> Vec<f64> {
            let at = |[x, y]: [f64; 2]| if flip { [size[0] - x, y] } else { [x, y] };
            let mirrored = discs.iter().map(|it| disc(at(it.center)[0], it.center[1], it.radius));
            let shapes: Vec<ShapeSpec> = mirrored.collect();
            let walls = shapes.len() + 4;
            let network = extract(&grains(size, shapes), ALL).unwrap();
            let pores = Pores::merged(&network, 0.95);
            let conditions = Conditions { trapping: true.into(), ..conditions(walls, 50.0, at(hole), 0.7) };
            Displacement::new(&network, &pores, conditions).map(|event| event.curvature).collect()
        };
        let [one, other] = [events(false), events(true)];
        assert!(one.len() > 20 && one.len() == other.len(), "{seed}: {} {}", one.len(), other.len());
        for (a, b) in one.iter().zip(&other) {
            assert!((a - b).abs() < 1e-9 * a.abs().max(1.0), "{seed}: {a} {b}");
        }
    }
}

#[test]
fn in_time_what_enters_through_a_disc_is_what_the_pores_gain() {
    let (network, pores, distance) = ring();
    let deg = 40.0_f64;
    let (tension, rate) = (0.03, 1e-9);
    let disc = OpenDisc::inlet(InletDisc { center: [3.0; 2], radius: 0.2 });
    let terms = Terms {
        viscosity: [1e-3, 1e-3],
        tension,
        drive: Drive::Rate(rate),
        largest_step: 0.01,
        inlet: [false; 4],
        inlet_disc: Some(disc),
        outlet: ALL,
        depth: None,
        gravity: None,
    };
    let displacement = Displacement::new(&network, &pores, conditions(12, deg, [3.0; 2], 0.2));
    let mut dynamic = Dynamic::new(Arc::new(network), displacement, terms);
    let before = dynamic.invading_area();
    while dynamic.breakthrough().is_none() {
        assert_ne!(dynamic.advance(f64::INFINITY).unwrap(), StepEnd::Closed);
    }
    let gained = dynamic.invading_area() - before;
    assert!((gained - rate * dynamic.time()).abs() < 1e-9 * gained, "{gained} {}", rate * dynamic.time());
    assert!(dynamic.balance_error().abs() < 1e-12);
    // So slow that the largest pressure is the entry pressure of a throat, to rounding.
    let angle = PI - deg.to_radians();
    let exact = tension / (0.5 * angle.cos() + (0.25 * distance * distance - 0.25 * angle.sin().powi(2)).sqrt());
    let largest = dynamic.history().iter().map(|event| event.pressure).fold(f64::NEG_INFINITY, f64::max);
    assert!((largest / exact - 1.0).abs() < 1e-9, "{largest} {exact}");
}
