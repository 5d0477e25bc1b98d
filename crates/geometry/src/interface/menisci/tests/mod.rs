//! Menisci compared with closed forms, root searches and dense scans; here the helpers shared by these tests.

mod burst;
mod events;
mod places;

use std::f64::consts::{PI, TAU};

use super::{Hand, Passage, Wall, WallPart};
use crate::curve::{Curve, cross, unit};
use meniscus_core::math::Vec2;

/// Two discs, the second one to the right of the first; the advance is upwards.
fn discs(radii: [f64; 2], distance: f64, angles: [f64; 2]) -> Passage {
    let (l, r) = (Vec2::zeros(), Vec2::new(distance, 0.0));
    Passage::new(
        Wall::of_disc(l, radii[0], angles[0], r, Hand::Left),
        Wall::of_disc(r, radii[1], angles[1], l, Hand::Right),
    )
}

fn relative(value: f64, exact: f64) -> f64 {
    (value / exact - 1.0).abs()
}

/// Straight pieces from point to point in the order of the advance; the chord ends at the point of index `behind`.
fn polyline(points: &[[f64; 2]], behind: usize, angle: f64, hand: Hand) -> Wall {
    let part = |pair: &[[f64; 2]]| {
        let curve = Curve::Segment { a: pair[0].into(), b: pair[1].into() };
        WallPart { curve: if hand == Hand::Left { curve } else { curve.reversed() }, angle }
    };
    Wall { parts: points.windows(2).map(part).collect(), behind }
}

/// The mirror image of the passage.
fn mirrored(left: &Wall, right: &Wall) -> Passage {
    let flip = |p: Vec2| Vec2::new(-p.x, p.y);
    let mirror = |wall: &Wall| {
        let part = |part: &WallPart| {
            let curve = match part.curve {
                Curve::Segment { a, b } => Curve::Segment { a: flip(b), b: flip(a) },
                Curve::Arc { center, radius, start, sweep } => {
                    Curve::Arc { center: flip(center), radius, start: PI - (start + sweep), sweep }
                }
            };
            WallPart { curve, ..*part }
        };
        Wall { parts: wall.parts.iter().map(part).collect(), behind: wall.behind }
    };
    Passage::new(mirror(right), mirror(left))
}

/// A small portable generator of pseudorandom numbers (Knuth's multiplier).
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }
}

/// Three bodies about a cell, counter-clockwise, as walls of the passages between them: round, polygonal, or a plate.
struct Cell {
    centers: [Vec2; 3],
    radii: [f64; 3],
    corners: [Option<usize>; 3],
    theta: f64,
}

impl Cell {
    fn random(random: &mut Random) -> Self {
        loop {
            let center = |polar: f64, random: &mut Random| {
                let polar = polar + random.between(-0.4, 0.4);
                Vec2::new(polar.cos(), polar.sin()) * random.between(0.8, 1.6)
            };
            let centers = [center(0.0, random), center(TAU / 3.0, random), center(2.0 * TAU / 3.0, random)];
            let radii = [0; 3].map(|_| random.between(0.1, 1.0));
            let corners = [0; 3].map(|_| (random.between(0.0, 1.0) < 0.5).then(|| random.between(3.0, 12.0) as usize));
            let theta = random.between(0.0, PI);
            let apart = |i: usize, j: usize| (centers[i] - centers[j]).norm() > 1.02 * (radii[i] + radii[j]);
            if apart(0, 1) && apart(1, 2) && apart(2, 0) {
                return Self { centers, radii, corners, theta };
            }
        }
    }

    fn wall(&self, body: usize, other: usize, hand: Hand) -> Wall {
        let (center, radius) = (self.centers[body], self.radii[body]);
        let Some(corners) = self.corners[body] else {
            return Wall::of_disc(center, radius, self.theta, self.centers[other], hand);
        };
        // Corners lie at polar angles independent of the passage; the chord ends on the line of centers.
        let toward = self.centers[other] - center;
        let polar = toward.y.atan2(toward.x);
        let step = TAU / corners as f64;
        let sign = if hand == Hand::Left { 1.0 } else { -1.0 };
        let corner = |i: f64| center + radius * unit(i * step);
        let at = |polar: f64| {
            let first = (polar / step).floor();
            let (a, b) = (corner(first), corner(first + 1.0));
            let ray = unit(polar);
            a + (b - a) * (cross(ray, center - a) / cross(ray, b - a))
        };
        let back = polar - sign * PI;
        let mut points = vec![at(back)];
        let mut behind = 0;
        let indices: Vec<f64> = (-3 * corners as i64..=3 * corners as i64).map(|i| i as f64).collect();
        let mut between: Vec<f64> = indices
            .iter()
            .map(|i| i * step)
            .filter(|p| (p - back) * sign > 1e-9 && (back + sign * TAU - p) * sign > 1e-9)
            .collect();
        between.sort_by(|a, b| (a * sign).total_cmp(&(b * sign)));
        let mut is_past = false;
        for p in between {
            if !is_past && (p - polar) * sign > 1e-9 {
                points.push(at(polar));
                behind = points.len() - 1;
                is_past = true;
            }
            points.push(corner((p / step).round()));
        }
        if !is_past {
            points.push(at(polar));
            behind = points.len() - 1;
        }
        points.push(at(back));
        let points: Vec<[f64; 2]> = points.iter().map(|p| [p.x, p.y]).collect();
        polyline(&points, behind, self.theta, hand)
    }

    /// Through the chord of two bodies into the cell.
    fn passage(&self, right: usize, left: usize) -> Passage {
        Passage::new(self.wall(left, right, Hand::Left), self.wall(right, left, Hand::Right))
    }

    fn surface(&self, body: usize) -> Vec<Curve> {
        self.wall(body, (body + 1) % 3, Hand::Left).parts.iter().map(|part| part.curve).collect()
    }

    fn is_inside(&self, body: usize, x: Vec2) -> bool {
        self.surface(body).iter().map(|curve| curve.winding(x)).sum::<f64>() > PI
    }
}
