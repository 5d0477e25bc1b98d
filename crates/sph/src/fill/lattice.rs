//! The square lattice of particles, and filling on it.

use rayon::prelude::*;

use crate::fill::positions::Positions;
use crate::kernel::WendlandC2;
use meniscus_core::math::{Bounds, Vec2};

/// A square lattice commensurate with the box: an integer number of cells along each side, a particle in the center of each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    bounds: Bounds,
    counts: [usize; 2],
    /// Spacing of neighboring particles along x and y in m.
    pub step: Vec2,
}

impl Lattice {
    /// The lattice with the spacing closest to `spacing` (m) that is commensurate with `bounds`.
    pub fn fitting(bounds: Bounds, spacing: f64) -> Self {
        let size = bounds.size();
        let counts = [0, 1].map(|i| (size[i] / spacing).round().max(1.0) as usize);
        let step = Vec2::new(size.x / counts[0] as f64, size.y / counts[1] as f64);
        Self { bounds, counts, step }
    }

    /// V_0 = dx² in m²: area of the cell of a particle.
    pub fn volume(&self) -> f64 {
        self.step.x * self.step.y
    }

    /// The kernel normalized on this lattice, see [`WendlandC2::divided_by`].
    pub fn consistent(&self, kernel: WendlandC2) -> WendlandC2 {
        let (unity, twice) = self.neighbors(kernel.support()).fold((0.0, 0.0), |(unity, twice), r| {
            let (w, grad_w) = kernel.w_and_grad(r);
            (unity + w, twice - r.dot(&grad_w))
        });
        kernel.divided_by(self.volume() * unity, 0.5 * self.volume() * twice)
    }

    /// The lattice points around one of them, itself included.
    fn neighbors(&self, reach: f64) -> impl Iterator<Item = Vec2> {
        let step = self.step;
        let (nx, ny) = ((reach / step.x).ceil() as i64, (reach / step.y).ceil() as i64);
        (-ny..=ny).flat_map(move |j| (-nx..=nx).map(move |i| Vec2::new(i as f64 * step.x, j as f64 * step.y)))
    }

    /// Whether the segment from `a` to `b` (m) is parallel to an axis and on a boundary between cells of the lattice.
    pub(crate) fn fits(&self, a: Vec2, b: Vec2) -> bool {
        const ROUNDING: f64 = 1e-6;
        (0..2).any(|i| {
            let rows = (a[i] - self.bounds.min[i]) / self.step[i];
            (a[i] - b[i]).abs() < ROUNDING * self.step[i] && (rows - rows.round()).abs() < ROUNDING
        })
    }

    /// Whether `x` (m) is within the box.
    pub(super) fn contains(&self, x: Vec2) -> bool {
        self.bounds.contains(x)
    }

    /// The box that [`Lattice::points`] fills.
    pub(super) fn extent(&self, margin: f64, beyond: [bool; 4]) -> Bounds {
        let by =
            |side: usize| if beyond[side] { (margin / self.step[side / 2]).ceil() * self.step[side / 2] } else { 0.0 };
        Bounds { min: self.bounds.min - Vec2::new(by(0), by(2)), max: self.bounds.max + Vec2::new(by(1), by(3)) }
    }

    /// The lattice points of the box.
    pub(crate) fn inside(&self) -> impl Iterator<Item = Vec2> + '_ {
        self.points(0.0, [false; 4])
    }

    /// The lattice points to a depth of `margin` (m) beyond the sides for which `open` holds, corners at `walls` included.
    pub(crate) fn beyond(&self, margin: f64, walls: [bool; 4], open: [bool; 4]) -> impl Iterator<Item = Vec2> + '_ {
        let all = [0, 1, 2, 3].map(|side| walls[side] || open[side]);
        let Bounds { min, max } = self.bounds;
        self.points(margin, all).filter(move |x| {
            let beyond = [x.x < min.x, x.x > max.x, x.y < min.y, x.y > max.y];
            (0..4).any(|side| open[side] && beyond[side])
        })
    }

    /// The lattice points of the box, and of a margin of `margin` (m) beyond the sides for which `beyond` holds.
    pub(super) fn points(&self, margin: f64, beyond: [bool; 4]) -> impl Iterator<Item = Vec2> + '_ {
        let extra = |i: usize, side: usize| if beyond[side] { (margin / self.step[i]).ceil() as i64 } else { 0 };
        let (left, right, bottom, top) = (extra(0, 0), extra(0, 1), extra(1, 2), extra(1, 3));
        let [nx, ny] = self.counts.map(|n| n as i64);
        (-bottom..ny + top).flat_map(move |j| {
            (-left..nx + right).map(move |i| {
                self.bounds.min + Vec2::new((i as f64 + 0.5) * self.step.x, (j as f64 + 0.5) * self.step.y)
            })
        })
    }
}

/// The `points` (m) in their order, each with the value of `find`, computed in parallel.
pub(super) fn each_with<T: Send>(
    points: impl Iterator<Item = Vec2>,
    find: impl Fn(Vec2) -> T + Sync,
) -> impl Iterator<Item = (Vec2, T)> {
    let points: Vec<Vec2> = points.collect();
    let found: Vec<T> = points.par_iter().map(|&x| find(x)).collect();
    points.into_iter().zip(found)
}

/// Fills the domain on the lattice: fluid where the signed distance is above zero, wall particles down to a depth of the support.
///
/// `signed_distance` in m; `walls`: which sides (left, right, bottom, top) are walls, with wall particles beyond them.
pub fn on_lattice(
    lattice: &Lattice,
    support: f64,
    walls: [bool; 4],
    signed_distance: impl Fn(Vec2) -> f64 + Sync,
) -> Positions {
    let mut positions = Positions::default();
    for (x, d) in each_with(lattice.points(support, walls), signed_distance) {
        if d > 0.0 && lattice.contains(x) {
            positions.fluid.push(x);
        } else if d <= 0.0 && d > -support {
            positions.push_wall(x, -d);
        }
    }
    positions
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sums_of_the_kernel_over_its_lattice_are_their_integrals() {
        // Cells of 1 by 1.05: a lattice commensurate with its box.
        let bounds = Bounds { min: Vec2::zeros(), max: Vec2::new(20.0, 21.0) };
        let lattice = Lattice { bounds, counts: [20, 20], step: Vec2::new(1.0, 1.05) };
        let plain = WendlandC2::new(1.5);
        let kernel = lattice.consistent(plain);
        let sum = |kernel: &WendlandC2, of: &dyn Fn(Vec2, f64, Vec2) -> f64| {
            let terms = lattice.neighbors(kernel.support()).map(|r| {
                let (w, grad_w) = kernel.w_and_grad(r);
                lattice.volume() * of(r, w, grad_w)
            });
            terms.sum::<f64>()
        };
        let unity = |kernel: &WendlandC2| sum(kernel, &|_, w, _| w);
        let moment = |kernel: &WendlandC2| sum(kernel, &|r, _, grad_w| -0.5 * r.dot(&grad_w));
        assert!((unity(&plain) - 1.0).abs() > 1e-3 && (moment(&plain) - 1.0).abs() > 1e-3);
        assert!((unity(&kernel) - 1.0).abs() < 1e-14 && (moment(&kernel) - 1.0).abs() < 1e-14);
    }
}
