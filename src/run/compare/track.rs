//! A displacement, record by record, on the cells on which both are compared.

use crate::geometry::elements::Elements;
use crate::math::{Bounds, Vec2};

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
#[derive(Debug, Clone)]
pub(crate) struct Track {
    pub(crate) records: Vec<Record>,
    /// For each element, the record at which the invading phase first filled more than half of it.
    pub(crate) filled: Vec<Option<usize>>,
    pub(crate) wall_time_s: f64,
    pub(crate) processor_time_s: Option<f64>,
    pub(crate) unknowns: usize,
    pub(crate) steps: u64,
    pub(crate) permeability: Option<f64>,
    /// Of a displacement in time: time of breakthrough in s, and the wetting saturation then.
    pub(crate) breakthrough: Option<[f64; 2]>,
    pub(crate) warnings: Vec<String>,
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

    pub(crate) fn middle(&self, cell: usize) -> Vec2 {
        let coordinates = Vec2::new((cell % self.counts[0]) as f64 + 0.5, (cell / self.counts[0]) as f64 + 0.5);
        self.bounds.min + self.cell().component_mul(&coordinates)
    }

    /// Width and height of a cell in m.
    pub(crate) fn cell(&self) -> Vec2 {
        self.bounds.size().component_div(&Vec2::new(self.counts[0] as f64, self.counts[1] as f64))
    }
}
