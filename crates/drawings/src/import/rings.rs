//! Rings as read from files, and their repairs: a small gap at the end, duplicate vertices.

use crate::import::drawing::{Drawing, FillRule, Outline, Refusal, Ring};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::body::bulged_ring;
use meniscus_geometry::curve::cross;

/// Gaps between the first and last point below this fraction of the ring's larger side are closed.
const GAP: f64 = 1e-6;

/// Vertices nearer than this fraction of the drawing's larger side coincide.
pub(crate) const DOUBLED: f64 = 1e-9;

/// The ring of a line whose last point repeats its first one, as in WKT, GeoJSON and shapefiles.
///
/// # Errors
/// What was found, and what was expected.
pub(crate) fn of_closed_line(points: &[[f64; 2]]) -> Result<Ring, (String, String)> {
    if let Some((i, point)) = points.iter().enumerate().find(|(_, p)| !p.iter().all(|v| v.is_finite())) {
        let found = format!("point {i} at {point:?}");
        return Err((found, "finite numbers".into()));
    }
    let [first, middle @ .., last] = points else { return Err(too_few(points.len())) };
    if middle.len() < 2 {
        return Err(too_few(points.len()));
    }
    let bounds = bounds_of_points(points.iter().map(|&p| Vec2::from(p)));
    let gap = (Vec2::from(*last) - Vec2::from(*first)).norm();
    if !(gap <= GAP * bounds.size().max()) {
        let ([x, y], [u, v]) = (first, last);
        let found = format!("a line from ({x:e}, {y:e}) to ({u:e}, {v:e})");
        return Err((found, "a closed ring, whose last point repeats the first point".into()));
    }
    let vertices = std::iter::once(first).chain(middle).map(|&[x, y]| [x, y, 0.0]).collect();
    Ok(Ring { vertices })
}

impl Drawing {
    /// Adds a polygon by lines whose last points repeat their first ones; an empty one is counted. A line is `None` if a point has no x or y.
    ///
    /// # Errors
    /// What is wrong with its rings.
    pub(crate) fn add_polygon(&mut self, lines: Vec<Option<Vec<[f64; 2]>>>, location: &str) -> Vec<Refusal> {
        let (mut found, mut bad) = (Vec::new(), Vec::new());
        if lines.is_empty() {
            self.count("empty geometries", 1);
        }
        for (k, line) in lines.into_iter().enumerate() {
            let incomplete = || ("a point without x and y".to_owned(), "points [x, y]".to_owned());
            match line.ok_or_else(incomplete).and_then(|line| of_closed_line(&line)) {
                Ok(ring) => found.push(ring),
                Err((what, expected)) => bad.push(Refusal::new(location, format!("ring {k}: {what}"), expected)),
            }
        }
        if !found.is_empty() {
            self.add(Outline::Area { rings: found, rule: FillRule::EvenOdd }, location.to_owned());
        }
        bad
    }
}

fn too_few(count: usize) -> (String, String) {
    (format!("{count} point(s)"), "three points or more, and the first point again".into())
}

/// The bounding box of points; empty without points.
pub(crate) fn bounds_of_points(points: impl Iterator<Item = Vec2>) -> Bounds {
    Bounds::around(points).unwrap_or(Bounds::EMPTY)
}

impl Ring {
    /// The bounding box of the ring, including its arcs.
    pub(crate) fn bounds(&self) -> Bounds {
        bulged_ring(&self.vertices).fold(Bounds::EMPTY, |all, curve| all.united(&curve.bounds()))
    }

    /// Signed area, positive if counter-clockwise.
    pub(crate) fn area(&self) -> f64 {
        let Some(&[x, y, _]) = self.vertices.first() else { return 0.0 };
        bulged_ring(&self.vertices).map(|curve| curve.area_about(Vec2::new(x, y))).sum()
    }

    /// Extent of the ring across the line through its first vertex and the one farthest from it; 0 for zero area.
    pub(crate) fn width(&self) -> f64 {
        let Some(&[x, y, _]) = self.vertices.first() else { return 0.0 };
        let points = bulged_ring(&self.vertices).flat_map(|curve| [curve.point(0.0), curve.point(0.5)]);
        let from_first: Vec<Vec2> = points.map(|point| point - Vec2::new(x, y)).collect();
        let farthest = from_first.iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        let Some(along) = farthest.and_then(|far| far.try_normalize(0.0)) else { return 0.0 };
        from_first.iter().map(|point| cross(along, *point).abs()).fold(0.0, f64::max)
    }

    /// Whether every edge is straight.
    pub(crate) fn is_straight(&self) -> bool {
        self.vertices.iter().all(|vertex| vertex[2] == 0.0)
    }

    /// The ring in reverse order.
    pub(crate) fn reversed(&self) -> Self {
        let n = self.vertices.len();
        // The edge that starts at a vertex is now the one that ended there.
        let vertices = (0..n).rev().map(|i| {
            let ([x, y, _], [_, _, bulge]) = (self.vertices[i], self.vertices[(i + n - 1) % n]);
            [x, y, if bulge == 0.0 { 0.0 } else { -bulge }]
        });
        Self { vertices: vertices.collect() }
    }

    /// The ring with all lengths multiplied by `scale`.
    pub(crate) fn scaled(&self, scale: f64) -> Self {
        Self { vertices: self.vertices.iter().map(|&[x, y, bulge]| [x * scale, y * scale, bulge]).collect() }
    }

    /// The ring without duplicate vertices, and their number.
    pub(crate) fn without_doubled(&self, tolerance: f64) -> (Self, usize) {
        let mut vertices: Vec<[f64; 3]> = Vec::with_capacity(self.vertices.len());
        let is_near = |a: &[f64; 3], b: &[f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]) <= tolerance;
        for vertex in &self.vertices {
            match vertices.last_mut() {
                // The edge between the two is removed, with its bulge.
                Some(last) if is_near(last, vertex) => last[2] = vertex[2],
                _ => vertices.push(*vertex),
            }
        }
        while vertices.len() > 1 && is_near(&vertices[0], &vertices[vertices.len() - 1]) {
            vertices.pop();
        }
        let doubled = self.vertices.len() - vertices.len();
        (Self { vertices }, doubled)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_turned_round_has_the_opposite_area_and_the_same_box() {
        let ring = Ring { vertices: vec![[0.0, 0.0, 0.3], [2.0, 0.0, -0.1], [2.0, 1.0, 0.0], [0.0, 1.0, 0.7]] };
        let back = ring.reversed();
        assert!((ring.area() + back.area()).abs() < 1e-14);
        assert!((ring.bounds().size() - back.bounds().size()).norm() < 1e-14);
        assert!((back.reversed().area() - ring.area()).abs() < 1e-15);
    }

    #[test]
    fn a_small_gap_is_closed_and_a_large_one_is_not() {
        let line = |gap: f64| [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [gap, 0.0]];
        assert_eq!(of_closed_line(&line(1e-7)).unwrap().vertices.len(), 3);
        assert!(of_closed_line(&line(1e-5)).unwrap_err().0.contains("1e-5"));
        assert!(of_closed_line(&[[0.0; 2], [1.0, 0.0], [0.0; 2]]).is_err());
        assert!(of_closed_line(&[[0.0; 2], [f64::NAN, 0.0], [0.0, 1.0], [0.0; 2]]).is_err());
    }

    #[test]
    fn doubled_vertices_go_with_the_edge_between_them() {
        let ring = Ring {
            vertices: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 0.5], [0.0, 1.0, 0.0], [0.0, 1e-12, 0.0]],
        };
        let (clean, doubled) = ring.without_doubled(1e-9);
        assert_eq!((clean.vertices, doubled), (vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.5], [0.0, 1.0, 0.0]], 2));
    }
}
