//! A displacement, record by record, on the cells on which both are compared.

use super::comparison::Side;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::elements::Elements;

/// Cells along the longer side of the domain on which phases are compared.
const CELLS: f64 = 240.0;

/// A state of one of the two: a point of the curve, and the cells of the invading phase.
#[derive(Debug, Clone)]
pub(crate) struct Record {
    /// Time in s; NaN if there is none.
    pub(crate) time: f64,
    /// Saturation of the wetting phase.
    pub(crate) saturation: f64,
    /// Capillary pressure p_n - p_w in Pa, of displacements in time the inlet pressure minus the outlet pressure; NaN if there is none.
    pub(crate) pressure: f64,
    /// For each cell of the pore, whether it has the invading phase.
    pub(crate) invaded: Vec<bool>,
}

/// The displacement of one of the two.
#[derive(Debug, Clone, Default)]
pub(crate) struct Track {
    pub(crate) records: Vec<Record>,
    /// For each element, the record at which the invading phase first filled more than half of it.
    pub(crate) filled: Vec<Option<usize>>,
    /// Of a displacement in time: time of breakthrough in s, and the saturation of the invading phase then.
    pub(crate) breakthrough: Option<[f64; 2]>,
    /// Its cost, permeability and warnings.
    pub(crate) totals: Side,
}

impl Track {
    /// Adds a record, and notes which elements the invading phase has filled then.
    pub(crate) fn add(&mut self, record: Record, is_filled: impl Fn(usize) -> bool) {
        let filled = self.filled.iter_mut().enumerate().filter(|(element, _)| is_filled(*element));
        filled.for_each(|(_, filled)| _ = filled.get_or_insert(self.records.len()));
        self.records.push(record);
    }
}

/// The cells on which both are compared.
pub(crate) struct Grid {
    pub(crate) bounds: Bounds,
    pub(crate) counts: [usize; 2],
    /// Indices of the cells with centers in the pore, row by row, and the element of each.
    pub(crate) cells: Vec<(usize, usize)>,
}

impl Grid {
    pub(crate) fn new(bounds: Bounds, elements: &Elements) -> Self {
        let size = bounds.size();
        let counts = [0, 1].map(|axis| (CELLS * size[axis] / size.max()).ceil().max(1.0) as usize);
        let mut grid = Self { bounds, counts, cells: Vec::new() };
        grid.cells =
            (0..counts[0] * counts[1]).filter_map(|cell| Some((cell, elements.at(grid.middle(cell))?))).collect();
        grid
    }

    /// For each cell, whether its element is filled.
    pub(crate) fn in_filled(&self, is_filled: impl Fn(usize) -> bool) -> Vec<bool> {
        self.cells.iter().map(|&(_, element)| is_filled(element)).collect()
    }

    pub(crate) fn middle(&self, cell: usize) -> Vec2 {
        let coordinates = Vec2::new((cell % self.counts[0]) as f64 + 0.5, (cell / self.counts[0]) as f64 + 0.5);
        self.bounds.min + self.cell().component_mul(&coordinates)
    }

    /// Width and height of a cell in m.
    pub(crate) fn cell(&self) -> Vec2 {
        self.bounds.size().component_div(&Vec2::new(self.counts[0] as f64, self.counts[1] as f64))
    }
}
