//! Smooth walls behind polygons: runs of vertices with small angles become arcs through these vertices, real corners stay.
//!
//! A drawing program samples curves; a polygon has a corner at each sample, which pins menisci, unlike a curved wall. A vertex is smooth if its angle is below
//! a threshold, in a run of at least three. The tangent of the wall there is that of the circle through the vertex and its neighbors, and between two vertices
//! there is a biarc: two arcs with a common tangent. An edge much longer than its neighbors is a straight wall and stays one. Arcs of one circle are joined.

use crate::import::drawing::Ring;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::cross;

/// Minimum number of consecutive smooth vertices; a single one is a blunt corner.
const FEWEST: usize = 3;

/// Length of a straight wall over its shorter neighbor.
const LONG: f64 = 4.0;

/// Relative difference of arcs of one circle over the radius.
const SAME_CIRCLE: f64 = 1e-5;

/// Largest angle of a joined arc in rad: a half circle, up to rounding.
const LARGEST_ARC: f64 = std::f64::consts::PI * (1.0 + 1e-9);

/// The ring with arcs instead of its smooth runs, `below` in rad; `None` if it has none.
pub(crate) fn smoothed(ring: &Ring, below: f64) -> Option<Ring> {
    let points: Vec<Vec2> = ring.vertices.iter().map(|v| Vec2::new(v[0], v[1])).collect();
    let n = points.len();
    if n < FEWEST || !ring.is_straight() {
        return None;
    }
    let is_smooth = smooth_vertices(&points, below);
    if !is_smooth.contains(&true) {
        return None;
    }
    let edge = |i: usize| points[(i + 1) % n] - points[i];
    // A long edge is a separate wall if it ends in a run.
    let is_long: Vec<bool> = (0..n)
        .map(|i| {
            let (before, after) = (edge((i + n - 1) % n).norm(), edge((i + 1) % n).norm());
            let shorter = match (is_smooth[i], is_smooth[(i + 1) % n]) {
                (true, true) => before.min(after),
                (true, false) => before,
                (false, true) => after,
                (false, false) => return true,
            };
            edge(i).norm() > LONG * shorter
        })
        .collect();
    let tangent = |i: usize| -> Option<Vec2> {
        let before = (i + n - 1) % n;
        match (is_long[before], is_long[i]) {
            _ if !is_smooth[i] => None,
            (true, false) => edge(before).try_normalize(0.0),
            (false, true) => edge(i).try_normalize(0.0),
            (true, true) => None,
            (false, false) => circle_tangent(points[before], points[i], points[(i + 1) % n]),
        }
    };
    let tangents: Vec<Option<Vec2>> = (0..n).map(tangent).collect();
    let mut vertices: Vec<[f64; 3]> = Vec::with_capacity(n);
    for i in 0..n {
        let (a, b) = (points[i], points[(i + 1) % n]);
        let chord = b - a;
        // If only one end is smooth, the arc has the tangent there and any at the other end.
        let (ta, tb) = match (tangents[i], tangents[(i + 1) % n]) {
            _ if is_long[i] => (chord, chord),
            (Some(ta), Some(tb)) => (ta, tb),
            (Some(ta), None) => (ta, mirrored(ta, chord)),
            (None, Some(tb)) => (mirrored(tb, chord), tb),
            (None, None) => (chord, chord),
        };
        let straight = is_long[i] || (tangents[i].is_none() && tangents[(i + 1) % n].is_none());
        if straight {
            vertices.push([a.x, a.y, 0.0]);
        } else {
            vertices.extend(biarc(a, ta, b, tb));
        }
    }
    Some(joined(&vertices))
}

/// The vertices in runs of at least [`FEWEST`] with angles below `below`.
fn smooth_vertices(points: &[Vec2], below: f64) -> Vec<bool> {
    let n = points.len();
    let turns_little: Vec<bool> = (0..n)
        .map(|i| {
            let (a, b) = (points[i] - points[(i + n - 1) % n], points[(i + 1) % n] - points[i]);
            cross(a, b).atan2(a.dot(&b)).abs() < below
        })
        .collect();
    let Some(corner) = turns_little.iter().position(|little| !little) else { return turns_little };
    let mut smooth = vec![false; n];
    let mut run = Vec::new();
    for k in 1..=n {
        let i = (corner + k) % n;
        if turns_little[i] {
            run.push(i);
        } else {
            if run.len() >= FEWEST {
                run.iter().for_each(|&i| smooth[i] = true);
            }
            run.clear();
        }
    }
    smooth
}

/// The tangent at `b` of the circle through three points, in the direction from `a` to `c`.
fn circle_tangent(a: Vec2, b: Vec2, c: Vec2) -> Option<Vec2> {
    let (p, q) = (b - a, c - b);
    // The sine of the angle between tangent and chord is chord / (2 R), so that each direction is weighted by the length of the other chord.
    (p.try_normalize(0.0)? * q.norm() + q.try_normalize(0.0)? * p.norm()).try_normalize(0.0)
}

/// The tangent at the other end of the arc that has the tangent `t` at one end of `chord`.
fn mirrored(t: Vec2, chord: Vec2) -> Vec2 {
    let Some(u) = chord.try_normalize(0.0) else { return t };
    u * (2.0 * u.dot(&t)) - t
}

/// The bulge vertices of two arcs from `a` with the tangent `ta` to `b` with the tangent `tb`, unit vectors.
fn biarc(a: Vec2, ta: Vec2, b: Vec2, tb: Vec2) -> [[f64; 3]; 2] {
    let v = b - a;
    let forward = v.dot(&(ta + tb));
    let spread = 2.0 * (1.0 - ta.dot(&tb)).max(0.0);
    // Both arcs have tangents of the same length d up to where they meet the line of the joint.
    let d = v.norm_squared() / (forward + (forward * forward + spread * v.norm_squared()).sqrt());
    let joint = 0.5 * (a + ta * d + b - tb * d);
    [[a.x, a.y, bulge(ta, joint - a)], [joint.x, joint.y, -bulge(-tb, joint - b)]]
}

/// The bulge of the arc with initial tangent `t` and this chord.
fn bulge(t: Vec2, chord: Vec2) -> f64 {
    (0.5 * cross(t, chord).atan2(t.dot(&chord))).tan()
}

/// The ring with neighboring arcs of one circle joined, up to half circles.
fn joined(vertices: &[[f64; 3]]) -> Ring {
    let n = vertices.len();
    let arc = |i: usize| {
        let ([x, y, bulge], [u, v, _]) = (vertices[i], vertices[(i + 1) % n]);
        Arc::of(Vec2::new(x, y), Vec2::new(u, v), bulge)
    };
    // Start where two circles meet, so that no arc is divided by the start of the ring.
    let begin = (0..n).find(|&i| !arc(i).continues(&arc((i + n - 1) % n))).unwrap_or(0);
    let mut found: Vec<[f64; 3]> = Vec::with_capacity(n);
    let mut open: Option<(Arc, f64)> = None;
    for k in 0..n {
        let i = (begin + k) % n;
        let next = arc(i);
        let [x, y, bulge] = vertices[i];
        match &mut open {
            Some((first, angle)) if next.continues(first) && (*angle + next.angle).abs() <= LARGEST_ARC => {
                *angle += next.angle;
                if let Some(last) = found.last_mut() {
                    last[2] = (0.25 * *angle).tan();
                }
            }
            _ => {
                open = Some((next, next.angle));
                found.push([x, y, bulge]);
            }
        }
    }
    Ring { vertices: found }
}

/// The circle of an edge; an infinite radius if it is straight.
#[derive(Debug, Clone, Copy)]
struct Arc {
    center: Vec2,
    radius: f64,
    angle: f64,
}

impl Arc {
    fn of(a: Vec2, b: Vec2, bulge: f64) -> Self {
        let chord = b - a;
        let angle = 4.0 * bulge.atan();
        let radius = chord.norm() / (2.0 * (0.5 * angle).sin());
        let center =
            0.5 * (a + b) + meniscus_core::math::perpendicular(chord) * ((1.0 - bulge * bulge) / (4.0 * bulge));
        Self { center, radius, angle }
    }

    /// Whether this edge lies on the circle of another one; never true for straight edges.
    fn continues(&self, other: &Self) -> bool {
        let limit = SAME_CIRCLE * other.radius.abs();
        limit.is_finite() && (self.radius - other.radius).abs() < limit && (self.center - other.center).norm() < limit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::curve::unit;
    use std::f64::consts::PI;

    const BELOW: f64 = 20.0 * PI / 180.0;

    fn ring(points: &[Vec2]) -> Ring {
        Ring { vertices: points.iter().map(|p| [p.x, p.y, 0.0]).collect() }
    }

    fn arc(center: Vec2, radius: f64, from: f64, to: f64, count: usize) -> impl Iterator<Item = Vec2> {
        (0..=count).map(move |k| center + unit(from + (to - from) * k as f64 / count as f64) * radius)
    }

    #[test]
    fn a_stadium_of_points_becomes_two_half_circles_and_two_straight_walls() {
        let right = arc(Vec2::new(5.0, 0.0), 1.0, -PI / 2.0, PI / 2.0, 24);
        let points: Vec<Vec2> = right.chain(arc(Vec2::zeros(), 1.0, PI / 2.0, 1.5 * PI, 24)).collect();
        let found = smoothed(&ring(&points), BELOW).unwrap();
        assert!((found.area() - (PI + 10.0)).abs() < 1e-9, "{}", found.area());
        assert_eq!(found.vertices.len(), 4, "{found:?}");
    }

    #[test]
    fn a_half_disc_keeps_its_two_corners() {
        let points: Vec<Vec2> = arc(Vec2::new(2.0, 1.0), 3.0, 0.0, PI, 40).collect();
        let found = smoothed(&ring(&points), BELOW).unwrap();
        assert!((found.area() - 4.5 * PI).abs() < 1e-9, "{}", found.area());
        assert!(found.vertices.len() <= 3, "{found:?}");
    }

    #[test]
    fn a_sampled_ellipse_has_its_area_and_its_wall_turns_without_corners() {
        let (a, b) = (3.0, 1.0);
        let points: Vec<Vec2> =
            (0..120).map(|k| unit(2.0 * PI * f64::from(k) / 120.0)).map(|u| Vec2::new(a * u.x, b * u.y)).collect();
        let polygon = ring(&points);
        let found = smoothed(&polygon, BELOW).unwrap();
        let error = |ring: &Ring| (ring.area() / (PI * a * b) - 1.0).abs();
        // Biarcs are of third order where chords are of second.
        assert!(error(&found) < 2e-2 * error(&polygon), "{} of {}", error(&found), error(&polygon));
        let curves: Vec<_> = meniscus_geometry::body::bulged_ring(&found.vertices).collect();
        for (i, curve) in curves.iter().enumerate() {
            let next = &curves[(i + 1) % curves.len()];
            assert!((curve.tangent(1.0) - next.tangent(0.0)).norm() < 1e-6, "corner after piece {i}");
        }
    }

    #[test]
    fn rectangles_octagons_and_blunt_roofs_stay_as_they_are() {
        let octagon: Vec<Vec2> = (0..8).map(|k| unit(PI * f64::from(k) / 4.0)).collect();
        let house = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.2], [0.0, 2.0]].map(Vec2::from);
        assert_eq!(smoothed(&ring(&octagon), BELOW), None);
        assert_eq!(smoothed(&ring(&house), BELOW), None);
    }
}
