//! Walls along which contact lines advance, divided into pieces on which the motion of a contact has a closed form.
//!
//! A contact is given by its point P and the direction μ (polar angle) in which the interface leaves the wall. Along a smooth piece of contact angle θ, μ
//! rotates with the wall. At an edge, and where the contact angle of the wall changes, P is pinned and μ rotates: between θ on the near face and θ on the far
//! face, the Gibbs condition. At a reentrant corner μ rotates backwards: the limit of a fillet of vanishing radius, across which the contact jumps.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::curve::{Curve, cross, unit};
use meniscus_core::math::{Vec2, perpendicular};

/// A piece of a wall and the contact angle on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPart {
    /// Geometry of the piece, solid on the left; positions in m.
    pub curve: Curve,
    /// Contact angle through the defending phase in rad, 0 to π.
    pub angle: f64,
}

/// A wall along which a contact advances: parts in the order of the advance. Curves keep their orientation, solid on the left.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Wall {
    /// The parts in the order of the advance; each begins where the previous one ends.
    pub parts: Vec<WallPart>,
    /// Number of parts behind the chord of the throat: the chord ends where they end.
    pub behind: usize,
}

impl Wall {
    /// The whole surface of a disc, cut opposite to the chord, which ends at the point nearest to `other`.
    pub fn of_disc(center: Vec2, radius: f64, angle: f64, other: Vec2, hand: Hand) -> Self {
        let toward = other - center;
        let start = toward.y.atan2(toward.x) - PI;
        let half = |start: f64| WallPart { curve: Curve::Arc { center, radius, start, sweep: PI }, angle };
        let mut parts = vec![half(start), half(start + PI)];
        if hand == Hand::Right {
            parts.reverse();
        }
        Self { parts, behind: 1 }
    }
}

/// Side of the direction of advance on which a wall lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hand {
    /// Wall curves run with the advance.
    Left,
    /// Wall curves run against the advance.
    Right,
}

impl Hand {
    /// 1 on the left, −1 on the right.
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }
}

/// Where the interface meets a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Index of the part of the wall; at an edge that of the part before it.
    pub part: usize,
    /// Parameter on its curve.
    pub u: f64,
    /// Position in m.
    pub point: Vec2,
    /// Arc length of wall from the chord of the throat to the contact in m; below 0 behind the chord.
    pub advance: f64,
}

/// A piece on which a contact moves while `s` runs from 0 to 1 in the direction of advance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(crate) shape: Shape,
    /// Direction of the interface at both ends, continuous along the wall.
    pub(crate) direction: [f64; 2],
    /// Contact angle; 0 at an edge, where it does not enter.
    pub angle: f64,
    /// Polar angle of the wall normal minus `direction`.
    pub(crate) offset: f64,
    pub part: usize,
    /// Arc length of wall from the chord to the start.
    pub advance: f64,
    pub(crate) length: f64,
    pub(crate) hand: Hand,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Shape {
    /// From `a` along the vector `along`.
    Straight { a: Vec2, along: Vec2 },
    /// About a center: circular walls, radius below 0 where the solid is concave, and edges of radius 0.
    Turn { center: Vec2, radius: f64 },
}

impl Piece {
    pub(crate) fn direction(&self, s: f64) -> f64 {
        self.direction[0] + s * (self.direction[1] - self.direction[0])
    }

    /// The normal of the wall, out of the solid. At an edge: of the tangent that would meet the interface at the angle 0.
    pub(crate) fn normal(&self, s: f64) -> Vec2 {
        unit(self.direction(s) + self.offset)
    }

    pub(crate) fn point(&self, s: f64) -> Vec2 {
        match self.shape {
            Shape::Straight { a, along } => a + along * s,
            Shape::Turn { center, .. } if self.is_edge() => center,
            Shape::Turn { center, radius } => center + self.normal(s) * radius,
        }
    }

    /// Unit vector from the contact towards the center of a circle of positive curvature.
    pub(crate) fn inward(&self, s: f64) -> Vec2 {
        // The interface leaves the wall along `direction`; its center lies behind it.
        unit(self.direction(s) - self.hand.sign() * FRAC_PI_2)
    }

    /// Arc length of wall from the chord to the contact.
    pub(crate) fn advance_at(&self, s: f64) -> f64 {
        self.advance + s * self.length
    }

    /// Derivatives of the contact point and of the direction with respect to `s`.
    pub(crate) fn rates(&self, s: f64) -> (Vec2, f64) {
        let turn = self.direction[1] - self.direction[0];
        match self.shape {
            Shape::Straight { along, .. } => (along, turn),
            Shape::Turn { radius, .. } => (perpendicular(self.normal(s)) * (radius * turn), turn),
        }
    }

    /// Whether this piece is an edge, where the contact line is pinned \[Oliver1977\].
    pub(crate) fn is_edge(&self) -> bool {
        self.length == 0.0
    }

    /// The parameter of the polar angle `direction`, in the turn nearest to the piece; not limited to 0..1.
    pub(crate) fn parameter(&self, direction: f64) -> f64 {
        let [from, to] = self.direction;
        let middle = 0.5 * (from + to);
        0.5 + wrapped(direction - middle) / (to - from)
    }

    /// The contact on this piece of a circle that meets the other wall at `p`, leaving it at the polar angle `direction`; not limited to 0..1. The chord
    /// makes the same angle with the interface at both of its ends.
    pub(crate) fn answer(&self, p: Vec2, direction: f64) -> Option<f64> {
        match self.shape {
            Shape::Straight { a, along } => {
                let chord = unit(0.5 * (direction + self.direction[0] - PI));
                let across = cross(along, chord);
                let s = cross(p - a, chord) / across;
                // Parallel within rounding.
                (across.abs() > 1e-14 * along.norm()).then_some(s)
            }
            Shape::Turn { center, radius } => {
                // With χ half of the direction sought: A sin χ + B cos χ = 0.
                let g = 0.5 * (direction - PI);
                let (sin, cos) = g.sin_cos();
                let (shifted_sin, shifted_cos) = (g - self.offset).sin_cos();
                let d = center - p;
                let a = d.x * cos + d.y * sin - radius * shifted_cos;
                let b = d.x * sin - d.y * cos + radius * shifted_sin;
                (a != 0.0 || b != 0.0).then(|| self.parameter(2.0 * (-b).atan2(a)))
            }
        }
    }
}

/// The angle modulo 2π, from −π to π.
pub(super) fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// The pieces of a wall, lengths divided by `scale` and positions relative to `origin`, and the index of the first one ahead of the chord: the edge there, if
/// any.
pub(super) fn pieces(wall: &Wall, hand: Hand, origin: Vec2, scale: f64) -> (Vec<Piece>, usize) {
    let mut pieces: Vec<Piece> = Vec::with_capacity(2 * wall.parts.len());
    let mut first_ahead = 0;
    for (part, WallPart { curve, angle }) in wall.parts.iter().enumerate() {
        let mut piece = smooth_piece(curve, *angle, hand, part, origin, scale);
        if !(piece.length > 0.0) {
            continue;
        }
        if let Some(before) = pieces.last() {
            piece.advance = before.advance + before.length;
            let mut turn = wrapped(piece.direction[0] - before.direction[1]);
            // A wall that doubles back does so around a thin solid, not around a thin pore.
            if hand.sign() * turn < -PI + 1e-9 {
                turn += hand.sign() * TAU;
            }
            let from = before.direction[1];
            let shift = from + turn - piece.direction[0];
            piece.direction = piece.direction.map(|direction| direction + shift);
            // Smooth within the rounding of the ends.
            if turn.abs() > 1e-9 {
                pieces.push(Piece {
                    shape: Shape::Turn { center: piece.point(0.0), radius: 0.0 },
                    direction: [from, from + turn],
                    angle: 0.0,
                    offset: -hand.sign() * FRAC_PI_2,
                    part: before.part,
                    advance: piece.advance,
                    length: 0.0,
                    hand,
                });
            }
        }
        pieces.push(piece);
        if part < wall.behind {
            first_ahead = pieces.len();
        }
    }
    let chord = pieces.get(first_ahead).map(|piece| piece.advance);
    let chord = chord.or_else(|| pieces.last().map(|last| last.advance + last.length)).unwrap_or(0.0);
    pieces.iter_mut().for_each(|piece| piece.advance -= chord);
    (pieces, first_ahead)
}

fn smooth_piece(curve: &Curve, angle: f64, hand: Hand, part: usize, origin: Vec2, scale: f64) -> Piece {
    let begin = match hand {
        Hand::Left => 0.0,
        Hand::Right => 1.0,
    };
    let offset = -hand.sign() * (FRAC_PI_2 - angle);
    let local = |x: Vec2| (x - origin) / scale;
    let (shape, normal, turn) = match *curve {
        Curve::Segment { .. } => {
            let normal = curve.normal(0.5);
            let (a, b) = (local(curve.point(begin)), local(curve.point(1.0 - begin)));
            (Shape::Straight { a, along: b - a }, normal.y.atan2(normal.x), 0.0)
        }
        Curve::Arc { center, radius, start, sweep } => {
            let convex = sweep.signum();
            let normal = start + sweep * begin + if sweep < 0.0 { PI } else { 0.0 };
            (Shape::Turn { center: local(center), radius: convex * radius / scale }, normal, hand.sign() * sweep)
        }
    };
    let direction = normal - offset;
    let length = curve.length() / scale;
    Piece { shape, direction: [direction, direction + turn], angle, offset, part, advance: 0.0, length, hand }
}
