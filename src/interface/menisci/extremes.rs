//! Extrema of the curvature of menisci between two pieces of wall: there the configuration of circle and both pieces is symmetric.

use crate::interface::menisci::circle::Circle;
use crate::interface::menisci::wall::{Piece, Shape};
use crate::math::Vec2;

/// The circles of largest and smallest curvature among those that meet both pieces, extended to full circles and lines: their centers lie on the line of
/// symmetry of both. None for two lines.
pub(super) fn extreme_circles(one: &Piece, other: &Piece) -> [Option<Circle>; 2] {
    let circle =
        |x: Vec2, k: f64| (x.x.is_finite() && x.y.is_finite() && k.is_finite()).then_some(Circle { x, y: 0.0, k });
    match (one.shape, other.shape) {
        (Shape::Turn { center: c1, radius: r1 }, Shape::Turn { center: c2, radius: r2 }) => {
            let line = c2 - c1;
            let l = line.norm();
            let (d0, d1) = ((r1 - r2) * (r1 + r2), r1 * one.angle.cos() - r2 * other.angle.cos());
            // G k² − 4 b k − 4 c = 0.
            let g = (l - r1 - r2) * (l + r1 + r2) * (l + r1 - r2) * (l - r1 + r2);
            let b = r1 * one.angle.cos() * (l * l - d0) + r2 * other.angle.cos() * (l * l + d0);
            let c = (l - d1) * (l + d1);
            roots(g, 2.0 * b, -4.0 * c).map(|k| {
                let k = k?;
                let along = (k * (d0 + l * l) + 2.0 * d1) / (2.0 * l);
                circle(c1 * k + line * (along / l), k)
            })
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
    roots(g, radius * cos + distance * cos_line, -sin * sin).map(|k| {
        let k = k?;
        Some(Circle { x: center * k + normal * (cos_line - k * distance), y: 0.0, k })
    })
}

/// The roots of g k² − 2 b k + c = 0.
fn roots(g: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    let square = b * b - g * c;
    if square < 0.0 {
        return [None, None];
    }
    let sum = b + square.sqrt().copysign(b);
    [sum / g, c / sum].map(|k| k.is_finite().then_some(k))
}
