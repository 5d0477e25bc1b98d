//! Grains that share a corner close the way between them, as grains do that overlap by a hair.

use meniscus_geometry::Geometry;
use meniscus_geometry::spec::ShapeSpec;
use meniscus_network::displacement::{Conditions, Displacement, Trapping};
use meniscus_network::extract;
use meniscus_network::graph::Pores;

use crate::scenes::{disc, grains, polygon};
use crate::support::dice::Dice;

/// By so much grains overlap, in sizes of the box of 3 x 1.
const HAIR: f64 = 1e-6;
const LEFT: [bool; 4] = [true, false, false, false];
const RIGHT: [bool; 4] = [false, true, false, false];

/// Curvature at breakthrough and the share that stays, from left to right between walls; none where there is no network.
fn drained(shapes: Vec<ShapeSpec>, angle_deg: f64) -> Option<[f64; 2]> {
    let geometry: Geometry = grains([3.0, 1.0], shapes.clone()).with_wall_sides([false, false, true, true]);
    let network = extract(&geometry, [true, true, false, false]).ok()?;
    let conditions = Conditions {
        inlet: LEFT,
        outlet: RIGHT,
        trapping: Trapping::Disconnected,
        ..Conditions::new(vec![angle_deg.to_radians(); shapes.len() + 4])
    };
    let mut displacement = Displacement::new(&network, &Pores::merged(&network, 0.95), conditions);
    let mut breakthrough = f64::NAN;
    while let Some(event) = displacement.next() {
        if displacement.reached_outlet() && breakthrough.is_nan() {
            breakthrough = event.applied;
        }
    }
    let elements = displacement.elements().iter().enumerate();
    let left = elements.filter(|(k, _)| displacement.phase(*k) == meniscus_network::displacement::Phase::Defending);
    let all: f64 = displacement.elements().iter().map(|element| element.area).sum();
    Some([breakthrough, left.map(|(_, element)| element.area).sum::<f64>() / all])
}

/// A parallelogram with a corner at `at`, its edges along two directions in rad, of two lengths.
fn grain(at: [f64; 2], [one, other]: [f64; 2], [a, b]: [f64; 2]) -> ShapeSpec {
    let (u, v) = ([a * one.cos(), a * one.sin()], [b * other.cos(), b * other.sin()]);
    let corner = |s: f64, t: f64| [at[0] + s * u[0] + t * v[0], at[1] + s * u[1] + t * v[1]];
    polygon(vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)])
}

/// Two grains that meet in a point, the second one moved towards the first by `overlap`.
fn pair(seed: u64, overlap: f64) -> Vec<ShapeSpec> {
    let mut dice = Dice::new(seed);
    // Corners off the middle: two ways of one width would be one event or two.
    let at = [dice.between(1.2, 1.8), dice.between(0.35, 0.47)];
    let turn = dice.between(-0.5, 0.5) + if seed.is_multiple_of(2) { 0.0 } else { std::f64::consts::FRAC_PI_2 };
    let back = |x: [f64; 2], along: f64| [x[0] - overlap * along.cos(), x[1] - overlap * along.sin()];
    let toward = turn + std::f64::consts::FRAC_PI_4;
    let [r, s] = [dice.between(0.12, 0.2), dice.between(0.12, 0.2)];
    if seed.is_multiple_of(3) {
        let far = |radius: f64| [at[0] + radius * toward.cos(), at[1] + radius * toward.sin()];
        let ([a, b], [x, y]) = (far(-r), back(far(s), toward));
        return vec![disc(a, b, r), disc(x, y, s)];
    }
    let spread = dice.between(-0.3, 0.3);
    let quarter = std::f64::consts::FRAC_PI_2;
    let first =
        [toward + 3.0 * std::f64::consts::FRAC_PI_4 - spread, toward + 5.0 * std::f64::consts::FRAC_PI_4 + spread];
    let second = [toward - 0.5 * quarter, toward + 0.5 * quarter];
    vec![grain(at, first, [r, 0.8 * r]), grain(back(at, toward), second, [0.9 * s, s])]
}

/// `MENISCUS_INPUTS=10000` tries so many.
fn inputs(few: u64) -> u64 {
    std::env::var("MENISCUS_INPUTS").ok().and_then(|count| count.parse().ok()).unwrap_or(few)
}

#[test]
fn grains_that_share_a_corner_drain_as_if_they_overlapped_by_a_hair() {
    let (mut compared, count) = (0, inputs(200));
    let mut other = Vec::new();
    for seed in 0..count {
        for angle in [0.0, 30.0, 60.0, 100.0] {
            let [touching, overlapping] = [0.0, HAIR].map(|overlap| drained(pair(seed, overlap), angle));
            let (Some(touching), Some(overlapping)) = (touching, overlapping) else { continue };
            compared += 1;
            let is_same = (touching[0] - overlapping[0]).abs() <= 1e-3 * overlapping[0].abs()
                && (touching[1] - overlapping[1]).abs() <= 1e-3;
            if !is_same {
                other.push((seed, angle, touching, overlapping));
            }
        }
    }
    println!("{compared} compared");
    assert!(other.is_empty(), "{} of {compared}: {other:?}", other.len());
    assert!(compared >= 2 * count, "{compared}");
}

#[test]
fn two_posts_that_share_a_corner_open_at_the_gap_between_post_and_wall() {
    let square = |x: f64, y: f64, w: f64, h: f64| polygon(vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]]);
    for (angle, expected) in [(30.0_f64, (1.0 + 30.0_f64.to_radians().cos()) / 0.2), (0.0, 10.0)] {
        let shapes = vec![square(1.0, 0.2, 0.2, 0.3), square(1.2, 0.5, 0.2, 0.3)];
        let [pressure, _] = drained(shapes, angle).unwrap();
        assert!((pressure - expected).abs() < 1e-9 * expected, "{angle}: {pressure}");
    }
}
