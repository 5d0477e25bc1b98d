//! Recognition of circles: a polygon that an exporter made of a circle, or a ring of arcs of one circle, becomes a disc again.
//!
//! The vertices of such polygons lie on the circle, so that the disc has their radius and a larger area than the polygon (.16 % for 64 vertices). Otherwise
//! every vertex would pin a meniscus, and entry pressures would be 1 to 6 % too high.

use crate::import::drawing::Ring;
use meniscus_core::math::{Mat2, Vec2};
use meniscus_geometry::body::bulged_ring;
use meniscus_geometry::curve::{Curve, cross};

/// Maximum distance of the vertices from the circle over its radius.
const ON_CIRCLE: f64 = 1e-3;

/// Minimum number of vertices of a polygonized circle; an octagon is taken literally.
const FEWEST: usize = 12;

/// Longest edge over the mean one, by the angles subtended at the center: beyond, it is a flat side of a disc.
const EVEN: f64 = 1.5;

/// The circle represented by a ring: center and radius.
pub(crate) fn circle(ring: &Ring) -> Option<(Vec2, f64)> {
    let vertices = &ring.vertices;
    let has_arcs = !ring.is_straight();
    if vertices.len() < 2 || (!has_arcs && vertices.len() < FEWEST) {
        return None;
    }
    let mut points: Vec<Vec2> = vertices.iter().map(|v| Vec2::new(v[0], v[1])).collect();
    if has_arcs {
        points.extend(bulged_ring(vertices).filter(|c| matches!(c, Curve::Arc { .. })).map(|arc| arc.point(0.5)));
    }
    let (center, radius) = fitted(&points)?;
    if points.iter().any(|p| !(((p - center).norm() - radius).abs() <= ON_CIRCLE * radius)) {
        return None;
    }
    turns_evenly(ring, center).then_some((center, radius))
}

/// Whether the ring runs once around `center`, in one direction and without a straight edge much longer than the others.
fn turns_evenly(ring: &Ring, center: Vec2) -> bool {
    let vertices = &ring.vertices;
    let n = vertices.len();
    let mut total = 0.0;
    let mut longest: f64 = 0.0;
    let direction = ring.area().signum();
    for i in 0..n {
        let ([x, y, bulge], [u, v, _]) = (vertices[i], vertices[(i + 1) % n]);
        let (a, b) = (Vec2::new(x, y) - center, Vec2::new(u, v) - center);
        let angle = if bulge == 0.0 { cross(a, b).atan2(a.dot(&b)) } else { 4.0 * bulge.atan() } * direction;
        if !(angle > 0.0) {
            return false;
        }
        if bulge == 0.0 {
            longest = longest.max(angle);
        }
        total += angle;
    }
    let once = (total - std::f64::consts::TAU).abs() < 0.1;
    once && longest <= EVEN * std::f64::consts::TAU / n.max(FEWEST) as f64
}

/// The least-squares circle x² + y² = 2 a x + 2 b y + c (Kåsa), about the mean of the points: unbiased for points all around it.
fn fitted(points: &[Vec2]) -> Option<(Vec2, f64)> {
    let count = points.len() as f64;
    let mean = points.iter().sum::<Vec2>() / count;
    let (mut moments, mut right, mut square) = (Mat2::zeros(), Vec2::zeros(), 0.0);
    for point in points {
        let d = point - mean;
        moments += d * d.transpose();
        right += d * (0.5 * d.norm_squared());
        square += d.norm_squared();
    }
    let offset = moments.try_inverse()? * right;
    let radius = (square / count + offset.norm_squared()).sqrt();
    (radius.is_finite() && radius > 0.0).then_some((mean + offset, radius))
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::curve::unit;
    use std::f64::consts::TAU;

    fn polygon(count: usize, radius: impl Fn(usize) -> f64) -> Ring {
        let vertex = |k: usize| {
            let p = Vec2::new(3.0, -2.0) + unit(0.3 + TAU * k as f64 / count as f64) * radius(k);
            [p.x, p.y, 0.0]
        };
        Ring { vertices: (0..count).map(vertex).collect() }
    }

    #[test]
    fn a_polygon_on_a_circle_is_that_circle_in_either_direction() {
        for ring in [polygon(64, |_| 0.5), polygon(64, |_| 0.5).reversed(), polygon(12, |_| 0.5)] {
            let (center, radius) = circle(&ring).unwrap();
            assert!((center - Vec2::new(3.0, -2.0)).norm() < 1e-14 && (radius - 0.5).abs() < 1e-14);
        }
    }

    #[test]
    fn octagons_rough_rings_and_discs_with_a_flat_side_stay_polygons() {
        assert_eq!(circle(&polygon(8, |_| 0.5)), None);
        assert_eq!(circle(&polygon(64, |k| if k % 2 == 0 { 0.5 } else { 0.503 })), None);
        let mut flat = polygon(64, |_| 0.5);
        flat.vertices.remove(10);
        assert_eq!(circle(&flat), None);
    }

    #[test]
    fn half_circles_make_a_disc_and_a_stadium_does_not() {
        let two = Ring { vertices: vec![[0.0, 0.0, 1.0], [2.0, 0.0, 1.0]] };
        assert_eq!(circle(&two), Some((Vec2::new(1.0, 0.0), 1.0)));
        let stadium = Ring { vertices: vec![[0.0, 0.0, 0.0], [2.0, 0.0, 1.0], [2.0, 1.0, 0.0], [0.0, 1.0, 1.0]] };
        assert_eq!(circle(&stadium), None);
    }
}
