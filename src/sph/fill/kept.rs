//! Which of many places are kept: not too near to each other, or the deepest ones.

use crate::math::Vec2;
use crate::sph::cells::Cells;
use crate::sph::domain::Domain;

/// Distance between samples of an offset curve over the distance of particles.
pub(super) const SAMPLING: f64 = 1.0 / 16.0;

/// Distances that differ by less than this share of the spacing are equal, as those of points in mirrored places.
pub(super) const EQUAL: f64 = 1e-6;

/// Particles of layers nearer to one before them than this, in spacings, are left out: where layers of different surfaces meet.
pub(super) const CLOSEST: f64 = 0.5;

/// The indices of the points that are kept, if those nearer than `closest` (m) to a kept one before them are left out.
pub(super) fn apart(points: &[Vec2], domain: &Domain, closest: f64) -> Vec<usize> {
    let cells = Cells::build(points, domain, closest);
    let mut kept = vec![true; points.len()];
    for a in 0..points.len() {
        let mut is_kept = true;
        cells.visit_near(points[a], |b, r| is_kept &= b as usize >= a || !kept[b as usize] || r.norm() >= closest);
        kept[a] = is_kept;
    }
    (0..points.len()).filter(|a| kept[*a]).collect()
}

/// The `count` points with the largest distances, or all. Of those whose distances differ by less than `equal` some can be left out, as in a
/// symmetric pore: then points from all around, so that no side is preferred.
pub(super) fn deepest(mut points: Vec<(f64, Vec2)>, count: usize, equal: f64) -> Vec<Vec2> {
    points.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut taken = Vec::new();
    for group in points.chunk_by(|a, b| a.0 - b.0 < equal) {
        let room = (count - taken.len()).min(group.len());
        // Steps of the golden section visit all of a list, the next one always far from those before.
        let mut order: Vec<usize> = (0..group.len()).collect();
        order.sort_by(|a, b| golden(*a).total_cmp(&golden(*b)));
        taken.extend(order.into_iter().take(room).map(|i| group[i].1));
    }
    taken
}

/// The fractional part of `index` golden sections.
fn golden(index: usize) -> f64 {
    const SECTION: f64 = 0.618_033_988_749_894_9;
    (SECTION * (index as f64 + 0.5)).fract()
}
