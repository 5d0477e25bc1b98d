//! A surface given by pieces: its images in a periodic domain, and its continuation beyond the sides.

use crate::boundary::{Piece, followers};
use crate::curve::Curve;
use meniscus_core::math::{Bounds, Vec2};

/// The pieces with all images that can be nearest to a point of the domain, and straight continuations outwards from ends at a side. Ends closer than
/// `tolerance` (m) are joined.
pub(super) fn whole(domain: Bounds, periodic: [bool; 2], pieces: &[Curve], tolerance: f64) -> Vec<Piece> {
    let image = |piece: &Curve, by: Vec2| Piece { curve: piece.shifted(by), shape: 0 };
    let mut all = Vec::new();
    for piece in pieces {
        // The nearest point of a periodic surface is never farther than half a period.
        all.extend(shifts(domain, periodic, piece.bounds(), 0.5).into_iter().map(|by| image(piece, by)));
    }
    let next = followers(&all, tolerance);
    let mut has_before = vec![false; all.len()];
    next.iter().flatten().for_each(|&j| has_before[j] = true);
    let is_open = |i: &usize| !all[*i].curve.is_closed();
    let starts = (0..all.len()).filter(is_open).filter(|&i| !has_before[i]).map(|i| (all[i].curve.point(0.0), true));
    let ends = (0..all.len()).filter(is_open).filter(|&i| next[i].is_none()).map(|i| (all[i].curve.point(1.0), false));
    let beyond: Vec<Piece> = starts
        .chain(ends)
        .filter_map(|(point, is_start)| {
            let out = outwards(domain, periodic, point, tolerance)?;
            let far = point + out * domain.size().max();
            let curve =
                if is_start { Curve::Segment { a: far, b: point } } else { Curve::Segment { a: point, b: far } };
            Some(Piece { curve, shape: 0 })
        })
        .collect();
    all.extend(beyond);
    all
}

/// The shifts by whole periods after which a box reaches into the domain grown by `reach` times its size.
pub(super) fn shifts(domain: Bounds, periodic: [bool; 2], bounds: Bounds, reach: f64) -> Vec<Vec2> {
    let size = domain.size();
    let along = |axis: usize| -> Vec<f64> {
        if !periodic[axis] {
            return vec![0.0];
        }
        let first = ((domain.min[axis] - reach * size[axis] - bounds.max[axis]) / size[axis]).ceil() as i64;
        let last = ((domain.max[axis] + reach * size[axis] - bounds.min[axis]) / size[axis]).floor() as i64;
        (first..=last).map(|k| k as f64 * size[axis]).collect()
    };
    let rows = along(1);
    along(0).into_iter().flat_map(|dx| rows.iter().map(move |&dy| Vec2::new(dx, dy))).collect()
}

/// The outward normal of the side that contains a point; `None` within the domain and at periodic sides.
fn outwards(domain: Bounds, periodic: [bool; 2], x: Vec2, tolerance: f64) -> Option<Vec2> {
    let sides = [
        (0, domain.min.x, -Vec2::x()),
        (0, domain.max.x, Vec2::x()),
        (1, domain.min.y, -Vec2::y()),
        (1, domain.max.y, Vec2::y()),
    ];
    let found = sides.into_iter().find(|&(axis, at, _)| !periodic[axis] && (x[axis] - at).abs() <= tolerance);
    found.map(|(_, _, out)| out)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Geometry;

    fn domain() -> Bounds {
        Bounds { min: Vec2::zeros(), max: Vec2::new(2.0, 1.0) }
    }

    #[test]
    fn a_surface_that_ends_at_an_open_side_goes_on_straight_beyond_it() {
        // Solid above a line that crosses both sides.
        let line = Curve::Segment { a: Vec2::new(0.0, 0.5), b: Vec2::new(2.0, 0.5) };
        let geometry = Geometry::of_surface(domain(), [false; 2], &[line]);
        for x in [-0.3, 0.4, 2.2] {
            assert!(geometry.signed_distance(Vec2::new(x, 0.7)) < 0.0);
            assert!((geometry.signed_distance(Vec2::new(x, 0.2)) - 0.3).abs() < 1e-15);
        }
    }

    #[test]
    fn a_surface_around_a_periodic_domain_is_seen_from_everywhere() {
        let line = Curve::Segment { a: Vec2::new(1.5, 0.0), b: Vec2::new(1.5, 1.0) };
        let geometry = Geometry::of_surface(domain(), [false, true], &[line]);
        for y in [0.0, 0.3, 0.999] {
            assert!((geometry.signed_distance(Vec2::new(1.2, y)) + 0.3).abs() < 1e-15);
            assert!((geometry.signed_distance(Vec2::new(1.7, y)) - 0.2).abs() < 1e-15);
        }
    }
}
