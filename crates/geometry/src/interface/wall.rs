//! The properties of a wall needed at a point of the plane, and contours clipped at walls.

use super::polyline::Polyline;
use meniscus_core::math::{Vec2, perpendicular};

/// The wall nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPoint {
    /// Signed distance to the nearest wall in m: above 0 in the pore, below 0 in the solid.
    pub distance: f64,
    /// Unit normal of the nearest wall, pointing into the pore.
    pub normal: Vec2,
}

impl From<(f64, Vec2)> for WallPoint {
    /// From the signed distance in m and the normal.
    fn from((distance, normal): (f64, Vec2)) -> Self {
        Self { distance, normal }
    }
}

/// The wall has an edge if its normal rotates by more than this (sine).
const TURNED: f64 = 0.8;

/// Cosine between the normals of both faces of an edge.
const BENT: f64 = 0.5;

/// Whether the walls nearest to two points (m) are the faces of an edge.
pub(crate) fn is_edge_between(wall: &dyn Fn(Vec2) -> WallPoint, behind: Vec2, ahead: Vec2) -> bool {
    wall(behind).normal.dot(&wall(ahead).normal) < BENT
}

/// Normal of the wall at a point `x` (m) of it, or of the face behind an edge next to it \[Oliver1977\]. If there is an edge within `reach` (m) to the left,
/// looking into the pore, or else to the right, that of the face behind it.
pub(crate) fn face_beside(wall: &dyn Fn(Vec2) -> WallPoint, x: Vec2, left: bool, reach: f64) -> Vec2 {
    let normal = wall(x).normal;
    let along = if left { perpendicular(normal) } else { -perpendicular(normal) };
    let there = wall(x + reach * along).normal;
    if there.dot(&along) > TURNED { there } else { normal }
}

/// The parts of `lines` in the pore, ending on the wall. Contour a field that extends a spacing or two into the solid and clip it here: a field that is missing
/// at the nodes of the solid breaks contours that meet the wall at a small angle into fragments.
pub fn clip(lines: &[Polyline], wall: &dyn Fn(Vec2) -> WallPoint) -> Vec<Polyline> {
    lines.iter().flat_map(|line| clip_line(line, wall)).collect()
}

fn clip_line(line: &Polyline, wall: &dyn Fn(Vec2) -> WallPoint) -> Vec<Polyline> {
    let mut vertices: Vec<(Vec2, f64)> = line.points.iter().map(|&p| (p, wall(p).distance)).collect();
    let Some(solid) = vertices.iter().position(|(_, d)| *d <= 0.0) else { return vec![line.clone()] };
    if line.closed {
        // A closed line starts in the solid, so that it is not cut at its arbitrary first vertex.
        vertices.rotate_left(solid);
        vertices.push(vertices[0]);
    }
    let mut pieces = Vec::new();
    let mut piece: Vec<Vec2> = Vec::new();
    for (k, &(here, d)) in vertices.iter().enumerate() {
        if k > 0 && (vertices[k - 1].1 > 0.0) != (d > 0.0) {
            let (before, d_before) = vertices[k - 1];
            piece.push(before + (here - before) * (d_before / (d_before - d)));
        }
        if d > 0.0 {
            piece.push(here);
        } else if piece.len() > 1 {
            pieces.push(std::mem::take(&mut piece));
        }
    }
    pieces.extend((piece.len() > 1).then_some(piece));
    pieces.into_iter().map(|points| Polyline { points, closed: false }).collect()
}

/// A floor at y = 0.
#[cfg(test)]
pub(super) fn floor(x: Vec2) -> WallPoint {
    WallPoint { distance: x.y, normal: Vec2::y() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(height: f64, first: f64) -> Polyline {
        let at = |i: i32| first + std::f64::consts::PI * f64::from(i) / 50.0;
        let points = (0..100).map(|i| Vec2::new(at(i).cos(), height + at(i).sin())).collect();
        Polyline { points, closed: true }
    }

    #[test]
    fn a_circle_through_the_wall_leaves_one_arc_wherever_it_begins() {
        for first in [0.0, 1.3, 4.5] {
            let arcs = clip(&[circle(0.5, first)], &floor);
            assert_eq!(arcs.len(), 1);
            let points = &arcs[0].points;
            assert!(!arcs[0].closed && points[0].y.abs() < 1e-12 && points[points.len() - 1].y.abs() < 1e-12);
            assert!(points[0].x > 0.8 && points[points.len() - 1].x < -0.8, "the order is kept");
        }
    }

    #[test]
    fn lines_in_the_pore_stay_and_lines_in_the_solid_go() {
        assert_eq!(clip(&[circle(2.0, 0.0)], &floor), vec![circle(2.0, 0.0)]);
        assert!(clip(&[circle(-2.0, 0.0)], &floor).is_empty());
    }
}
