//! Dynamic displacement in networks: limits that are known exactly, what is conserved, and that no step fails.

use std::sync::Arc;

use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{GeometrySpec, ShapeSpec, SolidSide};
use meniscus_network::conductance::conductances;
use meniscus_network::displacement::{Conditions, Displacement};
use meniscus_network::dynamic::{Drive, Dynamic, StepEnd, Terms};
use meniscus_network::extract;
use meniscus_network::graph::{Network, Pores};
use meniscus_network::permeability::{self, Paths, permeability};

use crate::support::dice::scattered_discs;

/// Lengths in m.
const UNIT: f64 = 1e-4;
const SIZE: [f64; 2] = [12.0 * UNIT, 9.0 * UNIT];
const TENSION: f64 = 0.03;
const LEFT: [bool; 4] = [true, false, false, false];
const RIGHT: [bool; 4] = [false, true, false, false];

/// Discs at random places between walls at the bottom and at the top.
struct Pack {
    geometry: Geometry,
    network: Arc<Network>,
    pores: Arc<Pores>,
    walls: usize,
}

impl Pack {
    fn new(seed: u64) -> Self {
        let radii = [0.35 * UNIT, 0.6 * UNIT];
        let shapes = scattered_discs(seed, 4000, SIZE, radii, [0.12 * UNIT, 0.1 * UNIT]);
        let walls = shapes.len() + 4;
        let shapes = shapes.into_iter().map(ShapeSpec::Disc).collect();
        let spec = GeometrySpec { min: [0.0; 2], max: SIZE, solid: SolidSide::Inside, shapes };
        let geometry = Geometry::new(&spec).unwrap().with_wall_sides([false, false, true, true]);
        let network = extract(&geometry, [true, true, false, false]).unwrap();
        let pores = Pores::merged(&network, 0.95);
        Self { geometry, network: Arc::new(network), pores: Arc::new(pores), walls }
    }

    fn displacement(&self, angle_deg: f64, inlet: [bool; 4], trapping: bool) -> Displacement {
        let conditions = Conditions {
            inlet,
            outlet: RIGHT,
            trapping: trapping.into(),
            ..Conditions::new(vec![angle_deg.to_radians(); self.walls])
        };
        Displacement::new(&self.network, &self.pores, conditions)
    }

    fn dynamic(&self, angle_deg: f64, viscosity: [f64; 2], drive: Drive, largest_step: f64) -> Dynamic {
        let terms = Terms {
            viscosity,
            tension: TENSION,
            drive,
            largest_step,
            inlet: LEFT,
            inlet_disc: None,
            outlet: RIGHT,
            depth: None,
            gravity: None,
        };
        Dynamic::new(Arc::clone(&self.network), self.displacement(angle_deg, LEFT, false), terms)
    }

    /// The rate in m²/s at which μ U/σ of the first viscosity is `number`.
    fn rate(number: f64, viscosity: f64) -> f64 {
        number * TENSION / viscosity * SIZE[1]
    }
}

/// What an event may be late by, as a share of an element's area.
const LATE: f64 = 1.001;

fn until_breakthrough(dynamic: &mut Dynamic) {
    while dynamic.breakthrough().is_none() {
        assert_ne!(dynamic.advance(f64::INFINITY).unwrap(), StepEnd::Closed);
    }
}

#[test]
fn one_fluid_flows_as_the_permeability_of_the_network_says() {
    for seed in 0..5 {
        let pack = Pack::new(seed);
        let (viscosity, pressure) = (2e-3, 50.0);
        let terms = Terms {
            viscosity: [viscosity; 2],
            tension: TENSION,
            drive: Drive::PressureDrop(pressure),
            largest_step: 1.0,
            inlet: LEFT,
            inlet_disc: None,
            outlet: RIGHT,
            depth: None,
            gravity: None,
        };
        // Nothing comes in where the displacement knows no inlet: all is one phase.
        let displacement = pack.displacement(40.0, [false; 4], false);
        let mut dynamic = Dynamic::new(Arc::clone(&pack.network), displacement, terms);
        dynamic.advance(1e-6).unwrap();
        let inflow = dynamic.drive_now().1;
        let paths = Paths { conductance: &conductances(&pack.network), holds: &vec![true; pack.network.regions.len()] };
        let drive = permeability::Drive::Sides(0);
        let exact = permeability(&pack.network, paths, pack.geometry.bounds(), drive).unwrap();
        let found = viscosity * inflow / SIZE[1] * SIZE[0] / pressure;
        assert!((found / exact - 1.0).abs() < 1e-8, "{seed}: {found:.6e} {exact:.6e}");
    }
}

/// [Primkulov2019]
#[test]
fn at_vanishing_rate_the_same_pores_are_invaded_as_without_time() {
    for seed in 0..4 {
        let pack = Pack::new(seed);
        for angle in [20.0, 40.0, 60.0, 90.0, 120.0] {
            let mut quasi_static = pack.displacement(angle, LEFT, true);
            let mut applied = f64::NEG_INFINITY;
            while let Some(event) = quasi_static.next() {
                applied = event.applied;
                if quasi_static.reached_outlet() {
                    break;
                }
            }
            let viscosity = [1e-3, 1e-3];
            let mut dynamic = pack.dynamic(angle, viscosity, Drive::Rate(Pack::rate(1e-9, viscosity[0])), 0.01);
            until_breakthrough(&mut dynamic);
            let pressures = dynamic.history().iter().map(|event| event.pressure).filter(|p| p.is_finite());
            let largest = pressures.fold(f64::NEG_INFINITY, f64::max);
            let elements = 0..quasi_static.elements().len();
            let both =
                elements.filter(|&e| quasi_static.phase(e) != dynamic.displacement().phase(e)).collect::<Vec<_>>();
            // Without time the pores at the outlet are filled too.
            assert!(both.len() <= 4, "seed {seed}, {angle} degrees: elements {both:?} differ");
            assert!(
                (largest - TENSION * applied).abs() < 2e-3 * TENSION * applied.abs(),
                "seed {seed}, {angle} degrees: {largest} Pa, without time {} Pa",
                TENSION * applied
            );
        }
    }
}

/// `MENISCUS_PACKS=200` tries so many.
fn packs(few: u64) -> u64 {
    std::env::var("MENISCUS_PACKS").ok().and_then(|count| count.parse().ok()).unwrap_or(few)
}

#[test]
fn what_is_trapped_without_time_is_trapped_at_a_vanishing_rate() {
    let (mut other, mut trapped) = (Vec::new(), 0);
    let count = packs(6);
    for seed in 0..count {
        let pack = Pack::new(seed);
        let angle = [20.0, 40.0, 60.0, 80.0][seed as usize % 4];
        let mut quasi_static = pack.displacement(angle, LEFT, true);
        while !quasi_static.reached_outlet() && quasi_static.next().is_some() {}
        let viscosity = [1e-3, 1e-3];
        let mut dynamic = pack.dynamic(angle, viscosity, Drive::Rate(Pack::rate(1e-9, viscosity[0])), 0.01);
        until_breakthrough(&mut dynamic);
        let elements: Vec<usize> = (0..quasi_static.elements().len()).filter(|&e| quasi_static.is_trapped(e)).collect();
        trapped += elements.len();
        let in_time = dynamic.trapped();
        let passed = |&e: &usize| !in_time[e] || dynamic.invasions()[e].is_some();
        let passed: Vec<usize> = elements.into_iter().filter(passed).collect();
        if !passed.is_empty() {
            other.push((seed, angle, passed));
        }
    }
    println!("{trapped} elements trapped in {count} packs");
    // Of events within the tolerance of a step the order may be another one: one element each in 6 of 60 packs, of 847 that are trapped.
    let (packs_off, off) = (other.len() as u64, other.iter().map(|(.., passed)| passed.len()).sum::<usize>());
    assert!(10 * packs_off <= count.max(10) && off as u64 == packs_off, "{packs_off} of {count} packs: {other:?}");
}

#[test]
fn shorter_steps_leave_the_saturation_at_breakthrough() {
    let (mut changes, mut far) = (Vec::new(), 0);
    for seed in 0..packs(8) {
        let pack = Pack::new(seed);
        let viscosity = [1e-3, 1e-3];
        let rate = Drive::Rate(Pack::rate([1e-6, 1e-5, 1e-4][seed as usize % 3], viscosity[0]));
        let element = 1.0 / pack.displacement(40.0, LEFT, false).elements().len() as f64;
        let [ruled, finer] = [0.01, 0.125 * element].map(|step| {
            let mut dynamic = pack.dynamic(40.0, viscosity, rate, step);
            until_breakthrough(&mut dynamic);
            dynamic.breakthrough().unwrap().saturation
        });
        changes.push(ruled - finer);
        // Where two menisci are about to pass their events, the order of both is open: 3 of 60 packs.
        far += usize::from((ruled - finer).abs() > 0.01);
    }
    println!("{changes:?}");
    let mean = changes.iter().sum::<f64>() / changes.len() as f64;
    assert!(mean.abs() < 0.01, "{mean}");
    assert!(20 * far <= changes.len(), "{changes:?}");
}

/// [Primkulov2019]
#[test]
fn areas_are_conserved_and_no_step_fails_over_ten_decades_of_rate() {
    for seed in 0..12 {
        let pack = Pack::new(seed);
        for (k, angle) in [0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0].into_iter().enumerate() {
            let viscosity = [[1e-5, 1e-3], [1e-3, 1e-3], [1e-1, 1e-3]][(seed as usize + k) % 3];
            let number = 10.0_f64.powi(-10 + (3 * k as i32 + 2 * seed as i32) % 11);
            let mut dynamic = pack.dynamic(angle, viscosity, Drive::Rate(Pack::rate(number, viscosity[0])), 0.01);
            let end = 1.5 * dynamic.pore_area() / Pack::rate(number, viscosity[0]);
            let mut before = dynamic.invading_area();
            while dynamic.time() < end {
                if dynamic.advance(end).unwrap() == StepEnd::Closed {
                    break;
                }
                let area = dynamic.invading_area();
                assert!(
                    area.is_finite() && area <= dynamic.pore_area() * LATE,
                    "seed {seed}, {angle} degrees, {number:e}: {}",
                    area / dynamic.pore_area()
                );
                let is_lost = dynamic.breakthrough().is_none() && area < before * (1.0 - 1e-12);
                assert!(!is_lost, "seed {seed}, {angle} degrees: area falls from {before} to {area}");
                before = area;
            }
            let error = dynamic.balance_error();
            assert!(error.abs() < 1e-10, "seed {seed}, {angle} degrees, Ca {number:e}: balance {error:e}");
            assert!(dynamic.breakthrough().is_some(), "seed {seed}, {angle} degrees, Ca {number:e}: no breakthrough");
        }
    }
}

#[test]
fn half_the_step_changes_the_saturation_over_time_by_less_than_a_hundredth() {
    let pack = Pack::new(11);
    for (angle, pressure) in [(40.0, 6000.0), (120.0, 2000.0)] {
        let end = 0.01;
        let saturations = |largest_step: f64| {
            let mut dynamic = pack.dynamic(angle, [1e-3, 1e-3], Drive::PressureDrop(pressure), largest_step);
            (1..=20)
                .map(|record| {
                    let until = end * f64::from(record) / 20.0;
                    while dynamic.time() < until {
                        dynamic.advance(until).unwrap();
                    }
                    dynamic.invading_area() / dynamic.pore_area()
                })
                .collect::<Vec<f64>>()
        };
        let (whole, half) = (saturations(0.01), saturations(0.005));
        assert!(half[19] > half[0] + 0.1, "{angle} degrees: nothing moves, {half:?}");
        for (whole, half) in whole.iter().zip(&half) {
            assert!((whole - half).abs() < 0.01, "{angle} degrees: {whole} {half}");
        }
    }
}

#[test]
fn a_pressure_below_all_entry_pressures_comes_to_rest() {
    let pack = Pack::new(3);
    let mut dynamic = pack.dynamic(40.0, [1e-3, 1e-3], Drive::PressureDrop(100.0), 0.01);
    for _ in 0..200 {
        dynamic.advance(dynamic.time() + 1.0).unwrap();
    }
    assert!(dynamic.history().is_empty());
    assert!(dynamic.drive_now().1.abs() < 1e-18, "{:e} m2/s", dynamic.drive_now().1);
}

/// A pack that begins with a share of what its pores at the inlet hold.
fn beginning_with(pack: &Pack, part: f64, rate: Drive, viscosity: [f64; 2]) -> (Dynamic, f64) {
    let terms = Terms {
        viscosity,
        tension: TENSION,
        drive: rate,
        largest_step: 0.01,
        inlet: LEFT,
        inlet_disc: None,
        outlet: RIGHT,
        depth: None,
        gravity: None,
    };
    let empty = || Dynamic::new(Arc::clone(&pack.network), pack.displacement(40.0, [false; 4], false), terms);
    let most = empty().beginning_with(1.0).unwrap_err();
    (empty().beginning_with(part * most).unwrap(), most)
}

#[test]
fn what_pores_at_the_inlet_lack_at_the_beginning_comes_in_first() {
    for seed in 0..4 {
        let (pack, viscosity, number) = (Pack::new(seed), [1e-3, 1e-3], 1e-9);
        let rate = Pack::rate(number, viscosity[0]);
        let mut full = pack.dynamic(40.0, viscosity, Drive::Rate(rate), 0.01);
        until_breakthrough(&mut full);
        for part in [0.0, 0.5] {
            let (mut dynamic, most) = beginning_with(&pack, part, Drive::Rate(rate), viscosity);
            assert!((dynamic.invading_area() / dynamic.pore_area() - part * most).abs() < 1e-12);
            until_breakthrough(&mut dynamic);
            let kinds = |dynamic: &Dynamic| dynamic.history().iter().map(|it| (it.kind, it.throat)).collect::<Vec<_>>();
            assert_eq!(kinds(&dynamic), kinds(&full), "seed {seed}, {part}");
            // All that comes in stays until breakthrough, so that each has the same area then, within what menisci hold.
            let [one, other] = [&dynamic, &full].map(|it| it.breakthrough().unwrap().saturation);
            assert!((one - other).abs() < 2e-3, "seed {seed}, {part}: {one} {other}");
            let came = dynamic.breakthrough().unwrap().time * rate / dynamic.pore_area();
            assert!((part * most + came - one).abs() < 1e-9, "seed {seed}, {part}: {came} came in");
        }
    }
}

#[test]
fn the_invading_phase_leaves_when_it_touches_the_outlet() {
    let mut later = 0;
    for seed in 0..6 {
        let pack = Pack::new(seed);
        let viscosity = [1e-3, 1e-3];
        let mut dynamic = pack.dynamic(40.0, viscosity, Drive::Rate(Pack::rate(1e-6, viscosity[0])), 0.01);
        let mut entered = None;
        while dynamic.breakthrough().is_none() {
            dynamic.advance(f64::INFINITY).unwrap();
            let is_outlet = |e: &usize| dynamic.displacement().outline(*e).iter().any(|x| x.x > SIZE[0] * (1.0 - 1e-9));
            let mut at_outlet = (0..dynamic.displacement().elements().len()).filter(is_outlet);
            if entered.is_none() && at_outlet.any(|e| dynamic.invasions()[e].is_some()) {
                entered = Some(dynamic.invading_area());
            }
        }
        // Between the last throat and the outlet it needs an area of its own, unless the meniscus touches the outlet by its event.
        let area = dynamic.breakthrough().unwrap().saturation * dynamic.pore_area();
        let gained = entered.map(|entered| area / entered - 1.0);
        assert!(gained.is_some_and(|gained| gained > -1e-12), "seed {seed}: {gained:?}");
        later += usize::from(gained.is_some_and(|gained| gained > 1e-6));
        assert!(dynamic.balance_error().abs() < 1e-10);
    }
    assert!(later > 2, "{later} of 6");
}
