//! All pairs within the support, with W, ∇W and the weight of the Laplacians, computed once per step and used by all its sums.

use std::iter::Sum;
use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use crate::cells::Cells;
use crate::domain::Domain;
use crate::kernel::WendlandC2;
use crate::parallel::{GRAIN, values};
use meniscus_core::math::Vec2;

/// ζ over h, in [`Viscous`](crate::terms::viscosity::Viscous): keeps the denominators of the Laplacians above zero.
const ZETA: f64 = 0.01;

/// A neighbor b of a particle a.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    /// Index of the neighbor; indices beyond the particles are images.
    pub b: usize,
    /// W_ab in 1/m².
    pub w: f64,
    /// ∇_a W_ab in 1/m³.
    pub grad_w: Vec2,
    /// r_ab·∇_a W_ab/(|r_ab|² + ζ²) in 1/m⁴, never above 0: the weight of differences in the Laplacians of Eqs. (16) and (30).
    pub slope: f64,
}

/// The neighbors of each particle (excluding itself), in compressed rows.
///
/// Weights are stored in single precision and summed in double: half the memory traffic of every sum, for a relative error of 6e-8 in each
/// weight, while the sums themselves have errors of a percent. W_ab = W_ba and ∇_a W_ab = −∇_b W_ba still hold to the last bit.
#[derive(Debug, Clone, Default)]
pub struct Pairs {
    /// The row starts, one more than rows. The sparsity pattern is shared with the pressure matrix.
    pub(crate) start: Arc<Vec<usize>>,
    /// The neighbors, row by row.
    pub(crate) b: Arc<Vec<u32>>,
    w: Vec<f32>,
    grad_w: Vec<[f32; 2]>,
    slope: Vec<f32>,
    /// W(0) in 1/m²: the contribution of a particle to its own sum.
    pub w_self: f64,
}

/// The neighbors of the particles of one task: their number per particle, and all of them, row by row.
type Rows = (Vec<u32>, Vec<u32>);

impl Pairs {
    /// Finds the neighbors of the first `count` of `points` among all of them.
    pub fn find(points: &[Vec2], count: usize, domain: &Domain, kernel: &WendlandC2) -> Self {
        let mut pairs = Self::default();
        pairs.update(&Cells::build(points, domain, kernel.support()), points, count, domain, kernel);
        pairs
    }

    /// [`Pairs::find`] that reuses the memory of the previous pairs, with given `cells` of all `points`.
    pub(crate) fn update(
        &mut self,
        cells: &Cells,
        points: &[Vec2],
        count: usize,
        domain: &Domain,
        kernel: &WendlandC2,
    ) {
        let reach2 = kernel.support() * kernel.support();
        let chunks: Vec<Rows> = points[..count]
            .par_chunks(GRAIN)
            .enumerate()
            .map(|(chunk, xs)| {
                let mut counts = Vec::with_capacity(xs.len());
                let mut found = Vec::with_capacity(xs.len() * 32);
                for (i, &x) in xs.iter().enumerate() {
                    let a = (chunk * GRAIN + i) as u32;
                    let before = found.len();
                    cells.collect_within(x, reach2, a, &mut found);
                    counts.push((found.len() - before) as u32);
                }
                (counts, found)
            })
            .collect();
        self.take_rows(&chunks, points, domain, kernel);
    }

    /// Concatenates the rows of chunks of [`GRAIN`] particles and evaluates the kernel on them.
    fn take_rows(&mut self, chunks: &[Rows], points: &[Vec2], domain: &Domain, kernel: &WendlandC2) {
        let mut start = reclaimed(&mut self.start);
        start.clear();
        start.push(0);
        let mut end = 0;
        for count in chunks.iter().flat_map(|(counts, _)| counts) {
            end += *count as usize;
            start.push(end);
        }
        let mut b = reclaimed(&mut self.b);
        b.resize(end, 0);
        self.w.resize(end, 0.0);
        self.grad_w.resize(end, [0.0; 2]);
        self.slope.resize(end, 0.0);
        self.w_self = kernel.w(0.0);
        let zeta2 = (ZETA * kernel.h).powi(2);
        let parts = split_rows(&start, &mut b)
            .zip(split_rows(&start, &mut self.w))
            .zip(split_rows(&start, &mut self.grad_w))
            .zip(split_rows(&start, &mut self.slope))
            .zip(chunks);
        parts.collect::<Vec<_>>().into_par_iter().for_each(
            |(((((rows, b), (_, w)), (_, grad_w)), (_, slope)), (_, found))| {
                b.copy_from_slice(found);
                let offset = start[rows.start];
                for a in rows {
                    for i in start[a] - offset..start[a + 1] - offset {
                        let r_ab = domain.separation(points[a], points[b[i] as usize]);
                        let (w_ab, over_r) = kernel.w_and_slope(r_ab.norm());
                        w[i] = w_ab as f32;
                        grad_w[i] = [r_ab.x * over_r, r_ab.y * over_r].map(|g| g as f32);
                        let r2 = r_ab.norm_squared();
                        slope[i] = (over_r * r2 / (r2 + zeta2)) as f32;
                    }
                }
            },
        );
        (self.start, self.b) = (Arc::new(start), Arc::new(b));
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.start.len() - 1
    }

    /// Number of neighbors over all rows.
    pub fn len(&self) -> usize {
        self.b.len()
    }

    /// The range of the row of `a` in [`Pairs::b`].
    #[inline]
    pub(crate) fn row(&self, a: usize) -> Range<usize> {
        self.start[a]..self.start[a + 1]
    }

    /// The neighbors of `a`, always in the same order.
    #[inline]
    pub fn of(&self, a: usize) -> impl Iterator<Item = Pair> + '_ {
        let row = self.row(a);
        let (b, w) = (&self.b[row.clone()], &self.w[row.clone()]);
        let (grad_w, slope) = (&self.grad_w[row.clone()], &self.slope[row]);
        let weights = w.iter().zip(grad_w).zip(slope);
        b.iter().zip(weights).map(|(&b, ((&w, &[x, y]), &slope))| Pair {
            b: b as usize,
            w: f64::from(w),
            grad_w: Vec2::new(f64::from(x), f64::from(y)),
            slope: f64::from(slope),
        })
    }

    /// Σ_b `term(a, ab)` of each of the first `count` particles a, in parallel.
    pub(crate) fn sums<T: Sum + Send>(&self, count: usize, term: impl Fn(usize, &Pair) -> T + Sync) -> Vec<T> {
        values(count, |a| self.of(a).map(|ab| term(a, &ab)).sum())
    }

    /// Memory in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.start.len() * 8 + self.b.len() * (4 + 4 + 8 + 4)
    }
}

/// The memory of a list that is no longer shared.
fn reclaimed<T>(shared: &mut Arc<Vec<T>>) -> Vec<T> {
    Arc::get_mut(shared).map(std::mem::take).unwrap_or_default()
}

/// Splits `values`, one per pair, into parts of `GRAIN` rows each, one per task, with the rows of each part.
pub(crate) fn split_rows<'a, T>(
    starts: &'a [usize],
    values: &'a mut [T],
) -> impl Iterator<Item = (Range<usize>, &'a mut [T])> {
    let count = starts.len() - 1;
    let mut rest = values;
    (0..count).step_by(GRAIN).map(move |first| {
        let end = (first + GRAIN).min(count);
        let (here, after) = std::mem::take(&mut rest).split_at_mut(starts[end] - starts[first]);
        rest = after;
        (first..end, here)
    })
}

#[cfg(test)]
impl Pairs {
    /// Brute-force reference for [`Pairs::find`], in the order of the indices.
    pub(crate) fn brute_force(points: &[Vec2], count: usize, domain: &Domain, kernel: &WendlandC2) -> Self {
        let row = |a: usize| -> Vec<u32> {
            let near = |&b: &usize| b != a && domain.separation(points[a], points[b]).norm() < kernel.support();
            (0..points.len()).filter(near).map(|b| b as u32).collect()
        };
        let rows: Vec<Vec<u32>> = (0..count).map(row).collect();
        let chunk = |rows: &[Vec<u32>]| (rows.iter().map(|r| r.len() as u32).collect(), rows.concat());
        let mut pairs = Self::default();
        pairs.take_rows(&rows.chunks(GRAIN).map(chunk).collect::<Vec<Rows>>(), points, domain, kernel);
        pairs
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::math::Bounds;
    use proptest::prelude::*;

    /// Relative rounding error of a weight.
    const ROUNDING: f64 = f32::EPSILON as f64;

    fn sorted_row(pairs: &Pairs, a: usize) -> Vec<(usize, f64)> {
        let mut row: Vec<_> = pairs.of(a).map(|ab| (ab.b, ab.w)).collect();
        row.sort_by_key(|r| r.0);
        row
    }

    proptest! {
        #[test]
        fn cells_find_the_same_pairs_as_brute_force(
            points in proptest::collection::vec((-0.3..3.3_f64, -0.3..3.3_f64), 2..150),
            periodic in any::<[bool; 2]>(),
            h in 0.1..0.5_f64,
        ) {
            let bounds = Bounds { min: Vec2::zeros(), max: Vec2::repeat(3.0) };
            let domain = Domain::new(bounds, periodic, vec![]);
            let points: Vec<Vec2> = points.iter().map(|&(x, y)| domain.wrapped(Vec2::new(x, y))).collect();
            let kernel = WendlandC2::new(h);
            let count = points.len() / 2 + 1;
            let fast = Pairs::find(&points, count, &domain, &kernel);
            let slow = Pairs::brute_force(&points, count, &domain, &kernel);
            for a in 0..count {
                prop_assert_eq!(sorted_row(&fast, a), sorted_row(&slow, a));
            }
        }
    }

    #[test]
    fn the_slope_of_a_pair_is_its_gradient_along_the_separation_over_the_distance_squared() {
        let domain = Domain::new(Bounds { min: Vec2::zeros(), max: Vec2::repeat(1.0) }, [true, false], vec![]);
        let kernel = WendlandC2::new(0.1);
        let points = [Vec2::new(0.02, 0.5), Vec2::new(0.97, 0.58), Vec2::new(0.1, 0.5), Vec2::new(0.02, 0.5)];
        let pairs = Pairs::find(&points, points.len(), &domain, &kernel);
        let row: Vec<Pair> = pairs.of(0).collect();
        assert_eq!(row.len(), 3);
        for ab in row {
            let r_ab = domain.separation(points[0], points[ab.b]);
            let wanted = r_ab.dot(&kernel.grad_w(r_ab)) / (r_ab.norm_squared() + 1e-6);
            assert!(ab.slope <= 0.0 && (ab.slope - wanted).abs() <= ROUNDING * wanted.abs(), "{ab:?}, wanted {wanted}");
        }
    }
}
