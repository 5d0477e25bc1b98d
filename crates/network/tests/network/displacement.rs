//! Quasi-static displacement on whole networks: what no state and no order of events may violate, and what the three events do.

use std::sync::Arc;

use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Disc, GeometrySpec, ShapeSpec, SolidSide};
use meniscus_network::displacement::{Conditions, Displacement, Event, EventKind, Events, Phase};
use meniscus_network::extract;
use meniscus_network::graph::{Network, Pores};

use crate::support::dice::scattered_discs;

/// Discs of radius .4 to .6 at least .12 apart in a box that is periodic along y, as many as `tries` attempts place.
fn pack(seed: u64, size: [f64; 2], tries: usize) -> GeometrySpec {
    let discs = scattered_discs(seed, tries, size, [0.4, 0.6], [0.12, 0.06]);
    GeometrySpec {
        min: [0.0; 2],
        max: size,
        solid: SolidSide::Inside,
        shapes: discs.into_iter().map(ShapeSpec::Disc).collect(),
    }
}

const LEFT: [bool; 4] = [true, false, false, false];
const RIGHT: [bool; 4] = [false, true, false, false];

/// The network of shapes in a domain that is open on the left and on the right and periodic from bottom to top: walls there would be
/// ways of their own.
fn network(spec: &GeometrySpec) -> (Arc<Network>, Arc<Pores>, usize) {
    let geometry = Geometry::new(spec).unwrap().with_periodic([false, true]);
    let network = extract(&geometry, [true, true, false, false]).unwrap();
    let pores = Pores::merged(&network, 0.95);
    (Arc::new(network), Arc::new(pores), spec.shapes.len() + 4)
}

fn conditions(angle_deg: f64, shapes: usize, trapping: bool, events: Events) -> Conditions {
    Conditions {
        inlet: LEFT,
        outlet: RIGHT,
        trapping: trapping.into(),
        events,
        ..Conditions::new(vec![angle_deg.to_radians(); shapes])
    }
}

/// What came out of a displacement.
struct Outcome {
    events: Vec<Event>,
    /// Applied curvature and saturation with the invading phase at breakthrough.
    breakthrough: Option<(f64, f64)>,
    /// Saturation at the end.
    end: f64,
    state: Displacement,
}

fn displaced(spec: &GeometrySpec, angle_deg: f64, trapping: bool, events: Events) -> Outcome {
    let (network, pores, shapes) = network(spec);
    run(Displacement::new(&network, &pores, conditions(angle_deg, shapes, trapping, events)))
}

fn run(mut state: Displacement) -> Outcome {
    let area: f64 = (0..state.elements().len()).map(|e| state.elements()[e].area).sum();
    let mut filled: f64 = (0..state.elements().len())
        .filter(|&e| state.phase(e) == Phase::Invading)
        .map(|e| state.elements()[e].area)
        .sum();
    let (mut events, mut breakthrough) = (Vec::new(), None);
    while let Some(event) = state.next() {
        filled += event.elements.iter().map(|&e| state.elements()[e].area).sum::<f64>();
        if breakthrough.is_none() && state.reached_outlet() {
            breakthrough = Some((event.applied, filled / area));
        }
        events.push(event);
    }
    Outcome { events, breakthrough, end: filled / area, state }
}

#[test]
fn elements_tile_the_pore_space() {
    for seed in 1..6 {
        let spec = pack(seed, [12.0, 9.0], 2000);
        let (network, pores, shapes) = network(&spec);
        let whole: f64 = network.regions.iter().map(|region| region.area).sum();
        for events in [Events::All, Events::Burst] {
            let state = Displacement::new(&network, &pores, conditions(60.0, shapes, true, events));
            let sum: f64 = (0..state.elements().len()).map(|e| state.elements()[e].area).sum();
            assert!((sum - whole).abs() < 1e-12 * whole, "{sum} {whole}");
            assert!((0..state.elements().len()).all(|e| state.elements()[e].area > 0.0));
        }
    }
}

/// [WilkinsonWillemsen1983]
#[test]
fn every_filled_element_lies_beside_the_invading_phase_and_the_applied_pressure_never_falls() {
    for (seed, angle) in [(1, 30.0), (2, 90.0), (3, 120.0), (4, 165.0)] {
        let spec = pack(seed, [14.0, 10.0], 3000);
        for trapping in [true, false] {
            let outcome = displaced(&spec, angle, trapping, Events::All);
            let mut applied = f64::NEG_INFINITY;
            for event in &outcome.events {
                assert!(event.applied >= applied && event.applied >= event.curvature);
                assert!(event.curvature.is_finite());
                applied = event.applied;
            }
            assert!(outcome.breakthrough.is_some());
            // Without trapping all is filled in the end.
            assert!(outcome.end <= 1.0 + 1e-12 && (trapping || (outcome.end - 1.0).abs() < 1e-12), "{}", outcome.end);
            let left = (0..outcome.state.elements().len()).filter(|&e| !(outcome.state.phase(e) == Phase::Invading));
            assert!(left.into_iter().all(|e| outcome.state.is_trapped(e)));
        }
    }
}

#[test]
fn overlap_makes_imbibition_easier_and_more_compact_and_hardly_matters_in_drainage() {
    let spec = pack(11, [20.0, 14.0], 20_000);
    let [mut pressures, mut saturations] = [Vec::new(), Vec::new()];
    for angle in [40.0, 60.0, 90.0, 120.0, 140.0, 160.0] {
        let outcome = displaced(&spec, angle, true, Events::All);
        let (pressure, saturation) = outcome.breakthrough.unwrap();
        let count = |kind| outcome.events.iter().filter(|event| event.kind == kind).count();
        println!(
            "{angle:5} k {pressure:.3} S {saturation:.3} end {:.3} burst {} touch {} overlap {}",
            outcome.end,
            count(EventKind::Burst),
            count(EventKind::Touch),
            count(EventKind::Overlap)
        );
        pressures.push(pressure);
        saturations.push(saturation);
        if angle < 50.0 {
            assert!(count(EventKind::Overlap) * 50 < outcome.events.len());
        }
        if angle > 150.0 {
            assert!(count(EventKind::Overlap) > outcome.events.len() / 3);
        }
    }
    assert!(pressures.windows(2).all(|pair| pair[1] < pair[0]), "{pressures:?}");
    assert!(saturations[5] > saturations[0] + 0.2, "{saturations:?}");
    // Bursts alone ask for several times the pressure at 160 degrees (a prototype in another language found 3.8 times for such a pack).
    let alone = displaced(&spec, 160.0, true, Events::Burst).breakthrough.unwrap().0;
    assert!(alone > 2.0 * pressures[5], "{alone} {}", pressures[5]);
}

#[test]
fn a_mirrored_pack_is_filled_in_the_same_way() {
    let spec = pack(5, [14.0, 10.0], 3000);
    let mirrored = |spec: &GeometrySpec| {
        let mut mirrored = spec.clone();
        for shape in &mut mirrored.shapes {
            if let ShapeSpec::Disc(disc) = shape {
                disc.center[1] = spec.max[1] - disc.center[1];
            }
        }
        mirrored
    };
    for angle in [45.0, 135.0] {
        let [one, other] = [spec.clone(), mirrored(&spec)].map(|spec| displaced(&spec, angle, true, Events::All));
        assert_eq!(one.events.len(), other.events.len());
        for (a, b) in one.events.iter().zip(&other.events) {
            assert!((a.curvature - b.curvature).abs() < 1e-9 * a.curvature.abs().max(1.0), "{a:?} {b:?} {angle}");
            assert_eq!(a.kind, b.kind);
        }
        // Where segments that divide regions stand is known to the root of the rounding only.
        assert!((one.end - other.end).abs() < 1e-7, "{} {}", one.end, other.end);
    }
}

#[test]
fn drainage_and_imbibition_leave_residuals_and_meet_no_contradiction() {
    let spec = pack(8, [20.0, 14.0], 20_000);
    let (network, pores, shapes) = network(&spec);
    let drained = run(Displacement::new(&network, &pores, conditions(40.0, shapes, true, Events::All)));
    let back = Conditions { inlet: RIGHT, outlet: LEFT, ..conditions(140.0, shapes, true, Events::All) };
    let imbibed = run(drained.state.clone().reverse(back));
    println!("drained {:.3}, wetting after imbibition {:.3}", drained.end, imbibed.end);
    assert!(drained.end > 0.5 && imbibed.end > 0.5 && imbibed.end < 1.0);
    // The way back costs less than the way in: hysteresis.
    let k = |outcome: &Outcome| outcome.breakthrough.map(|b| b.0).unwrap();
    assert!(-k(&imbibed) < k(&drained));
}

#[test]
fn a_disc_that_faces_its_own_image_bursts_as_two_discs_do() {
    // One disc a period and two discs in two periods are the same row.
    let disc = |y: f64| ShapeSpec::Disc(Disc { center: [0.0, y], radius: 0.4 });
    let row = |height: f64, shapes: Vec<ShapeSpec>| GeometrySpec {
        min: [-2.0, 0.0],
        max: [2.0, height],
        solid: SolidSide::Inside,
        shapes,
    };
    for angle in [20.0, 60.0, 90.0, 140.0] {
        let [one, two] = [row(1.0, vec![disc(0.3)]), row(2.0, vec![disc(0.3), disc(1.3)])].map(|spec| {
            let outcome = displaced(&spec, angle, false, Events::Burst);
            outcome.events.iter().map(|event| event.curvature).fold(f64::NEG_INFINITY, f64::max)
        });
        // r = √((L/2)² − R² sin²θ) − R cos θ for equal discs at the distance L.
        let (sin, cos) = angle.to_radians().sin_cos();
        let exact = 1.0 / ((0.25 - 0.16 * sin * sin).sqrt() - 0.4 * cos);
        assert!(
            (one - exact).abs() < 1e-9 * exact && (two - exact).abs() < 1e-9 * exact,
            "{angle}: {one} {two} {exact}"
        );
    }
}

/// Discs of radius 1 on equal triangles of side `pitch`, rows along x, periodic along y, with free space on both sides.
fn hexagonal(pitch: f64) -> GeometrySpec {
    let (columns, rows) = (9, 6);
    let height = 0.5 * 3.0_f64.sqrt() * pitch;
    let disc = |i: i32, j: i32| {
        let center = [(f64::from(i) + 1.5 + 0.5 * f64::from(j % 2)) * pitch, (f64::from(j) + 0.5) * height];
        ShapeSpec::Disc(Disc { center, radius: 1.0 })
    };
    GeometrySpec {
        min: [0.0; 2],
        max: [(f64::from(columns) + 2.5) * pitch, f64::from(rows) * height],
        solid: SolidSide::Inside,
        shapes: (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j))).map(|(i, j)| disc(i, j)).collect(),
    }
}

/// [CieplakRobbins1988]
#[test]
fn menisci_that_have_met_around_a_disc_wait_as_one_until_they_touch_the_disc_ahead() {
    for pitch in [2.2, 2.4, 3.0] {
        let outcome = displaced(&hexagonal(pitch), 180.0, false, Events::All);
        // Both meet on the disc A between the discs B and D on the circle around the disc E ahead, which has the radius L - 1. The meniscus
        // between B and D then flattens until it touches E: |C - B| = 1 + r with C = r - 1 from the center of E.
        let (met, touched) = (1.0 / (pitch - 1.0), (4.0 - pitch) / (pitch * (pitch - 1.0)));
        assert!(touched < met);
        let joined: Vec<f64> =
            outcome.events.iter().filter(|event| event.elements.len() == 2).map(|event| -event.curvature).collect();
        println!("{pitch}: met {met} touched {touched}: {joined:?}");
        assert!(joined.len() > 20, "{}", joined.len());
        assert!(joined.iter().all(|k| (k / touched - 1.0).abs() < 1e-9), "{touched}: {joined:?}");
    }
}
