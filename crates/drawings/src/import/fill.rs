//! The area filled by crossing rings: their union by the fill rule, for straight edges by the boolean operations of crate `geo`.
//!
//! These use integers internally, so that rings that do not cross bypass them and stay exact.

use geo::algorithm::bool_ops::{self, BooleanOps, OpType};
use geo::{Area, LineString, MultiPolygon, Polygon};

use crate::import::combine;
use crate::import::drawing::{FillRule, Ring};
use crate::import::nest::{Region, regions};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::body::bulged_ring;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::intersect::intersections;
use meniscus_geometry::rings::faults;

/// Relative tolerance of areas after boolean operations, over the area of the box.
const SAME_AREA: f64 = 1e-7;

/// The regions filled by rings that may cross each other and themselves.
///
/// # Errors
/// A message if arcs cross, for which there is no union.
pub(crate) fn filled(rings: &[Ring], rule: FillRule, tolerance: f64) -> Result<Vec<Region>, String> {
    let Some((ring, at)) = crossing(rings, tolerance) else { return Ok(regions(rings, rule)) };
    if rings.iter().all(Ring::is_straight) {
        return united(rings, rule);
    }
    let turns_alike = rings.iter().all(|r| (r.area() > 0.0) == (rings[0].area() > 0.0));
    let each_is_simple = rings.iter().all(|r| crossing(std::slice::from_ref(r), tolerance).is_none());
    if rule == FillRule::NonZero && turns_alike && each_is_simple {
        // Shapes of a file are united later, including arcs.
        return Ok(rings.iter().map(|ring| (ring.clone(), Vec::new())).collect());
    }
    Err(format!("curved outlines that cross: ring {ring} at ({:e}, {:e})", at.x, at.y))
}

/// The first edge, by ring, that intersects another one away from a shared vertex.
fn crossing(rings: &[Ring], tolerance: f64) -> Option<(usize, Vec2)> {
    struct Edge {
        ring: usize,
        number: usize,
        curve: Curve,
        bounds: Bounds,
    }
    let mut edges: Vec<Edge> = Vec::new();
    for (ring, one) in rings.iter().enumerate() {
        edges.extend(bulged_ring(&one.vertices).enumerate().map(|(number, curve)| Edge {
            ring,
            number,
            curve,
            bounds: curve.bounds().grown(tolerance),
        }));
    }
    edges.sort_by(|a, b| a.bounds.min.x.total_cmp(&b.bounds.min.x).then((a.ring, a.number).cmp(&(b.ring, b.number))));
    let mut found: Option<(usize, usize, Vec2)> = None;
    for (i, a) in edges.iter().enumerate() {
        let near = edges[i + 1..].iter().take_while(|b| b.bounds.min.x <= a.bounds.max.x);
        for b in near.filter(|b| a.bounds.min.y <= b.bounds.max.y && b.bounds.min.y <= a.bounds.max.y) {
            let count = rings[a.ring].vertices.len();
            let are_neighbors = a.ring == b.ring && [1, count - 1].contains(&a.number.abs_diff(b.number));
            if are_neighbors {
                continue;
            }
            for (one, other) in [(a, b), (b, a)] {
                let mut parameters = Vec::new();
                intersections(&one.curve, &other.curve, tolerance, &mut parameters);
                let end = tolerance / one.curve.length();
                if let Some(&u) = parameters.iter().find(|u| end < **u && **u < 1.0 - end) {
                    let here = (one.ring, one.number, one.curve.point(u));
                    if found.is_none_or(|known| (here.0, here.1) < (known.0, known.1)) {
                        found = Some(here);
                    }
                }
            }
        }
    }
    found.map(|(ring, _, at)| (ring, at))
}

/// A region whose rings touch or coincide along lines, as at a slit of zero width, as regions that do not; unchanged if it is valid, curved, or has other
/// faults: its area is preserved.
pub(crate) fn without_slits((outer, holes): Region) -> Vec<Region> {
    let turned = |ring: &Ring, ccw: bool| if (ring.area() > 0.0) == ccw { ring.clone() } else { ring.reversed() };
    let rings: Vec<Ring> =
        std::iter::once(turned(&outer, true)).chain(holes.iter().map(|hole| turned(hole, false))).collect();
    let curves: Vec<Vec<Curve>> = rings.iter().map(|ring| bulged_ring(&ring.vertices).collect()).collect();
    let whole = vec![(outer, holes)];
    if !rings.iter().all(Ring::is_straight) || faults(&curves).is_empty() {
        return whole;
    }
    let Ok(found) = united(&rings, FillRule::EvenOdd) else { return whole };
    let area: f64 = rings.iter().map(Ring::area).sum();
    let is_same = (combine::area(&found) - area).abs() <= SAME_AREA * rings.iter().map(bounding_area).sum::<f64>();
    if is_same { found } else { whole }
}

/// The union of straight rings.
fn united(rings: &[Ring], rule: FillRule) -> Result<Vec<Region>, String> {
    let line = |ring: &Ring| LineString::from(ring.vertices.iter().map(|v| (v[0], v[1])).collect::<Vec<_>>());
    let all = MultiPolygon::new(rings.iter().map(|ring| Polygon::new(line(ring), Vec::new())).collect());
    let rule = match rule {
        FillRule::EvenOdd => bool_ops::FillRule::EvenOdd,
        FillRule::NonZero => bool_ops::FillRule::NonZero,
    };
    let union = all.boolean_op_with_fill_rule(&MultiPolygon::<f64>::new(Vec::new()), OpType::Union, rule);
    let (area, most) = (union.unsigned_area(), rings.iter().map(bounding_area).sum::<f64>());
    // Conversion to integers and back must not increase the area.
    if !(area.is_finite() && area <= most * (1.0 + 1e-9)) {
        return Err(format!("outlines that cross, whose union comes out with the area {area:e}"));
    }
    let ring = |line: &LineString<f64>| {
        let closed: Vec<_> = line.coords().collect();
        Ring { vertices: closed.iter().take(closed.len().saturating_sub(1)).map(|c| [c.x, c.y, 0.0]).collect() }
    };
    Ok(union.iter().map(|p| (ring(p.exterior()), p.interiors().iter().map(ring).collect())).collect())
}

fn bounding_area(ring: &Ring) -> f64 {
    ring.bounds().area()
}

#[cfg(test)]
mod tests {
    use super::combine::area;
    use super::*;
    use crate::import::drawing::seen::bar;
    use crate::import::nest::circle;

    #[test]
    fn crossing_squares_fill_their_union_or_leave_out_what_both_cover() {
        let rings = [bar(0.0, 0.0, 2.0, 2.0), bar(1.0, 1.0, 2.0, 2.0)];
        let of = |rule| area(&filled(&rings, rule, 1e-9).unwrap());
        assert!((of(FillRule::NonZero) - 7.0).abs() < 1e-7);
        assert!((of(FillRule::EvenOdd) - 6.0).abs() < 1e-7);
    }

    #[test]
    fn a_pentagram_has_a_hole_by_one_rule_only() {
        let point = |k: i32| meniscus_geometry::curve::unit(std::f64::consts::TAU * 0.4 * f64::from(k));
        let star = Ring { vertices: (0..5).map(|k| [point(k).x, point(k).y, 0.0]).collect() };
        let of = |rule| area(&filled(std::slice::from_ref(&star), rule, 1e-9).unwrap());
        // The inner pentagon of the star of circumradius 1 has the circumradius cos 72°/cos 36°.
        let inner = (72_f64.to_radians().cos() / 36_f64.to_radians().cos()).powi(2) * 2.5 * 72_f64.to_radians().sin();
        assert!((of(FillRule::NonZero) - of(FillRule::EvenOdd) - inner).abs() < 1e-7);
    }

    #[test]
    fn rings_that_do_not_cross_keep_every_bit() {
        let rings = [bar(0.1, 0.3, 2.0, 2.0), bar(3.7, 0.0, 2.0, 2.0)];
        assert_eq!(filled(&rings, FillRule::EvenOdd, 1e-9).unwrap()[1].0, rings[1]);
    }

    #[test]
    fn crossing_circles_are_united_and_not_taken_apart() {
        let rings = [1.0, 2.0].map(|x| circle(Vec2::new(x, 0.0), 1.0));
        assert_eq!(filled(&rings, FillRule::NonZero, 1e-9).unwrap().len(), 2);
        assert!(filled(&rings, FillRule::EvenOdd, 1e-9).unwrap_err().contains("cross"));
    }
}
