//! Polylines with a width: the band along the line, with mitred corners and flat ends, and the inside of a closed one.

use std::f64::consts::PI;

use crate::import::combine::Solid;
use crate::import::contour::Piece;
use crate::import::drawing::Ring;
use meniscus_core::math::{Bounds, Vec2, perpendicular};
use meniscus_geometry::body::bulged_ring;
use meniscus_geometry::curve::{Curve, cross};
use meniscus_geometry::rings::faults;

/// Lengths below this fraction of the size of the polyline count as zero.
const TOLERANCE: f64 = 1e-9;
/// Maximum length of a mitre over the half width; sharper corners are cut off.
const MITRE: f64 = 4.0;

/// Maximum number of edges of a polyline with a width: each is compared with all that it overlaps.
const MOST: usize = 5000;

/// A vertex of a polyline: the edge that starts there has this bulge and these widths at its two ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Vertex {
    /// Its position.
    pub(crate) point: Vec2,
    /// The tangent of a quarter of the angle of the edge.
    pub(crate) bulge: f64,
    /// Widths at the start and at the end of the edge.
    pub(crate) width: [f64; 2],
}

/// An edge and its half widths.
struct Edge {
    curve: Curve,
    half: [f64; 2],
}

/// The closed outlines of the area covered by a polyline; on failure what was found, and what was expected.
pub(crate) fn outlines(vertices: &[Vertex], is_closed: bool) -> Result<Vec<Vec<Piece>>, (String, &'static str)> {
    if let Some(width) = vertices.iter().flat_map(|v| v.width).find(|width| !(*width >= 0.0)) {
        return Err((format!("a width of {width}"), "widths of 0 or more"));
    }
    let edges = edges(vertices, is_closed);
    if edges.len() > MOST {
        let found = format!("a polyline of {} edges with a width", edges.len());
        return Err((found, "its outline as a polyline of width 0"));
    }
    let size = Bounds::around(vertices.iter().map(|v| v.point)).map_or(0.0, |bounds| bounds.size().norm());
    let most = vertices.iter().flat_map(|v| v.width).fold(0.0, f64::max);
    let tolerance = TOLERANCE * (size + most);
    let mut parts: Vec<Ring> = Vec::new();
    for edge in &edges {
        parts.extend(band(edge, tolerance)?);
    }
    let next = edges.iter().cycle().skip(1);
    let joints = if is_closed { edges.len() } else { edges.len().saturating_sub(1) };
    parts.extend(edges.iter().zip(next).take(joints).filter_map(|(a, b)| joint(a, b, tolerance)));
    if is_closed {
        let ring = Ring { vertices: edges.iter().map(|edge| edge.curve.vertex()).collect() };
        let curves: Vec<Curve> = bulged_ring(&ring.vertices).collect();
        if !faults(&[curves]).is_empty() {
            return Err((
                "a closed polyline with a width that crosses itself".to_owned(),
                "its outlines as polylines of width 0",
            ));
        }
        parts.extend(Some(ring).filter(|ring| ring.width() > tolerance));
    }
    let solids: Vec<Solid> = parts.iter().filter_map(Solid::of_ring).collect();
    let united = Solid::united(&solids, tolerance).ok_or_else(|| {
        let found = "a polyline whose sides touch in a point".to_owned();
        (found, "another width, or its outlines as polylines of width 0")
    })?;
    let rings = united.into_iter().flat_map(|(outer, holes)| std::iter::once(outer).chain(holes));
    Ok(rings.map(|ring| pieces(&ring, tolerance)).collect())
}

fn edges(vertices: &[Vertex], is_closed: bool) -> Vec<Edge> {
    let n = vertices.len();
    let pairs = (0..if is_closed { n } else { n - 1 }).map(|i| (vertices[i], vertices[(i + 1) % n]));
    let edge = |(a, b): (Vertex, Vertex)| Edge {
        curve: Curve::from_bulge(a.point, b.point, a.bulge),
        half: a.width.map(|width| 0.5 * width),
    };
    pairs.filter(|(a, b)| a.point != b.point).map(edge).collect()
}

/// The area covered by an edge, each ring counter-clockwise; empty without width.
fn band(edge: &Edge, tolerance: f64) -> Result<Vec<Ring>, (String, &'static str)> {
    let [a, b] = edge.half;
    if a.max(b) <= tolerance {
        return Ok(Vec::new());
    }
    let straight = |points: &[Vec2]| Ring { vertices: points.iter().map(|p| [p.x, p.y, 0.0]).collect() };
    let ends = [0.0, 1.0].map(|u| edge.curve.point(u));
    match edge.curve {
        Curve::Segment { .. } => {
            let side = perpendicular(edge.curve.tangent(0.0));
            let mut points = vec![ends[0] - side * a, ends[1] - side * b];
            if b > tolerance {
                points.push(ends[1] + side * b);
            }
            if a > tolerance {
                points.push(ends[0] + side * a);
            }
            Ok(vec![straight(&points)])
        }
        Curve::Arc { .. } if (a - b).abs() > tolerance => {
            Err((format!("an arc whose width changes from {} to {}", 2.0 * a, 2.0 * b), "arcs of one width"))
        }
        Curve::Arc { center, radius, sweep, .. } => {
            let arms = ends.map(|end| (end - center) / radius);
            let bulge = (0.25 * sweep).tan();
            let with = |p: Vec2, bulge: f64| [p.x, p.y, bulge];
            let (outer, inner) = (radius + a, radius - a);
            let on = |radius: f64| arms.map(|arm| center + arm * radius);
            let pie = |radius: f64| {
                let [from, to] = on(radius);
                Ring { vertices: vec![with(from, bulge), with(to, 0.0), with(center, 0.0)] }
            };
            if inner > tolerance {
                let ([from, to], [first, last]) = (on(outer), on(inner));
                let vertices = vec![with(from, bulge), with(to, 0.0), with(last, -bulge), with(first, 0.0)];
                return Ok(vec![Ring { vertices }]);
            }
            if sweep.abs() > 1.5 * PI {
                let found = format!("an arc of radius {radius} and width {}", 2.0 * a);
                return Err((
                    found,
                    "arcs of less than three quarters of a circle where the width is twice the radius",
                ));
            }
            // The band passes over the center.
            Ok(std::iter::once(outer).chain((inner < -tolerance).then_some(inner)).map(pie).collect())
        }
    }
}

/// The fill of the outer side of a corner between two edges; `None` if they join smoothly or have no width.
fn joint(before: &Edge, after: &Edge, tolerance: f64) -> Option<Ring> {
    let (t, s) = (before.curve.tangent(1.0), after.curve.tangent(0.0));
    let turn = cross(t, s).atan2(t.dot(&s));
    let (a, b) = (before.half[1], after.half[0]);
    if a.min(b) <= tolerance || turn.abs() * a.max(b) <= tolerance {
        return None;
    }
    let corner = before.curve.point(1.0);
    let side = -turn.signum();
    let [from, to] = [(t, a), (s, b)].map(|(along, half)| corner + perpendicular(along) * (side * half));
    let mut points = vec![corner, from];
    // At steps of the width, where the widths differ, there is no mitre.
    let reach = 1.0 / (0.5 * turn).cos();
    if (a - b).abs() <= tolerance && reach <= MITRE {
        let across = (from - corner) + (to - corner);
        points.extend(across.try_normalize(0.0).map(|along| corner + along * (a * reach)));
    }
    points.push(to);
    Some(Ring { vertices: points.iter().map(|p| [p.x, p.y, 0.0]).collect() })
}

/// The ring as pieces, without vertices on straight edges.
fn pieces(ring: &Ring, tolerance: f64) -> Vec<Piece> {
    let n = ring.vertices.len();
    let at = |i: usize| Vec2::new(ring.vertices[i % n][0], ring.vertices[i % n][1]);
    let is_needed = |i: &usize| {
        let (before, here, after) = (at(i + n - 1), at(*i), at(i + 1));
        let is_straight = ring.vertices[(i + n - 1) % n][2] == 0.0 && ring.vertices[*i][2] == 0.0;
        let along = (after - before).try_normalize(0.0);
        !is_straight || along.is_none_or(|along| cross(along, here - before).abs() > tolerance)
    };
    let kept: Vec<usize> = (0..n).filter(is_needed).collect();
    let next = kept.iter().cycle().skip(1);
    kept.iter().zip(next).map(|(&i, &j)| Piece::from_bulge([at(i), at(j)], ring.vertices[i][2])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::closing::{Closed, close};

    fn vertex([x, y]: [f64; 2], bulge: f64, width: f64) -> Vertex {
        Vertex { point: Vec2::new(x, y), bulge, width: [width; 2] }
    }

    /// Area and number of outlines; the area of holes is negative.
    fn covered(vertices: &[Vertex], is_closed: bool) -> (f64, usize) {
        let all = outlines(vertices, is_closed).unwrap();
        let areas = all.iter().map(|pieces| match close(pieces, 1e-12) {
            Closed::Ring(ring) => ring.area(),
            Closed::Circle { radius, is_clockwise, .. } => PI * radius * radius * if is_clockwise { -1.0 } else { 1.0 },
            Closed::Empty => 0.0,
        });
        (areas.sum(), all.len())
    }

    #[test]
    fn bands_have_the_area_of_closed_formulas() {
        let path = |points: &[[f64; 2]], width: f64| points.iter().map(|&p| vertex(p, 0.0, width)).collect::<Vec<_>>();
        let corner = path(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]], 1.0);
        let square = path(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], 1.0);
        let backwards: Vec<Vertex> = square.iter().rev().copied().collect();
        let crossing = path(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 4.0], [2.0, -2.0]], 1.0);
        let half_circle = vec![vertex([1.0, 0.0], 1.0, 0.5), vertex([-1.0, 0.0], 0.0, 0.5)];
        let disc = vec![vertex([-1.0, 0.0], 1.0, 2.0), vertex([1.0, 0.0], 1.0, 2.0)];
        let taper = vec![Vertex { width: [1.0, 2.0], ..vertex([0.0; 2], 0.0, 0.0) }, vertex([3.0, 0.0], 0.0, 0.0)];
        for (name, vertices, is_closed, area, count) in [
            ("corner", corner, false, 7.0, 1),
            ("square", square, true, 25.0, 1),
            ("backwards", backwards, true, 25.0, 1),
            ("crossing", crossing, false, 4.5 + 3.0 + 3.0 + 4.5, 2),
            ("half circle", half_circle, false, PI * 0.5, 1),
            ("disc", disc, true, 4.0 * PI, 1),
            ("taper", taper, false, 4.5, 1),
        ] {
            let (found, number) = covered(&vertices, is_closed);
            assert!((found - area).abs() < 1e-9 && number == count, "{name}: {found} {number}");
        }
    }

    #[test]
    fn what_has_no_one_outline_is_refused() {
        let arc = [Vertex { width: [1.0, 2.0], ..vertex([0.0; 2], 1.0, 0.0) }, vertex([3.0, 0.0], 0.0, 0.0)];
        assert!(outlines(&arc, false).unwrap_err().0.contains("changes from 1 to 2"));
        let bow = [[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]].map(|p| vertex(p, 0.0, 0.1));
        assert!(outlines(&bow, true).unwrap_err().0.contains("crosses itself"));
        assert!(outlines(&[vertex([0.0; 2], 0.0, -1.0), vertex([1.0, 0.0], 0.0, 0.0)], false).is_err());
    }
}
