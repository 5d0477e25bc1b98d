//! One wall of a throat in the frame of its subdomain, from behind the throat to ahead of it, truncated to the subdomain.
//!
//! The frame has its origin in the middle of the chord; the meniscus advances along x, and the wall lies above (the other wall is
//! mirrored). On either side of the chord a wall is followed until it rises above a level; if it ends sooner or is nearly parallel to x, it
//! is continued straight and steps up beside the end of the subdomain, so that both ends are alike.

use nalgebra::Rotation2;

use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::menisci::{Hand, Wall};

/// Sample points along a curve that bracket the crossing of a level before bisection.
const SAMPLES: usize = 64;
/// A double has 53 bits.
const HALVINGS: usize = 60;

/// The frame of a subdomain in the network.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Middle of the chord in m.
    pub middle: Vec2,
    /// Polar angle of the direction of advance in rad.
    pub angle: f64,
}

impl Frame {
    /// A curve of the network in the frame.
    pub(crate) fn curve(&self, curve: &Curve) -> Curve {
        curve.placed(-self.angle, -(Rotation2::new(-self.angle) * self.middle))
    }

    /// A point of the network in the frame.
    pub fn point(&self, x: Vec2) -> Vec2 {
        Rotation2::new(-self.angle) * (x - self.middle)
    }
}

/// A curve with the sign of x or y reversed.
pub(crate) fn mirrored(curve: &Curve, axis: usize) -> Curve {
    let flip = |mut v: Vec2| {
        v[axis] = -v[axis];
        v
    };
    match *curve {
        Curve::Segment { a, b } => Curve::Segment { a: flip(a), b: flip(b) },
        Curve::Arc { center, radius, start, sweep } => {
            let start = if axis == 0 { std::f64::consts::PI - start } else { -start };
            Curve::Arc { center: flip(center), radius, start, sweep: -sweep }
        }
    }
}

/// A wall of a throat in the orientation of the upper one: its curves on both sides of the chord, each side in order away from it and with x increasing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct UpperWall {
    /// Behind the chord, mirrored, and ahead of it.
    pub(crate) sides: [Vec<Curve>; 2],
}

impl UpperWall {
    /// The wall of a passage on one hand.
    pub(crate) fn of(wall: &Wall, hand: Hand, frame: &Frame) -> Self {
        let upper = |curve: &Curve| match hand {
            Hand::Left => frame.curve(curve),
            // The other wall is directed against the advance.
            Hand::Right => mirrored(&frame.curve(curve).reversed(), 1),
        };
        let curves: Vec<Curve> = wall.parts.iter().map(|part| upper(&part.curve)).collect();
        let (behind, ahead) = curves.split_at(wall.behind.min(curves.len()));
        let backwards = |curve: &Curve| mirrored(&curve.reversed(), 0);
        Self { sides: [behind.iter().rev().map(backwards).collect(), ahead.to_vec()] }
    }

    /// Height in m of each side at its point of largest x.
    pub(crate) fn widest(&self) -> [f64; 2] {
        [0, 1].map(|side| {
            let farthest = points(&self.sides[side]).max_by(|a, b| a.x.total_cmp(&b.x));
            farthest.map_or(0.0, |point| point.y)
        })
    }

    /// Largest height in m of each side.
    pub(crate) fn highest(&self) -> [f64; 2] {
        [0, 1].map(|side| points(&self.sides[side]).fold(0.0, |high: f64, point| high.max(point.y)))
    }

    /// Largest height in m between the chord and a contact in the frame of the wall; `None` if the contact is not on it.
    pub(crate) fn height_to(&self, contact: Vec2, tolerance: f64) -> Option<f64> {
        [Vec2::new(-contact.x, contact.y), contact].into_iter().zip(&self.sides).find_map(|(contact, side)| {
            let on = side.iter().position(|curve| (curve.project(contact).point - contact).norm() <= tolerance)?;
            let end = side[on].project(contact).u;
            let last = side[on].part(0.0, end);
            let before = side[..on].iter().chain([&last]);
            Some(before.flat_map(|curve| sampled(curve, 1.0)).fold(contact.y, |high, point| high.max(point.y)))
        })
    }
}

fn sampled(curve: &Curve, to: f64) -> impl Iterator<Item = Vec2> + use<> {
    let curve = *curve;
    (0..=SAMPLES).map(move |k| curve.point(to * k as f64 / SAMPLES as f64))
}

fn points(curves: &[Curve]) -> impl Iterator<Item = Vec2> {
    curves.iter().flat_map(|curve| sampled(curve, 1.0))
}

/// One side of a wall, truncated to the subdomain.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Followed {
    /// Its curves from the chord on.
    pub(crate) curves: Vec<Curve>,
    /// Its end point.
    pub(crate) end: Vec2,
    /// Whether it has risen to the level.
    pub(crate) is_risen: bool,
}

impl Followed {
    /// Largest x in m.
    pub(crate) fn farthest(&self) -> f64 {
        points(&self.curves).map(|point| point.x).fold(self.end.x, f64::max)
    }

    /// Whether a point lies on it.
    pub(crate) fn contains(&self, x: Vec2, tolerance: f64) -> bool {
        self.curves.iter().any(|curve| (curve.project(x).point - x).norm() <= tolerance)
    }
}

/// Follows one side of a wall from `start`, the end of the chord, until it rises to the height `level` or reaches x = `reach`, in m.
pub(crate) fn follow(side: &[Curve], start: Vec2, level: f64, reach: f64) -> Followed {
    let mut curves: Vec<Curve> = Vec::new();
    let is_out = |point: Vec2| point.y >= level || point.x >= reach;
    for curve in side {
        let at = |k: usize| k as f64 / SAMPLES as f64;
        let Some(k) = (0..=SAMPLES).find(|&k| is_out(curve.point(at(k)))) else {
            curves.push(*curve);
            continue;
        };
        let (mut low, mut high) = (at(k.saturating_sub(1)), at(k));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if is_out(curve.point(middle)) { high = middle } else { low = middle }
        }
        if high > 0.0 {
            curves.push(curve.part(0.0, high));
        }
        let end = curve.point(high);
        return Followed { curves, end, is_risen: end.y >= level };
    }
    up_to_highest(side, start)
}

/// A side that does not rise to the level: up to its highest point, past which it descends behind the body.
fn up_to_highest(side: &[Curve], start: Vec2) -> Followed {
    let (mut end, mut last) = (start, None);
    for (index, curve) in side.iter().enumerate() {
        for k in 1..=SAMPLES {
            let point = curve.point(k as f64 / SAMPLES as f64);
            if point.y > end.y {
                (end, last) = (point, Some((index, k)));
            }
        }
    }
    let Some((index, k)) = last else { return Followed { curves: Vec::new(), end, is_risen: false } };
    let mut curves = side[..index].to_vec();
    curves.push(if k == SAMPLES { side[index] } else { side[index].part(0.0, k as f64 / SAMPLES as f64) });
    Followed { curves, end, is_risen: false }
}
