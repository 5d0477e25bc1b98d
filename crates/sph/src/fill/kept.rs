//! Selection of points: those not too close to each other, or the deepest ones.

use crate::cells::Cells;
use crate::domain::Domain;
use meniscus_core::math::Vec2;

/// Distance between samples of an offset curve over the particle spacing.
pub(super) const SAMPLING: f64 = 1.0 / 16.0;

/// Distances that differ by less than this fraction of the spacing count as equal, as at mirrored points.
pub(super) const EQUAL: f64 = 1e-6;

/// Particles of layers closer than this, in spacings, to an earlier one are left out: where layers of different surfaces meet.
pub(super) const CLOSEST: f64 = 0.5;

/// Indices of the points that remain when those closer than `closest` (m) to an earlier one that is kept are left out.
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

/// The `count` points with the largest distances, or all. Where only some of a group with distances equal within `equal` are taken, as in a
/// symmetric pore, they are spread over the whole group, so that no side is preferred.
pub(super) fn deepest(mut points: Vec<(f64, Vec2)>, count: usize, equal: f64) -> Vec<Vec2> {
    points.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut taken = Vec::new();
    for group in points.chunk_by(|a, b| a.0 - b.0 < equal) {
        let room = (count - taken.len()).min(group.len());
        // Golden-section steps visit a whole list, each far from the earlier ones.
        let mut order: Vec<usize> = (0..group.len()).collect();
        order.sort_by(|a, b| golden(*a).total_cmp(&golden(*b)));
        taken.extend(order.into_iter().take(room).map(|i| group[i].1));
    }
    taken
}

/// Fractional part of (`index` + ½) golden sections.
fn golden(index: usize) -> f64 {
    const SECTION: f64 = 0.618_033_988_749_894_9;
    (SECTION * (index as f64 + 0.5)).fract()
}
