//! Aggregates for the multigrid: particles of the same kind in a square cell.

use rayon::prelude::*;

use meniscus_core::math::Vec2;

/// Width of an aggregate over the spacing of its points.
pub(crate) const COARSENING: f64 = 3.0;

/// Assignment of points to aggregates.
#[derive(Debug, Clone)]
pub(crate) struct Aggregates {
    /// Aggregate of each point.
    pub(crate) of: Vec<u32>,
    /// Mean position of each aggregate in m.
    pub(crate) position: Vec<Vec2>,
    /// Kind of each aggregate.
    pub(crate) kind: Vec<u8>,
}

impl Aggregates {
    /// Groups `points` of the same `kind` that lie in the same square of side `width` (m).
    ///
    /// Points of different kind (light and heavy fluid) are kept apart, since a jump of the coefficient within an
    /// aggregate would slow the convergence of the cycle.
    pub(crate) fn by_cell(points: &[Vec2], kind: &[u8], width: f64) -> Self {
        let mut low = Vec2::repeat(f64::INFINITY);
        let mut high = Vec2::repeat(f64::NEG_INFINITY);
        for x in points.iter().filter(|x| x.iter().all(|v| v.is_finite())) {
            low = low.inf(x);
            high = high.sup(x);
        }
        let columns = ((high.x - low.x) / width).floor().max(0.0) as u64 + 1;
        let key = |i: usize| {
            let cell = (points[i] - low) / width;
            let index = cell.y.floor().max(0.0) as u64 * columns + cell.x.floor().max(0.0) as u64;
            index << 3 | u64::from(kind[i] & 7)
        };
        let mut order: Vec<(u64, u32)> = (0..points.len()).map(|i| (key(i), i as u32)).collect();
        order.par_sort_unstable();
        let mut aggregates = Self { of: vec![0; points.len()], position: vec![], kind: vec![] };
        for group in order.chunk_by(|a, b| a.0 == b.0) {
            let number = aggregates.position.len() as u32;
            let mut sum = Vec2::zeros();
            for &(_, i) in group {
                aggregates.of[i as usize] = number;
                sum += points[i as usize];
            }
            aggregates.position.push(sum / group.len() as f64);
            aggregates.kind.push(kind[group[0].1 as usize]);
        }
        aggregates
    }
}
