//! Coincident ends of lines.

use std::collections::BTreeMap;

use meniscus_core::math::Vec2;

/// Points that coincide within a gap, numbered in order of appearance.
pub(crate) struct Nodes {
    gap: f64,
    pub(crate) points: Vec<Vec2>,
    cells: BTreeMap<[i64; 2], Vec<usize>>,
}

impl Nodes {
    /// An empty set of points.
    pub(crate) fn new(gap: f64) -> Self {
        // Any positive width keeps equal points together if all coincide.
        Self { gap: gap.max(f64::MIN_POSITIVE), points: Vec::new(), cells: BTreeMap::new() }
    }

    /// The number of a point.
    pub(crate) fn number(&mut self, x: Vec2) -> usize {
        // Cells of twice the gap: a coincident point lies in the same cell or in an adjacent one. The cast saturates.
        let cell = |v: f64| (v / (2.0 * self.gap)).floor() as i64;
        let [i, j] = [cell(x.x), cell(x.y)];
        for di in -1..=1 {
            for dj in -1..=1 {
                let near = self.cells.get(&[i.saturating_add(di), j.saturating_add(dj)]);
                let same = near.into_iter().flatten().find(|&&node| (self.points[node] - x).norm() <= self.gap);
                if let Some(&node) = same {
                    return node;
                }
            }
        }
        self.points.push(x);
        self.cells.entry([i, j]).or_default().push(self.points.len() - 1);
        self.points.len() - 1
    }
}
