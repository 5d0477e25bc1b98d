//! Extrema of the curvature of menisci between two pieces of wall: there the configuration of circle and both pieces is symmetric.

use crate::interface::menisci::circle::{Circle, roots};
use crate::interface::menisci::wall::{Piece, Shape};
use meniscus_core::math::Vec2;

/// The circles of largest and smallest curvature among those that meet both pieces, extended to full circles and lines: their centers lie on the line of
/// symmetry of both. None for two lines.
pub(super) fn extreme_circles(one: &Piece, other: &Piece) -> [Option<Circle>; 2] {
    match (one.shape, other.shape) {
        (Shape::Turn { center: c1, radius: r1 }, Shape::Turn { center: c2, radius: r2 }) => {
            let line = c2 - c1;
            let l = line.norm();
            let (d0, d1) = ((r1 - r2) * (r1 + r2), r1 * one.angle.cos() - r2 * other.angle.cos());
            // G k² − 4 b k − 4 c = 0.
            let g = (l - r1 - r2) * (l + r1 + r2) * (l + r1 - r2) * (l - r1 + r2);
            let b = r1 * one.angle.cos() * (l * l - d0) + r2 * other.angle.cos() * (l * l + d0);
            let c = (l - d1) * (l + d1);
            symmetric(g, -2.0 * b, -4.0 * c, |k| c1 * k + line * ((k * (d0 + l * l) + 2.0 * d1) / (2.0 * l) / l))
        }
        (Shape::Turn { center, radius }, Shape::Straight { a, .. }) => beside_line(center, radius, one, a, other),
        (Shape::Straight { a, .. }, Shape::Turn { center, radius }) => beside_line(center, radius, other, a, one),
        (Shape::Straight { .. }, Shape::Straight { .. }) => [None, None],
    }
}

fn beside_line(center: Vec2, radius: f64, round: &Piece, a: Vec2, straight: &Piece) -> [Option<Circle>; 2] {
    let normal = straight.normal(0.0);
    let distance = normal.dot(&(center - a));
    let (cos, (sin, cos_line)) = (round.angle.cos(), straight.angle.sin_cos());
    let g = (distance - radius) * (distance + radius);
    let at = |k: f64| center * k + normal * (cos_line - k * distance);
    symmetric(g, -(radius * cos + distance * cos_line), -sin * sin, at)
}

/// The circles whose curvatures solve g k² + 2 b k + c = 0, `x` being their center times k.
fn symmetric(g: f64, b: f64, c: f64, x: impl Fn(f64) -> Vec2) -> [Option<Circle>; 2] {
    let circle = |k: f64| Circle { x: x(k), y: 0.0, k };
    let is_finite = |circle: &Circle| circle.x.iter().all(|x| x.is_finite()) && circle.k.is_finite();
    roots(g, b, c, 0.0).map_or([None, None], |both| both.map(|k| Some(circle(k)).filter(is_finite)))
}
