//! Counting-sort cell list: finds the points within the support of the kernel, also across periodic sides.

use crate::domain::Domain;
use crate::parallel::values;
use meniscus_core::math::Vec2;

/// Points sorted into cells at least as wide as the support.
#[derive(Debug, Clone, Default)]
pub(super) struct Cells {
    origin: Vec2,
    inverse_size: Vec2,
    counts: [usize; 2],
    periodic: [bool; 2],
    period: Vec2,
    /// Cell i holds the entries `start[i]..start[i + 1]` of `order`.
    start: Vec<u32>,
    /// The points in the order of their cells.
    pub(super) order: Vec<u32>,
    sorted: Vec<Vec2>,
}

/// A run of consecutive entries whose points are shifted by `shift`.
#[derive(Debug, Clone, Copy)]
struct Run {
    first: usize,
    end: usize,
    shift: Vec2,
}

impl Cells {
    /// Sorts `points` into cells at least `support` (m) wide.
    pub(crate) fn build(points: &[Vec2], domain: &Domain, support: f64) -> Self {
        let (mut low, mut high) = (domain.bounds.min, domain.bounds.max);
        for x in points.iter().filter(|x| x.iter().all(|v| v.is_finite())) {
            low = low.inf(x);
            high = high.sup(x);
        }
        let mut counts = [1; 2];
        let mut size = Vec2::zeros();
        for i in 0..2 {
            if domain.periodic[i] {
                (low[i], high[i]) = (domain.bounds.min[i], domain.bounds.max[i]);
            }
            // A runaway particle must not exhaust the memory: coarser cells are slower, never wrong.
            let most = 4.0 * (points.len() as f64).sqrt() + 8.0;
            counts[i] = ((high[i] - low[i]) / support).floor().clamp(1.0, most) as usize;
            size[i] = (high[i] - low[i]) / counts[i] as f64;
        }
        let mut cells = Self {
            origin: low,
            inverse_size: size.map(|s| 1.0 / s),
            counts,
            periodic: domain.periodic,
            period: domain.bounds.size(),
            ..Self::default()
        };
        cells.sort(points);
        cells
    }

    fn sort(&mut self, points: &[Vec2]) {
        let cell_of: Vec<u32> = values(points.len(), |i| self.cell_of(points[i]));
        (self.start, self.order) = members(&cell_of, self.counts[0] * self.counts[1]);
        self.sorted = values(self.order.len(), |i| points[self.order[i] as usize]);
    }

    fn column_and_row(&self, x: Vec2) -> [usize; 2] {
        [0, 1].map(|i| {
            let t = ((x[i] - self.origin[i]) * self.inverse_size[i]).floor();
            t.clamp(0.0, (self.counts[i] - 1) as f64) as usize
        })
    }

    fn cell_of(&self, x: Vec2) -> u32 {
        let [column, row] = self.column_and_row(x);
        (row * self.counts[0] + column) as u32
    }

    /// Calls `visit(index, x − x_index)` for each point in the cells around `x`, always in the same order.
    ///
    /// A periodic direction must be at least three supports long, or a point would be visited twice.
    pub(crate) fn visit_near(&self, x: Vec2, mut visit: impl FnMut(u32, Vec2)) {
        let [column, row] = self.column_and_row(x);
        for (row, shift_y) in self.three(1, row) {
            for run in self.runs(row, column, shift_y) {
                let from = x - run.shift;
                for k in run.first..run.end {
                    visit(self.order[k], from - self.sorted[k]);
                }
            }
        }
    }

    /// Appends to `found` the points nearer to `x` than the root of `reach2` (m²), except the index `but`, always in the same order.
    ///
    /// Branch-free: every candidate is written, and the end advances if it is kept. About one in three is, in no predictable order:
    /// mispredicted branches would cost more than all the arithmetic.
    pub(crate) fn collect_within(&self, x: Vec2, reach2: f64, but: u32, found: &mut Vec<u32>) {
        let [column, row] = self.column_and_row(x);
        for (row, shift_y) in self.three(1, row) {
            for run in self.runs(row, column, shift_y) {
                let from = x - run.shift;
                let mut end = found.len();
                found.resize(end + run.end - run.first, 0);
                for (&i, y) in self.order[run.first..run.end].iter().zip(&self.sorted[run.first..run.end]) {
                    found[end] = i;
                    end += usize::from(((from - y).norm_squared() < reach2) & (i != but));
                }
                found.truncate(end);
            }
        }
    }

    /// The neighboring rows or columns of `at` with the shift of the points in them.
    fn three(&self, axis: usize, at: usize) -> impl Iterator<Item = (usize, f64)> + use<> {
        let n = self.counts[axis] as isize;
        let (periodic, period) = (self.periodic[axis], self.period[axis]);
        (-1..=1).filter_map(move |step| {
            let i = at as isize + step;
            if (0..n).contains(&i) {
                Some((i as usize, 0.0))
            } else if periodic {
                Some((i.rem_euclid(n) as usize, if i < 0 { -period } else { period }))
            } else {
                None
            }
        })
    }

    /// The three cells of a row around `column`: one run, or one per cell at a periodic side.
    fn runs(&self, row: usize, column: usize, shift_y: f64) -> impl Iterator<Item = Run> + '_ {
        let inside = column > 0 && column + 1 < self.counts[0];
        let base = row * self.counts[0];
        let whole = inside.then(|| Run {
            first: self.start[base + column - 1] as usize,
            end: self.start[base + column + 2] as usize,
            shift: Vec2::new(0.0, shift_y),
        });
        let single = (!inside).then(|| {
            self.three(0, column).map(move |(c, shift_x)| Run {
                first: self.start[base + c] as usize,
                end: self.start[base + c + 1] as usize,
                shift: Vec2::new(shift_x, shift_y),
            })
        });
        whole.into_iter().chain(single.into_iter().flatten())
    }
}

/// The start of each of `count` groups in the list of their members, one more than groups, and the list; `group` has that of each member.
pub(super) fn members(group: &[u32], count: usize) -> (Vec<u32>, Vec<u32>) {
    let mut start = vec![0; count + 1];
    for &group in group {
        start[group as usize + 1] += 1;
    }
    for i in 0..count {
        start[i + 1] += start[i];
    }
    let mut next = start.clone();
    let mut members = vec![0; group.len()];
    for (i, &group) in group.iter().enumerate() {
        members[next[group as usize] as usize] = i as u32;
        next[group as usize] += 1;
    }
    (start, members)
}
