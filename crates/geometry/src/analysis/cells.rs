//! Neighbor search among scattered points, by a cell grid with a counting sort.
//!
//! The order of neighbors depends on the points alone, so sums over them have the same bits for any number of threads. Periodic sides are handled by nearest
//! images. Points are not reordered for cache locality.

use rayon::prelude::*;

use meniscus_core::math::{Vec2, nearest_image};

/// Scattered points sorted into square cells.
#[derive(Debug, Clone)]
pub struct Cells<'a> {
    points: &'a [Vec2],
    period: [Option<f64>; 2],
    origin: Vec2,
    size: Vec2,
    counts: [usize; 2],
    /// First entry of each cell in `order`, and the end of the last one.
    start: Vec<usize>,
    /// Point indices by cell.
    order: Vec<usize>,
}

/// Largest number of cells per point: bounds the memory where few points span a large box.
const CELLS_PER_POINT: f64 = 4.0;

impl<'a> Cells<'a> {
    /// Sorts `points` (m) into cells for searches with a radius of about `reach` (m); `period` in m along each axis.
    ///
    /// Points that are not finite are never found.
    pub(crate) fn new(points: &'a [Vec2], reach: f64, period: [Option<f64>; 2]) -> Self {
        let finite = || points.iter().filter(|p| p.iter().all(|x| x.is_finite()));
        let low = finite().fold(Vec2::repeat(f64::INFINITY), |low, p| low.inf(p));
        let high = finite().fold(Vec2::repeat(f64::NEG_INFINITY), |high, p| high.sup(p));
        let extent = [0, 1].map(|k| period[k].unwrap_or_else(|| (high[k] - low[k]).max(0.0)));
        let any = finite().next().is_some() && reach > 0.0;
        let most = (CELLS_PER_POINT * points.len() as f64).sqrt().max(1.0);
        let counts = extent.map(|e| if any { (e / reach).floor().clamp(1.0, most) as usize } else { 1 });
        let size = Vec2::new(extent[0] / counts[0] as f64, extent[1] / counts[1] as f64);
        let origin = if any { low } else { Vec2::zeros() };
        let mut cells = Self { points, period, origin, size, counts, start: Vec::new(), order: Vec::new() };
        cells.sort();
        cells
    }

    fn sort(&mut self) {
        let cell: Vec<Option<usize>> = self.points.par_iter().map(|&p| self.cell_of(p)).collect();
        let mut start = vec![0; self.counts[0] * self.counts[1] + 1];
        cell.iter().flatten().for_each(|&c| start[c + 1] += 1);
        for c in 1..start.len() {
            start[c] += start[c - 1];
        }
        let mut next = start.clone();
        self.order = vec![0; start.last().copied().unwrap_or(0)];
        for (point, c) in cell.iter().enumerate() {
            if let Some(c) = *c {
                self.order[next[c]] = point;
                next[c] += 1;
            }
        }
        self.start = start;
    }

    fn cell_of(&self, x: Vec2) -> Option<usize> {
        let finite = x.iter().all(|v| v.is_finite());
        finite.then(|| {
            let k = [0, 1].map(|axis| self.column(x, axis).clamp(0, self.counts[axis] as isize - 1) as usize);
            k[0] + self.counts[0] * k[1]
        })
    }

    /// Index of the cell column of `x` along one axis; wrapped if the axis is periodic, else possibly outside.
    fn column(&self, x: Vec2, axis: usize) -> isize {
        if self.size[axis] <= 0.0 {
            return 0;
        }
        let k = ((x[axis] - self.origin[axis]) / self.size[axis]).floor() as isize;
        if self.period[axis].is_some() { k.rem_euclid(self.counts[axis] as isize) } else { k }
    }

    /// Vector in m from `b` to `a`, by the nearest image if a side is periodic.
    pub(crate) fn difference(&self, a: Vec2, b: Vec2) -> Vec2 {
        nearest_image(a - b, self.period)
    }

    /// Calls `visit` with the index and the vector to `x` (m) of each point nearer to `x` than `radius` (m).
    pub(crate) fn for_each_near(&self, x: Vec2, radius: f64, mut visit: impl FnMut(usize, Vec2)) {
        if !x.iter().all(|v| v.is_finite()) || self.order.is_empty() {
            return;
        }
        for row in self.span(x, radius, 1) {
            for column in self.span(x, radius, 0) {
                let cell = column + self.counts[0] * row;
                for &b in &self.order[self.start[cell]..self.start[cell + 1]] {
                    let d = self.difference(x, self.points[b]);
                    if d.norm_squared() < radius * radius {
                        visit(b, d);
                    }
                }
            }
        }
    }

    /// The cell columns along one axis that the disc around `x` overlaps, each once.
    fn span(&self, x: Vec2, radius: f64, axis: usize) -> impl Iterator<Item = usize> + use<> {
        let count = self.counts[axis] as isize;
        let reach =
            if self.size[axis] > 0.0 { (radius / self.size[axis]).ceil().min(count as f64) as isize } else { 1 };
        let middle = self.column(x, axis);
        let periodic = self.period[axis].is_some();
        let (first, last) = if periodic && 2 * reach + 1 >= count {
            (0, count - 1)
        } else if periodic {
            (middle - reach, middle + reach)
        } else {
            // Points on the far boundary are clamped into the last cell, so it must be searched from outside the grid, too.
            ((middle - reach).clamp(0, count - 1), (middle + reach).clamp(0, count - 1))
        };
        (first..=last).map(move |k| k.rem_euclid(count) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattered(count: usize) -> Vec<Vec2> {
        (0..count).map(|i| Vec2::new((i as f64 * 0.754_877).fract(), (i as f64 * 0.569_840).fract())).collect()
    }

    #[test]
    fn neighbors_are_those_of_a_brute_force_search() {
        let points = scattered(300);
        for period in [[None, None], [Some(1.0), None], [Some(1.0), Some(1.0)]] {
            for reach in [0.03, 0.11, 0.45] {
                let cells = Cells::new(&points, reach, period);
                for x in [Vec2::new(0.01, 0.5), Vec2::new(0.99, 0.99), Vec2::new(1.02, -0.02), Vec2::new(0.4, 0.3)] {
                    let mut found = Vec::new();
                    cells.for_each_near(x, reach, |b, _| found.push(b));
                    found.sort_unstable();
                    let near = |p: &Vec2| nearest_image(x - p, period).norm() < reach;
                    let expected: Vec<usize> = (0..points.len()).filter(|&i| near(&points[i])).collect();
                    assert_eq!(found, expected, "period {period:?}, reach {reach}, at {x:?}");
                }
            }
        }
    }

    #[test]
    fn a_place_without_points_has_no_neighbors() {
        let cells = Cells::new(&[], 0.1, [None, None]);
        cells.for_each_near(Vec2::zeros(), 1.0, |_, _| unreachable!());
    }
}
