//! Closed contours: the circle or the ring formed by pieces of a drawing.
//!
//! Consecutive pieces become one ring of segments and arcs; arcs of one circle that close become that circle.

use std::f64::consts::TAU;

use super::contour::{Piece, circle_of_bulge};
use super::drawing::Ring;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::curve::cross;

/// Arcs whose centers and radii agree to this fraction of the radius lie on one circle: the error of the center of a half circle is the square root of the
/// rounding of its ends.
const ONE_CIRCLE: f64 = 1e-6;
/// Vertices closer than this fraction of the ring's size coincide.
const ONE_VERTEX: f64 = 1e-9;
/// Area of a degenerate ring over the square of its size.
const NO_AREA: f64 = 1e-12;

/// Result of closing a contour.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Closed {
    /// An exact circle.
    Circle {
        center: Vec2,
        radius: f64,
        /// Whether the contour runs around it clockwise.
        is_clockwise: bool,
    },
    /// A ring of segments and arcs.
    Ring(Ring),
    /// Degenerate: it encloses no area.
    Empty,
}

/// The closed shape of consecutive pieces; if the end is farther than `gap` from the start, both are connected by a line.
pub(crate) fn close(pieces: &[Piece], gap: f64) -> Closed {
    if let [Piece::Ellipse(arc)] = pieces
        && arc.sweep.abs() >= TAU
        && arc.is_circular()
    {
        let radius = arc.mean_radius();
        let is_clockwise = (arc.sweep < 0.0) != (cross(arc.radii[0], arc.radii[1]) < 0.0);
        return if radius > 0.0 { Closed::Circle { center: arc.center, radius, is_clockwise } } else { Closed::Empty };
    }
    let mut vertices = Vec::new();
    for piece in pieces {
        piece.append(&mut vertices);
    }
    if let Some(piece) = pieces.last() {
        let (start, end) = (pieces[0].ends()[0], piece.ends()[1]);
        if !((end - start).norm() <= gap) {
            vertices.push([end.x, end.y, 0.0]);
        }
    }
    let corners = vertices.iter().map(|vertex| Vec2::new(vertex[0], vertex[1]));
    let size = Bounds::around(corners).map_or(0.0, |bounds| bounds.size().norm());
    let (ring, _) = Ring { vertices }.without_doubled(ONE_VERTEX * size);
    if let Some((center, radius)) = one_circle(&ring.vertices) {
        let is_clockwise = ring.vertices.first().is_some_and(|vertex| vertex[2] < 0.0);
        return Closed::Circle { center, radius, is_clockwise };
    }
    let has_net_area = area(&ring.vertices).abs() > NO_AREA * size * size;
    // The signed areas of the lobes of a figure of eight, which takes three vertices, may cancel.
    let has_area = has_net_area || (ring.vertices.len() > 2 && ring.width() > ONE_VERTEX * size);
    if ring.vertices.len() < 2 || !has_area { Closed::Empty } else { Closed::Ring(ring) }
}

/// Pairs of neighboring vertices with the bulge between them, around the ring.
fn edges(vertices: &[[f64; 3]]) -> impl Iterator<Item = ([Vec2; 2], f64)> + '_ {
    let next = vertices.iter().cycle().skip(1);
    vertices.iter().zip(next).map(|(a, b)| ([Vec2::new(a[0], a[1]), Vec2::new(b[0], b[1])], a[2]))
}

/// The signed area of a ring, by Green's theorem.
pub(super) fn area(vertices: &[[f64; 3]]) -> f64 {
    let Some(first) = vertices.first() else { return 0.0 };
    let origin = Vec2::new(first[0], first[1]);
    let piece = |([a, b], bulge): ([Vec2; 2], f64)| {
        let polygon = 0.5 * cross(a - origin, b - origin);
        let Some((_, radius)) = circle_of_bulge([a, b], bulge) else { return polygon };
        let angle = 4.0 * bulge.atan();
        polygon + 0.5 * radius * radius * (angle - angle.sin())
    };
    edges(vertices).map(piece).sum()
}

/// The circle that contains all edges, if they run around it once.
fn one_circle(vertices: &[[f64; 3]]) -> Option<(Vec2, f64)> {
    let turn: f64 = vertices.iter().map(|vertex| 4.0 * vertex[2].atan()).sum();
    if (turn.abs() - TAU).abs() > ONE_CIRCLE {
        return None;
    }
    let (mut center, mut radius, mut number) = (Vec2::zeros(), 0.0, 0.0);
    let mut first = None;
    for (ends, bulge) in edges(vertices) {
        let (own_center, own_radius) = circle_of_bulge(ends, bulge)?;
        let (first_center, first_radius): (Vec2, f64) = *first.get_or_insert((own_center, own_radius));
        let distance = (own_center - first_center).norm().max((own_radius - first_radius).abs());
        if !(distance <= ONE_CIRCLE * first_radius) {
            return None;
        }
        center += own_center - first_center;
        radius += own_radius;
        number += 1.0;
    }
    first.map(|(first_center, _)| (first_center + center / number, radius / number))
}
