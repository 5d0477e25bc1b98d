//! A smooth curve as few arcs: pairs of arcs with a common tangent (biarcs) through selected points.

use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::curve::{Curve, cross};

/// Distance of arcs from the smooth curve over the root mean square of the noise: small enough to be invisible.
const TOLERANCE: f64 = 0.5;

/// A vertex of a chain of arcs: position, bulge of the arc that starts there, and the tangent there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex {
    pub(crate) point: Vec2,
    pub(crate) bulge: f64,
    pub(crate) tangent: Vec2,
}

/// The two arcs between two points with given tangents, as the joint and both bulges; `None` if they turn by more than a half turn.
fn biarc((p, t): (Vec2, Vec2), (q, s): (Vec2, Vec2)) -> Option<(Vec2, f64, f64)> {
    let (v, sum, bend) = (q - p, t + s, 2.0 * (1.0 - t.dot(&s)));
    let along = v.dot(&sum);
    // The positive root of bend d² + 2 along d = v², in a form valid for parallel tangents.
    let reach = v.norm_squared() / (along + (along * along + bend * v.norm_squared()).sqrt());
    if !(reach > 0.0 && reach.is_finite()) {
        return None;
    }
    let joint = 0.5 * (p + t * reach + q - s * reach);
    let (first, last) = (joint - p, q - joint);
    // The angle between a tangent and the chord is half of the angle of the arc.
    let from = cross(t, first).atan2(t.dot(&first));
    let to = cross(last, s).atan2(last.dot(&s));
    let is_small = from.abs().max(to.abs()) < std::f64::consts::FRAC_PI_4;
    is_small.then(|| (joint, (0.5 * from).tan(), (0.5 * to).tan()))
}

/// The largest number of intervals below `end` that fit, at least one: doubled while they fit, then by bisection.
fn longest(end: usize, fits: impl Fn(usize) -> bool) -> usize {
    let (mut good, mut bad) = (1, 2);
    while bad < end && fits(bad) {
        (good, bad) = (bad, 2 * bad);
    }
    bad = bad.min(end);
    while bad - good > 1 {
        let middle = good + (bad - good) / 2;
        if fits(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}

/// Few arcs through the points, as near to all of them as the `noise` (rms, in pixels) requires; each of the `parts` between the given indices is
/// divided from both of its ends, so that the arcs do not depend on the sense. Closed: the last arc ends at the first vertex. Open: the last vertex ends the line and has no arc.
pub(super) fn arcs(points: &[Vec2], tangents: &[Vec2], parts: &[usize], is_closed: bool, noise: f64) -> Vec<Vertex> {
    let n = points.len();
    let at = |k: usize| (points[k % n], tangents[k % n]);
    let fits = |i: usize, j: usize| {
        if j == i + 1 {
            return true;
        }
        let Some((joint, a, b)) = biarc(at(i), at(j)) else { return false };
        let (first, second) = (Curve::from_bulge(at(i).0, joint, a), Curve::from_bulge(joint, at(j).0, b));
        let across = second.tangent(0.0);
        (i + 1..j).all(|k| {
            let x = at(k).0;
            let curve = if (x - joint).dot(&across) < 0.0 { &first } else { &second };
            (curve.project(x).point - x).norm() <= TOLERANCE * noise
        })
    };
    let mut vertices = Vec::new();
    // Spans still to be converted, the next one last.
    let whole = parts.windows(2).rev().map(|part| (part[0], part[1]));
    let mut spans: Vec<(usize, usize)> = whole.filter(|(i, j)| i < j).collect();
    while let Some((i, j)) = spans.pop() {
        if !fits(i, j) {
            let (ahead, behind) = (longest(j - i, |n| fits(i, i + n)), longest(j - i, |n| fits(j - n, j)));
            let [mut low, mut high] = [i + ahead, j - behind];
            if high < low {
                // One span each from both ends reaches the middle of where they overlap.
                [low, high] = [(low + high) / 2, (low + high).div_ceil(2)];
            }
            spans.extend([(high, j), (low, high), (i, low)].into_iter().filter(|(from, to)| from < to));
            continue;
        }
        match biarc(at(i), at(j)) {
            Some((joint, a, b)) => {
                let tangent = Curve::from_bulge(joint, at(j).0, b).tangent(0.0);
                vertices.push(Vertex { point: at(i).0, bulge: a, tangent: at(i).1 });
                vertices.push(Vertex { point: joint, bulge: b, tangent });
            }
            None => vertices.push(Vertex { point: at(i).0, bulge: 0.0, tangent: at(i).1 }),
        }
    }
    if !is_closed {
        let (point, tangent) = at(n - 1);
        vertices.push(Vertex { point, bulge: 0.0, tangent });
    }
    vertices
}

/// The curves of a chain of vertices.
fn curves(vertices: &[Vertex], is_closed: bool) -> impl Iterator<Item = Curve> {
    let n = vertices.len();
    (0..if is_closed { n } else { n.saturating_sub(1) })
        .filter(move |&i| vertices[i].point != vertices[(i + 1) % n].point)
        .map(move |i| Curve::from_bulge(vertices[i].point, vertices[(i + 1) % n].point, vertices[i].bulge))
}

/// ½ ∫ (x dy − y dx) about the origin: for a closed chain its area.
pub(super) fn area(vertices: &[Vertex], is_closed: bool) -> f64 {
    curves(vertices, is_closed).map(|curve| curve.area_about(Vec2::zeros())).sum()
}

/// The length of the edges of a closed chain that start at a vertex with a tangent.
pub(super) fn movable_length(vertices: &[Vertex]) -> f64 {
    let n = vertices.len();
    let edges = (0..n).map(|i| (&vertices[i], &vertices[(i + 1) % n]));
    let movable = edges.filter(|(a, b)| a.tangent != Vec2::zeros() && a.point != b.point);
    movable.map(|(a, b)| Curve::from_bulge(a.point, b.point, a.bulge).length()).sum()
}

/// Displaces a chain of arcs out of the solid: arcs keep their centers. Vertices without a tangent stay.
pub(super) fn move_out(vertices: &mut [Vertex], by: f64) {
    for vertex in vertices {
        vertex.point -= perpendicular(vertex.tangent) * by;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::curve::unit;
    use std::f64::consts::TAU;

    #[test]
    fn points_of_an_ellipse_become_few_arcs_that_keep_near_and_keep_the_area() {
        let (a, b, count, noise) = (40.0, 25.0, 300, 0.1);
        let at = |k: usize| TAU * k as f64 / count as f64;
        let points: Vec<Vec2> = (0..count).map(|k| unit(at(k)).component_mul(&Vec2::new(a, b))).collect();
        let tangents: Vec<Vec2> =
            (0..count).map(|k| perpendicular(unit(at(k))).component_mul(&Vec2::new(a, b)).normalize()).collect();
        let vertices = arcs(&points, &tangents, &[0, count], true, noise);
        assert!(vertices.len() < 40, "{} arcs", vertices.len());
        // The arcs may lie anywhere within the tolerance along the whole ellipse; in practice they alternate about it.
        assert!((area(&vertices, true) - 0.5 * TAU * a * b).abs() < TOLERANCE * noise * movable_length(&vertices));
        let mut out = vertices.clone();
        move_out(&mut out, 1.0);
        let grown = area(&vertices, true) + movable_length(&vertices) + 0.5 * TAU;
        assert!((area(&out, true) - grown).abs() < 1e-9, "Steiner: a convex area grows by perimeter and a circle");
    }
}
