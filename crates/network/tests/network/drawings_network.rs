//! The networks of all files agree with each other and with a brute-force search, and so do the pressures.

use std::f64::consts::PI;

use meniscus_core::math::Vec2;
use meniscus_drawings::import::Options;
use meniscus_geometry::Geometry;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::menisci::{Hand, Passage, Wall, WallPart};
use meniscus_geometry::spec::GeometrySpec;
use meniscus_network::displacement::{Conditions, Displacement, Phase};
use meniscus_network::extract;
use meniscus_network::graph::{Network, Pores, Throat};
use serde_json::Value;

use crate::drawings::contents::*;
use crate::drawings::files::*;

/// The network between walls at the bottom and at the top, open on the left and on the right, and its pores.
fn channel(spec: &GeometrySpec) -> (Network, Pores) {
    let geometry = Geometry::new(spec).unwrap().with_wall_sides([false, false, true, true]);
    let network = extract(&geometry, [true, true, false, false]).unwrap();
    let pores = Pores::merged(&network, 0.95);
    (network, pores)
}

fn conditions(angle_deg: f64, shapes: usize, trapping: bool) -> Conditions {
    Conditions {
        inlet: [true, false, false, false],
        outlet: [false, true, false, false],
        trapping: trapping.into(),
        ..Conditions::new(vec![angle_deg.to_radians(); shapes + 4])
    }
}

/// Drainage at 40 degrees from left to right: saturation with the invading phase and applied curvature in 1/m after each event.
fn drainage(spec: &GeometrySpec, trapping: bool) -> (usize, usize, Vec<[f64; 2]>) {
    let (network, pores) = channel(spec);
    let mut state = Displacement::new(&network, &pores, conditions(40.0, spec.shapes.len(), trapping));
    let areas: Vec<f64> = state.elements().iter().map(|element| element.area).collect();
    let whole: f64 = areas.iter().sum();
    // What is open to the inlet is filled from the start.
    let is_filled = |&element: &usize| state.phase(element) == Phase::Invading;
    let mut filled: f64 = (0..areas.len()).filter(is_filled).map(|element| areas[element]).sum();
    let mut curve = vec![[filled / whole, 0.0]];
    for event in state.by_ref() {
        filled += event.elements.iter().map(|&element| areas[element]).sum::<f64>();
        curve.push([filled / whole, event.applied]);
    }
    (pores.area.len(), pores.throats.len(), curve)
}

/// The applied curvature at which a saturation is reached.
fn curvature_at(curve: &[[f64; 2]], saturation: f64) -> f64 {
    curve.iter().find(|point| point[0] >= saturation).map_or(f64::INFINITY, |point| point[1])
}

#[test]
fn every_route_leads_to_the_same_network_and_the_same_drainage() {
    let list = imported("pack.xyr", &in_box(Options::default(), PACK)).spec;
    let [expected, trapped] = [false, true].map(|trapping| drainage(&list, trapping));
    for (name, options, kind, _) in packs() {
        let spec = imported(name, &options).spec;
        for (trapping, (pores, throats, expected)) in [(false, &expected), (true, &trapped)] {
            let (found_pores, found_throats, curve) = drainage(&spec, trapping);
            let last = expected.last().unwrap()[0];
            let mut worst: f64 = 0.0;
            for saturation in (1..10).map(|i| 0.1 * f64::from(i)).filter(|s| *s < last) {
                // The curve has steps: an event may fill its element a little before or after the saturation that is asked for.
                let [low, high] = [-5e-3, 5e-3].map(|off| curvature_at(expected, saturation + off));
                let found = curvature_at(&curve, saturation);
                worst = worst.max(found / high - 1.0).max(1.0 - found / low);
            }
            println!(
                "{name:24} {found_pores} pores, {found_throats} throats, trapping {trapping}: pressure off by {worst:.1e}, end {:.4} of {last:.4}",
                curve.last().unwrap()[0]
            );
            if !trapping {
                assert!(worst < 0.01, "{name}: {worst:e}");
            }
            if kind == Kind::Exact {
                assert_eq!((found_pores, found_throats), (*pores, *throats), "{name}");
                assert!(worst < 1e-6, "{name}: {worst:e}");
            }
        }
    }
}

/// Network of the pack as in the reference: in a closed box, or periodic in both directions.
fn of_reference(periodic: bool) -> (Network, usize) {
    let spec = imported("pack.xyr", &in_box(Options::default(), PACK)).spec;
    let geometry = Geometry::new(&spec).unwrap();
    let geometry = if periodic { geometry.with_periodic([true; 2]) } else { geometry.with_wall_sides([true; 4]) };
    (extract(&geometry, [false; 4]).unwrap(), spec.shapes.len())
}

/// Distance of two points of the pack in m; through periodic sides where there are some.
fn distance(a: Vec2, b: Vec2, periodic: bool) -> f64 {
    let size = Vec2::from(PACK[1]);
    let gap =
        |i: usize| if periodic { (a[i] - b[i]) - size[i] * ((a[i] - b[i]) / size[i]).round() } else { a[i] - b[i] };
    gap(0).hypot(gap(1))
}

/// Index of the shape that a body of the reference is: discs, then the walls.
fn shape_of(body: &str) -> u32 {
    let wall = ["left", "right", "bottom", "top"].iter().position(|side| *side == body);
    wall.map_or_else(|| body.strip_prefix("disc-").unwrap().parse().unwrap(), |wall| 60 + wall as u32)
}

#[test]
fn the_network_is_that_of_a_brute_force_search() {
    let reference = reference();
    for (key, periodic) in [("closed", false), ("periodic", true)] {
        let (network, _) = of_reference(periodic);
        let expected = &reference[key];
        for row in rows(&expected["merged"]) {
            let pores = Pores::merged(&network, number(&row[0]));
            assert_eq!(
                [pores.area.len(), pores.throats.len()],
                [1, 2].map(|i| number(&row[i]) as usize),
                "{key} {row:?}"
            );
        }
        let pores = rows(&expected["pores"]);
        // The reference stops its iterations at 1e-12 m.
        let near = |row: &[Value], at: Vec2, length: f64| {
            let place = Vec2::new(number(&row[0]), number(&row[1]));
            distance(place, at, periodic) < 1e-9 && (number(&row[2]) - length).abs() < 1e-11
        };
        for row in &pores {
            let found = network.regions.iter().filter(|region| near(row, region.center, region.radius)).count();
            assert_eq!(found, 1, "{key}: the pore {row:?}");
        }
        let throats = rows(&expected["throats"]);
        for row in &throats {
            let middle = |k: usize| 0.5 * (network.throats[k].contacts[0] + network.throats[k].contacts[1]);
            let found: Vec<usize> =
                (0..network.throats.len()).filter(|&k| near(row, middle(k), network.throats[k].width)).collect();
            let [k] = found[..] else { panic!("{key}: {} throats for {row:?}", found.len()) };
            let mut bodies = [5, 6].map(|i| shape_of(row[i].as_str().unwrap()));
            let mut walls = network.throats[k].shapes;
            bodies.sort_unstable();
            walls.sort_unstable();
            assert_eq!(walls, bodies, "{key}: {row:?}");
            let joins = |end: usize| {
                let region = &network.regions[network.throats[k].regions[end]];
                [3, 4].map(|i| near(&pores[number(&row[i]) as usize], region.center, region.radius))
            };
            let (one, other) = (joins(0), joins(1));
            assert!((one[0] && other[1]) || (one[1] && other[0]), "{key}: the throat {row:?} joins other pores");
        }
        println!("{key}: {} pores, {} throats", pores.len(), throats.len());
    }
}

/// How far entry curvatures are off by those of the reference, for the throats and angles that are wanted: a share.
fn entries_off(wanted: impl Fn(bool, f64) -> bool) -> f64 {
    let (reference, mut worst) = (reference(), 0.0_f64);
    for (key, periodic) in [("closed", false), ("periodic", true)] {
        let (network, shapes) = of_reference(periodic);
        let pores = Pores::merged(&network, 1.0);
        for (angle, column) in [(40.0, 7), (120.0, 8)] {
            let conditions = Conditions { inlet: [false; 4], outlet: [false; 4], ..conditions(angle, shapes, false) };
            let displacement = Displacement::new(&network, &pores, conditions.clone());
            let entries = displacement.entry_curvatures(&conditions, network.throats.len());
            for row in rows(&reference[key]["throats"]) {
                let meets_a_side = [5, 6].iter().any(|&i| shape_of(row[i].as_str().unwrap()) >= 60);
                if !wanted(meets_a_side, angle) {
                    continue;
                }
                let is_it = |throat: &Throat| {
                    let middle = 0.5 * (throat.contacts[0] + throat.contacts[1]);
                    distance(Vec2::new(number(&row[0]), number(&row[1])), middle, periodic) < 1e-9
                };
                let found = entries[network.throats.iter().position(is_it).unwrap()];
                assert!(found.is_finite(), "{key}: {row:?}");
                worst = worst.max((found / number(&row[column]) - 1.0).abs());
            }
        }
    }
    worst
}

#[test]
fn entry_curvatures_are_those_of_arcs_shot_from_wall_to_wall() {
    let worst = entries_off(|meets_a_side, angle| !meets_a_side || angle < 90.0);
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn entry_curvatures_at_sides_are_those_of_arcs_shot_from_wall_to_wall() {
    let worst = entries_off(|meets_a_side, angle| meets_a_side && angle > 90.0);
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn bursts_between_whole_walls_are_those_of_arcs_shot_from_wall_to_wall() {
    let reference = reference();
    let radius = |body: &Value| {
        let shape = shape_of(body.as_str().unwrap()) as usize;
        (shape < 60).then(|| number(&rows(&reference["discs"])[shape][2]))
    };
    let mut worst: f64 = 0.0;
    for row in rows(&reference["closed"]["throats"]) {
        let width = number(&row[2]);
        // A side comes second; the disc stands above it, on the left of the advance.
        let (above, below) = (radius(&row[5]).unwrap(), radius(&row[6]));
        for (angle, column) in [(40.0_f64.to_radians(), 7), (120.0_f64.to_radians(), 8)] {
            let left = Wall::of_disc(Vec2::new(0.0, width + above), above, angle, Vec2::zeros(), Hand::Left);
            let right = match below {
                Some(r) => Wall::of_disc(Vec2::new(0.0, -r), r, angle, Vec2::new(0.0, width), Hand::Right),
                None => {
                    // Far longer than the meniscus.
                    let [far, near] = [1.0, 0.0].map(|x| Vec2::new(x, 0.0));
                    let part = |a, b| WallPart { curve: Curve::Segment { a, b }, angle };
                    Wall { parts: vec![part(near, -far), part(far, near)], behind: 1 }
                }
            };
            let found = Passage::new(left, right).burst().unwrap().curvature;
            worst = worst.max((found / number(&row[column]) - 1.0).abs());
        }
    }
    println!("bursts off by {worst:.1e}");
    // The reference knows them to 1e-12.
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn the_area_of_the_pores_is_that_of_the_box_without_discs() {
    let discs: f64 = rows(&reference()["discs"]).iter().map(|row| PI * number(&row[2]).powi(2)).sum();
    for periodic in [false, true] {
        let (network, _) = of_reference(periodic);
        let area: f64 = network.regions.iter().map(|region| region.area).sum();
        // Sums of some hundred areas.
        assert!((area / (14e-3 * 9e-3 - discs) - 1.0).abs() < 1e-12);
    }
}
