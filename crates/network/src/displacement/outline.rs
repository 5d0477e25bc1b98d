//! Loops as polygons, for pictures: arcs as chords of a few degrees.
//!
//! The boundary of a region around a periodic domain has two disjoint parts, each a period long. The polygon is cut open between them along
//! the shortest segment from a vertex of one to the other, which meets nothing else. So is that of a region around all grains of a domain whose sides are all open.

use super::loops::Loop;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;

/// Largest angle of a chord in rad.
const LARGEST_ANGLE: f64 = 0.1;

/// The outline of a loop in m; the last point is not repeated.
pub(super) fn outline(part: &Loop) -> Vec<Vec2> {
    if part.has_seam
        && let [one, other] = &chains(part)[..]
        && let Some(polygon) = joined(one, other)
    {
        return polygon;
    }
    let mut points = Vec::new();
    part.curves().iter().for_each(|curve| sample(curve, &mut points));
    if !part.apart.is_empty()
        && let (Some(grains), Some(around)) = around(chains(part))
        && let Some(polygon) = joined(&grains, &around)
    {
        return polygon;
    }
    points
}

/// Among the chains of a boundary, the one around the grains of a domain, and the whole sides that are open, joined to one around the domain; `None` if
/// either does not close.
fn around(chains: Vec<Vec<Vec2>>) -> (Option<Vec<Vec2>>, Option<Vec<Vec2>>) {
    let (mut sides, mut others): (Vec<Vec<Vec2>>, Vec<Vec<Vec2>>) =
        chains.into_iter().partition(|chain| chain.len() == 2);
    let size = sides.iter().map(|side| (side[1] - side[0]).norm()).fold(0.0, f64::max);
    let meet = |a: Vec2, b: Vec2| (a - b).norm() <= 1e-9 * size;
    let mut ring = sides.pop().unwrap_or_default();
    while let Some(&end) = ring.last()
        && let Some(next) = sides.iter().position(|side| meet(side[0], end))
    {
        ring.push(sides.swap_remove(next)[1]);
    }
    let closed = |mut chain: Vec<Vec2>| {
        let last = chain.pop()?;
        chain.push(*chain.first().filter(|first| chain.len() > 1 && meet(**first, last))?);
        Some(chain)
    };
    (others.pop().filter(|_| others.is_empty()).and_then(closed), closed(ring))
}

/// The centroid of a polygon.
pub(crate) fn centroid(outline: &[Vec2]) -> Vec2 {
    let Some(&origin) = outline.first() else { return Vec2::zeros() };
    let (mut sum, mut area) = (Vec2::zeros(), 0.0);
    for k in 0..outline.len() {
        let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
        let (a, b) = (a - origin, b - origin);
        let part = a.x * b.y - a.y * b.x;
        sum += (a + b) * part;
        area += part;
    }
    if area == 0.0 { origin } else { origin + sum / (3.0 * area) }
}

/// Adds the start of a curve and the points along it, without its end.
fn sample(curve: &Curve, points: &mut Vec<Vec2>) {
    let count = match curve {
        Curve::Segment { .. } => 1,
        Curve::Arc { sweep, .. } => (sweep.abs() / LARGEST_ANGLE).ceil().max(1.0) as usize,
    };
    points.extend((0..count).map(|k| curve.point(k as f64 / count as f64)));
}

/// The parts of the boundary between its gaps, with their ends.
fn chains(part: &Loop) -> Vec<Vec<Vec2>> {
    let mut curves: Vec<Curve> = Vec::new();
    for (k, wall) in part.walls.iter().enumerate() {
        curves.extend(wall.iter().map(|piece| piece.curve));
        curves.extend(part.crossings.get(k).map(|c| Curve::Segment { a: c.from, b: c.to }));
    }
    curves.retain(|curve| curve.length() > 0.0);
    let length: f64 = curves.iter().map(Curve::length).sum();
    let follows = |one: &Curve, next: &Curve| (next.point(0.0) - one.point(1.0)).norm() <= 1e-9 * length;
    let count = curves.len();
    // Start after a gap, so that no chain is split at the start of the list.
    let first = (0..count).find(|&k| !follows(&curves[(k + count - 1) % count], &curves[k])).unwrap_or(0);
    curves.rotate_left(first);
    let mut found: Vec<Vec<Vec2>> = Vec::new();
    for run in curves.chunk_by(follows) {
        let mut points = Vec::new();
        run.iter().for_each(|curve| sample(curve, &mut points));
        points.extend(run.last().map(|curve| curve.point(1.0)));
        found.push(points);
    }
    found.extend(part.apart.iter().map(|crossing| vec![crossing.from, crossing.to]));
    found
}

/// The polygon between two chains that go around the domain, or around its grains, in opposite directions.
fn joined(one: &[Vec2], other: &[Vec2]) -> Option<Vec<Vec2>> {
    // Maximum number of pairs of vertices and edges tried.
    const MOST_PAIRS: usize = 1 << 22;
    let period = one.last()? - one.first()?;
    let back = other.last()? - other.first()?;
    if (period + back).norm() > 1e-6 * period.norm() || one.len() < 2 {
        return None;
    }
    let stride = (one.len() * other.len()).div_ceil(MOST_PAIRS);
    let mut best: Option<(f64, usize, usize, Vec2, Vec2)> = None;
    for i in (0..one.len() - 1).step_by(stride) {
        for (j, edge) in other.windows(2).enumerate() {
            for shift in [-1.0, 0.0, 1.0] {
                let by = period * shift;
                let closest = Curve::Segment { a: edge[0], b: edge[1] }.project(one[i] - by).point + by;
                let distance = (closest - one[i]).norm();
                if best.is_none_or(|(least, ..)| distance < least) {
                    best = Some((distance, i, j, closest, by));
                }
            }
        }
    }
    let (_, i, j, closest, by) = best?;
    let mut polygon: Vec<Vec2> = one[i..one.len() - 1].to_vec();
    polygon.extend(one[..=i].iter().map(|point| point + period));
    // The other chain runs back by a period, from beside the last vertex to beside the first.
    polygon.push(closest + period);
    polygon.extend(other[j + 1..].iter().map(|point| point + by + period));
    polygon.extend(other[1..=j].iter().map(|point| point + by));
    polygon.push(closest);
    // Shift back to the position of the other chain: an open side lies in the domain.
    polygon.iter_mut().for_each(|point| *point -= by);
    Some(polygon)
}

/// The edges of an outline.
pub(crate) fn edges(outline: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    (0..outline.len()).map(|k| (outline[k], outline[(k + 1) % outline.len()]))
}

/// Whether a point lies within an outline, by the number of edges to its right.
pub(crate) fn contains(outline: &[Vec2], x: Vec2) -> bool {
    let to_the_right =
        |(a, b): &(Vec2, Vec2)| (a.y > x.y) != (b.y > x.y) && x.x < a.x + (b.x - a.x) * (x.y - a.y) / (b.y - a.y);
    edges(outline).filter(to_the_right).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::displacement::loops::{Crossing, GateId};
    use crate::graph::WallPiece;

    fn area(polygon: &[Vec2]) -> f64 {
        let edges = polygon.iter().zip(polygon.iter().cycle().skip(1));
        0.5 * edges.map(|(a, b)| a.x * b.y - a.y * b.x).sum::<f64>()
    }

    /// A rough wall at x = 2 of period 1 along y, run through downwards from y = 0.7, and an open side at x = 0 beside it.
    fn manifold() -> Loop {
        let v = Vec2::new;
        let piece = |a, b| {
            let curve = Curve::Segment { a, b };
            WallPiece::part_of(&curve, curve, 0)
        };
        let wall = [piece(v(2.0, 0.7), v(1.5, 0.5)), piece(v(1.5, 0.5), v(2.5, 0.2)), piece(v(2.5, 0.2), v(2.0, -0.3))];
        let side = Crossing { gate: GateId::Opening(0), from: v(0.0, 0.0), to: v(0.0, 1.0) };
        Loop { walls: vec![wall.into()], crossings: Vec::new(), apart: vec![side], has_seam: true }
    }

    #[test]
    fn a_region_around_the_domain_is_a_polygon_of_its_area_within_its_walls() {
        let polygon = outline(&manifold());
        // The pore lies on the right of its boundary. The mean of x along the wall: trapezoids of the three pieces.
        let exact = 0.2 * 1.75 + 0.3 * 2.0 + 0.5 * 2.25;
        assert!((area(&polygon) + exact).abs() < 1e-12, "{polygon:?}");
        // Cut open at the point of the wall next to the side.
        assert!(polygon.iter().filter(|point| (point.x - 1.5).abs() < 1e-12).count() == 2, "{polygon:?}");
    }
}
