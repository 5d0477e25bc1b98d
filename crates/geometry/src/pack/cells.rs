//! A cell list of points, periodic or not, for neighbor searches.

/// Cells over a rectangle, at least as wide as the reach.
pub(super) struct Cells {
    min: [f64; 2],
    size: [f64; 2],
    periodic: [bool; 2],
    counts: [usize; 2],
    /// Points of each cell.
    members: Vec<Vec<u32>>,
}

impl Cells {
    /// Empty cells for neighbors up to `reach` away.
    pub(crate) fn new(region: [[f64; 2]; 2], periodic: [bool; 2], reach: f64) -> Self {
        // More cells would cost memory and save nothing.
        const MOST: f64 = 2000.0;
        let size = [region[1][0] - region[0][0], region[1][1] - region[0][1]];
        let counts = size.map(|s| (s / reach).floor().clamp(1.0, MOST) as usize);
        Self { min: region[0], size, periodic, counts, members: vec![Vec::new(); counts[0] * counts[1]] }
    }

    fn index(&self, x: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|k| {
            let scaled = (x[k] - self.min[k]) / self.size[k] * self.counts[k] as f64;
            (scaled.max(0.0) as usize).min(self.counts[k] - 1)
        })
    }

    /// Adds a point, which must lie in the rectangle.
    pub(crate) fn add(&mut self, point: usize, x: [f64; 2]) {
        let [i, j] = self.index(x);
        self.members[j * self.counts[0] + i].push(point as u32);
    }

    /// Sorts all points anew.
    pub(crate) fn fill(&mut self, points: impl Iterator<Item = [f64; 2]>) {
        self.members.iter_mut().for_each(Vec::clear);
        for (k, x) in points.enumerate() {
            self.add(k, x);
        }
    }

    /// All points that may lie within the reach of `x`, in a fixed order.
    pub(crate) fn near(&self, x: [f64; 2], mut take: impl FnMut(usize)) {
        let at = self.index(x);
        let around = |k: usize| -> ([usize; 3], usize) {
            let (count, i) = (self.counts[k], at[k]);
            if count <= 3 {
                ([0, 1, 2], count)
            } else if self.periodic[k] {
                ([(i + count - 1) % count, i, (i + 1) % count], 3)
            } else {
                let first = i.saturating_sub(1);
                ([first, first + 1, first + 2], (i + 2).min(count) - first)
            }
        };
        let ((columns, wide), (rows, high)) = (around(0), around(1));
        for &row in &rows[..high] {
            for &column in &columns[..wide] {
                self.members[row * self.counts[0] + column].iter().for_each(|&k| take(k as usize));
            }
        }
    }

    /// The displacement from `a` to `b`, the shortest across periodic sides.
    pub(crate) fn between(&self, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| {
            let d = b[k] - a[k];
            if !self.periodic[k] {
                d
            } else if d > 0.5 * self.size[k] {
                d - self.size[k]
            } else if d < -0.5 * self.size[k] {
                d + self.size[k]
            } else {
                d
            }
        })
    }

    /// The distance of two points.
    pub(crate) fn distance(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        let [x, y] = self.between(a, b);
        (x * x + y * y).sqrt()
    }
}
