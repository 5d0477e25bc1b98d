//! The nodes of a regular grid, open or periodic along each axis.

use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{Field, Grid};

/// Positions of the nodes of a regular grid; x runs fastest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Position of the first node in m.
    pub origin: Vec2,
    /// Spacing of the nodes in m.
    pub spacing: Vec2,
    /// Number of nodes along x and y.
    pub counts: [usize; 2],
    /// Whether the grid wraps around: the node after the last one along an axis is the first one.
    pub periodic: [bool; 2],
}

impl Lattice {
    /// An open lattice.
    pub fn open(origin: Vec2, spacing: Vec2, counts: [usize; 2]) -> Self {
        Self { origin, spacing, counts, periodic: [false; 2] }
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.counts[0] * self.counts[1]
    }

    /// Position in m of the node with the indices `i` along x and `j` along y, which may lie outside the grid.
    pub fn position(&self, i: usize, j: usize) -> Vec2 {
        self.origin + Vec2::new(i as f64 * self.spacing.x, j as f64 * self.spacing.y)
    }

    /// Index of a node in a field; `None` outside the lattice.
    pub(crate) fn index(&self, i: isize, j: isize) -> Option<usize> {
        let wrap = |k: isize, axis: usize| -> Option<usize> {
            let count = self.counts[axis] as isize;
            let inside = if self.periodic[axis] { k.rem_euclid(count.max(1)) } else { k };
            (0..count).contains(&inside).then_some(inside as usize)
        };
        Some(wrap(i, 0)? + self.counts[0] * wrap(j, 1)?)
    }

    /// Positions of all nodes in m, in the order of a field.
    pub fn nodes(&self) -> Vec<Vec2> {
        (0..self.counts[1]).flat_map(|j| (0..self.counts[0]).map(move |i| self.position(i, j))).collect()
    }

    /// Period in m along each axis, if periodic.
    pub(crate) fn period(&self) -> [Option<f64>; 2] {
        [0, 1].map(|axis| self.periodic[axis].then(|| self.counts[axis] as f64 * self.spacing[axis]))
    }

    /// The lattice with `fields`, each of [`len`](Self::len) values, as a grid for output.
    pub fn grid<'a>(&self, fields: Vec<Field<'a>>) -> Grid<'a> {
        Grid { origin: self.origin, spacing: self.spacing, counts: self.counts, fields }
    }
}
