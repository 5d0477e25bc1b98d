//! Round chambers joined by channels: what drains a channel is the mouth into the chamber ahead, and every drawing has a network.

use std::f64::consts::FRAC_PI_2;

use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Disc, GeometrySpec, Polygon, ShapeSpec, SolidSide};
use meniscus_network::displacement::{Conditions, Displacement, Phase};
use meniscus_network::extract;
use meniscus_network::graph::{Network, Pores};
use rayon::prelude::*;

use crate::invariants::violations;
use crate::motion::{MOTIONS, Motion, STILL};
use crate::scenes::{areas, radii, widths};
use crate::support::dice::Dice;

/// Discs and channels in a solid box from the origin.
struct Chambers {
    size: [f64; 2],
    /// Center and radius.
    discs: Vec<([f64; 2], f64)>,
    /// Both ends of the axis, and half the width.
    channels: Vec<([[f64; 2]; 2], f64)>,
}

impl Chambers {
    fn geometry(&self, motion: &Motion) -> Geometry {
        let point = |x: [f64; 2]| motion.point(self.size, x);
        let disc =
            |&(center, radius): &_| ShapeSpec::Disc(Disc { center: point(center), radius: motion.scale * radius });
        let channel = |&([a, b], half): &([[f64; 2]; 2], f64)| {
            let [a, b] = [a, b].map(Vec2::from);
            let along = (b - a).normalize();
            let beside = Vec2::new(-along.y, along.x) * half;
            let mut outer: Vec<[f64; 2]> =
                [a - beside, b - beside, b + beside, a + beside].iter().map(|x| point([x.x, x.y])).collect();
            if motion.is_mirror() {
                outer.reverse();
            }
            ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 })
        };
        let size = motion.size(self.size);
        let corner = |share: f64| [0, 1].map(|i| motion.scale * size[i] * (motion.shift[i] + share));
        let shapes = self.discs.iter().map(disc).chain(self.channels.iter().map(channel)).collect();
        let spec = GeometrySpec { min: corner(0.0), max: corner(1.0), solid: SolidSide::Outside, shapes };
        Geometry::new(&spec).unwrap()
    }

    /// Four by three chambers in a row and above each other, most of them joined by channels up to almost as wide.
    fn random(seed: u64) -> Self {
        let mut dice = Dice::new(seed);
        let (columns, rows) = (4, 3);
        let mut discs = Vec::new();
        for k in 0..columns * rows {
            let middle = [k % columns, k / columns].map(|i| 3.0 * f64::from(i) + 2.0);
            discs.push((middle.map(|x| x + dice.between(-0.5, 0.5)), dice.between(0.5, 1.0)));
        }
        let at = |column: i32, row: i32| (columns * row + column) as usize;
        let mut channels = Vec::new();
        let size = [3.0 * f64::from(columns) + 1.0, 3.0 * f64::from(rows) + 1.0];
        for row in 0..rows {
            for column in 0..columns {
                let here = at(column, row);
                let right = (column + 1 < columns).then(|| at(column + 1, row));
                let above = (row + 1 < rows).then(|| at(column, row + 1));
                for there in [right, above].into_iter().flatten() {
                    let half = discs[here].1.min(discs[there].1) * dice.between(0.6, 0.97);
                    if dice.between(0.0, 1.0) < 0.85 {
                        channels.push(([discs[here].0, discs[there].0], half));
                    }
                }
            }
            for (column, x) in [(0, -1.0), (columns - 1, size[0] + 1.0)] {
                let (center, radius) = discs[at(column, row)];
                channels.push(([[x, center[1]], center], radius * dice.between(0.6, 0.97)));
            }
        }
        Self { size, discs, channels }
    }

    /// Chambers that overlap.
    fn overlapping(seed: u64) -> Self {
        let mut dice = Dice::new(seed);
        let disc = |_| ([dice.between(0.0, 10.0), dice.between(0.0, 10.0)], dice.between(0.4, 1.2));
        Self { size: [10.0; 2], discs: (0..50).map(disc).collect(), channels: Vec::new() }
    }
}

/// Three chambers on the middle of a box of 10 x 4, with two channels between them, and the half width of the channels that lead to the box.
fn chain(radii: [f64; 3], halves: [f64; 2], outer: f64) -> Chambers {
    let at = |x: f64| [x, 2.0];
    Chambers {
        size: [10.0, 4.0],
        discs: [2.0, 5.0, 8.0].into_iter().zip(radii).map(|(x, radius)| (at(x), radius)).collect(),
        channels: vec![
            ([at(2.0), at(5.0)], halves[0]),
            ([at(5.0), at(8.0)], halves[1]),
            ([at(-0.5), at(2.0)], outer),
            ([at(8.0), at(10.5)], outer),
        ],
    }
}

/// The curvature at which a meniscus leaves a channel for a disc: it is pinned at the corners of the mouth until it is a half circle, or until it meets the
/// wall of the disc at the contact angle (Gibbs).
fn mouth(half: f64, radius: f64, angle: f64) -> f64 {
    let opening = (half / radius).asin();
    if opening + angle <= FRAC_PI_2 { 1.0 / half } else { (opening + angle).sin() / half }
}

/// The state that a displacement at this contact angle, from left to right, begins with.
fn filled(network: &Network, motion: &Motion, angle: f64, shapes: usize) -> (Displacement, Conditions) {
    let side = |number: usize| [0, 1, 2, 3].map(|k| k == motion.side(number));
    let conditions = Conditions { inlet: side(0), outlet: side(1), ..Conditions::new(vec![angle; shapes + 4]) };
    (Displacement::new(network, &Pores::merged(network, 0.95), conditions.clone()), conditions)
}

#[test]
fn a_channel_is_entered_at_the_curvature_of_its_mouth_whatever_lies_behind_the_chamber() {
    for (radii, halves) in [([1.0, 0.8, 1.0], [0.3, 0.2]), ([0.9, 0.8, 1.1], [0.7, 0.5])] {
        // Beside the widest channels half a disc remains of the outer chambers.
        let [least, most] = [f64::min(radii[0], radii[2]), f64::max(radii[0], radii[2])];
        for outer in [0.5, 0.85, 0.999 * least, 1.1 * most] {
            let chain = chain(radii, halves, outer);
            for motion in [STILL].iter().chain(&MOTIONS) {
                let geometry = chain.geometry(motion);
                let open = [0, 1, 2, 3].map(|side| side == motion.side(0) || side == motion.side(1));
                let network = extract(&geometry, open).unwrap_or_else(|error| panic!("{}: {error}", motion.name));
                for degrees in [0.0_f64, 10.0, 40.0, 75.0, 110.0] {
                    let angle = degrees.to_radians();
                    let (state, conditions) = filled(&network, motion, angle, 7);
                    let entered = state.entry_curvatures(&conditions, network.throats.len());
                    for k in 0..2 {
                        let is_between = |&number: &usize| {
                            let [p, q] = network.throats[number].contacts.map(|x| motion.back(chain.size, x));
                            let x = 0.5 * (p.x + q.x);
                            (x - 3.5 - 3.0 * k as f64).abs() < 0.7 && (p - q).norm() < 2.001 * halves[k]
                        };
                        let throat = (0..network.throats.len()).find(is_between).unwrap();
                        // The larger one of both directions; half a disc ends at corners of its own.
                        let ahead = mouth(halves[k], radii[k], angle).max(mouth(halves[k], radii[k + 1], angle));
                        let corners = FRAC_PI_2.min(std::f64::consts::PI - angle).sin() / radii[2 * k];
                        let expected = if outer > most { ahead.max(corners) } else { ahead };
                        let found = entered[throat] * motion.scale;
                        assert!(
                            (found - expected).abs() < 1e-9 / halves[k],
                            "{} {outer} {degrees} {k}: {found} {expected}",
                            motion.name
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn random_chambers_have_a_network_and_drain_however_they_are_turned() {
    let seeds: Vec<u64> = (0..50).collect();
    let wrong: Vec<String> = seeds.par_iter().flat_map_iter(|&seed| problems(seed, &Chambers::random(seed))).collect();
    assert!(wrong.is_empty(), "{} {wrong:#?}", wrong.len());
    let wrong: Vec<String> =
        seeds.par_iter().flat_map_iter(|&seed| problems(seed, &Chambers::overlapping(seed))).collect();
    assert!(wrong.is_empty(), "{} {wrong:#?}", wrong.len());
}

/// What does not hold for a drawing and its mirror images.
fn problems(seed: u64, chambers: &Chambers) -> Vec<String> {
    let mut found = Vec::new();
    let mut first: Option<[Vec<f64>; 3]> = None;
    for motion in [STILL, MOTIONS[0], MOTIONS[4], MOTIONS[9]] {
        let geometry = chambers.geometry(&motion);
        let open = [0, 1, 2, 3].map(|side| side == motion.side(0) || side == motion.side(1));
        let network = match extract(&geometry, open) {
            Ok(network) => network,
            Err(error) => {
                found.push(format!("{seed} {}: {error}", motion.name));
                continue;
            }
        };
        found.extend(violations(&geometry, &network).into_iter().map(|what| format!("{seed} {}: {what}", motion.name)));
        let in_units = |values: Vec<f64>, power: i32| values.iter().map(|x| x / motion.scale.powi(power)).collect();
        let these = [in_units(widths(&network), 1), in_units(radii(&network), 1), in_units(areas(&network), 2)];
        let other = first.get_or_insert_with(|| these.clone());
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-7;
        let is_same = |(a, b): (&Vec<f64>, &Vec<f64>)| a.len() == b.len() && a.iter().zip(b).all(is_near);
        if !these.iter().zip(other.iter()).all(is_same) {
            found.push(format!("{seed} {}: another network", motion.name));
        }
        let (mut state, _) = filled(&network, &motion, 0.7, chambers.discs.len() + chambers.channels.len());
        while state.next().is_some() {}
        if !state.elements().iter().enumerate().any(|(k, _)| state.phase(k) == Phase::Invading) {
            found.push(format!("{seed} {}: nothing is filled", motion.name));
        }
    }
    found
}
