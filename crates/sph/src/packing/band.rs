//! The part of the plane near given points, as a set of square cells.

use crate::domain::Domain;
use meniscus_core::math::Vec2;

/// Cells per reach of a band: the finer, the less the band exceeds its reach.
const CELLS_PER_REACH: f64 = 4.0;

/// Square cells near given points, also across periodic sides. Points outside the box belong to the cells at its sides.
pub(super) struct Band {
    origin: Vec2,
    size: Vec2,
    counts: [usize; 2],
    periodic: [bool; 2],
    inside: Vec<bool>,
}

impl Band {
    /// All within `reach` (m) along each axis of one of the `points` (m), rounded up to whole cells.
    pub(crate) fn around(points: impl Iterator<Item = Vec2>, reach: f64, domain: &Domain) -> Self {
        let size = domain.bounds.size();
        let counts = [0, 1].map(|i| (size[i] * CELLS_PER_REACH / reach).floor().max(1.0) as usize);
        let size = Vec2::new(size.x / counts[0] as f64, size.y / counts[1] as f64);
        let inside = vec![false; counts[0] * counts[1]];
        let mut band = Self { origin: domain.bounds.min, size, counts, periodic: domain.periodic, inside };
        for x in points {
            let cell = band.cell(x);
            band.inside[cell] = true;
        }
        band.grown(reach)
    }

    /// The band and all within `by` (m) along each axis of it.
    pub(crate) fn grown(mut self, by: f64) -> Self {
        for axis in 0..2 {
            let cells = (by / self.size[axis]).ceil() as isize;
            let count = self.counts[axis] as isize;
            let step = if axis == 0 { 1 } else { self.counts[0] };
            let mut grown = vec![false; self.inside.len()];
            for (cell, _) in self.inside.iter().enumerate().filter(|(_, inside)| **inside) {
                let at = (cell / step % self.counts[axis]) as isize;
                let first = cell - at as usize * step;
                for k in at - cells.min(count)..=at + cells.min(count) {
                    let k = if self.periodic[axis] { k.rem_euclid(count) } else { k };
                    if (0..count).contains(&k) {
                        grown[first + k as usize * step] = true;
                    }
                }
            }
            self.inside = grown;
        }
        self
    }

    /// Whether `x` (m) lies in the band.
    pub(crate) fn contains(&self, x: Vec2) -> bool {
        self.inside[self.cell(x)]
    }

    fn cell(&self, x: Vec2) -> usize {
        let [column, row] = [0, 1].map(|i| {
            let k = ((x[i] - self.origin[i]) / self.size[i]).floor();
            k.clamp(0.0, (self.counts[i] - 1) as f64) as usize
        });
        column + self.counts[0] * row
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::math::Bounds;

    #[test]
    fn a_band_holds_all_within_its_reach_and_little_more() {
        let bounds = Bounds { min: Vec2::new(-1.0, 0.0), max: Vec2::new(9.0, 10.0) };
        let domain = Domain::new(bounds, [true, false], vec![]);
        let points = [Vec2::new(-0.9, 5.0), Vec2::new(3.0, 0.1)];
        let band = Band::around(points.into_iter(), 1.0, &domain);
        for x in (0..10_000).map(|i| bounds.min + 0.1 * Vec2::new(f64::from(i % 100), f64::from(i / 100))) {
            let far = |point: &Vec2| domain.separation(x, *point).amax();
            let nearest = points.iter().map(far).fold(f64::INFINITY, f64::min);
            assert!(band.contains(x) || nearest > 1.0, "{x:?} is missing");
            assert!(!band.contains(x) || nearest < 1.51, "{x:?} is too much");
        }
        let grown = band.grown(2.0);
        let inside = |x, y| grown.contains(Vec2::new(x, y));
        assert!(inside(7.0, 5.0) && inside(3.0, 3.0) && !inside(5.5, 9.9));
    }

    #[test]
    fn a_reach_beyond_the_box_takes_all_of_it_and_no_place_nothing() {
        let domain = Domain::new(Bounds { min: Vec2::zeros(), max: Vec2::repeat(1.0) }, [true, false], vec![]);
        let all = Band::around([Vec2::repeat(0.1)].into_iter(), 3.0, &domain);
        assert!(all.contains(Vec2::repeat(0.9)) && all.contains(Vec2::new(0.5, 1.2)));
        assert!(!Band::around(std::iter::empty(), 0.1, &domain).contains(Vec2::repeat(0.5)));
    }
}
