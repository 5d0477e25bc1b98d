//! The simulation box: periodic directions, mirror sides, the separation of two points, and the wall query.

use meniscus_core::math::{Bounds, Vec2};

/// The signed distance to the wall in m (positive in the pore) and the wall normal at a point.
pub(crate) type WallQuery = Box<dyn Fn(Vec2) -> (f64, Vec2) + Send + Sync>;

/// A mirror side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mirror {
    /// 0: normal along x, 1: along y.
    pub axis: usize,
    /// Coordinate of the side in m.
    pub at: f64,
    /// Velocity of the images.
    pub image: ImageVelocity,
}

/// How an image's velocity follows from its source's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageVelocity {
    /// v' = −v: no slip [Huber2013, Eq. 34].
    Reversed,
    /// The normal part is reversed: free slip.
    Mirrored,
}

impl Mirror {
    /// The velocity of the image of a particle with velocity `v` [Huber2013, Eq. 34].
    pub(crate) fn velocity(&self, v: Vec2) -> Vec2 {
        match self.image {
            ImageVelocity::Reversed => -v,
            ImageVelocity::Mirrored => self.reflect(v),
        }
    }

    /// The position of the image of a point (m).
    pub(crate) fn position(&self, x: Vec2) -> Vec2 {
        let mut image = x;
        image[self.axis] = 2.0 * self.at - x[self.axis];
        image
    }

    /// The vector `v` reflected at the side: its normal component changes sign.
    pub(crate) fn reflect(&self, v: Vec2) -> Vec2 {
        let mut image = v;
        image[self.axis] = -v[self.axis];
        image
    }
}

/// The box with the conditions at its sides.
#[derive(Debug, Clone, PartialEq)]
pub struct Domain {
    /// The box in m.
    pub bounds: Bounds,
    /// Whether the box is periodic along x and y.
    pub periodic: [bool; 2],
    /// Mirror sides.
    pub mirrors: Vec<Mirror>,
    period: Vec2,
    inverse_period: Vec2,
}

impl Domain {
    /// A box with periodic directions and mirrors.
    pub fn new(bounds: Bounds, periodic: [bool; 2], mirrors: Vec<Mirror>) -> Self {
        let size = bounds.size();
        let pick = |i: usize, value: f64| if periodic[i] { value } else { 0.0 };
        Self {
            bounds,
            periodic,
            mirrors,
            period: Vec2::new(pick(0, size.x), pick(1, size.y)),
            inverse_period: Vec2::new(pick(0, 1.0 / size.x), pick(1, 1.0 / size.y)),
        }
    }

    /// x_a − x_b in m by the minimum-image convention.
    #[inline]
    pub fn separation(&self, x_a: Vec2, x_b: Vec2) -> Vec2 {
        let mut r = x_a - x_b;
        for i in 0..2 {
            let turns = r[i] * self.inverse_period[i];
            // Most pairs do not cross a side, and rounding is a library call.
            if turns.abs() > 0.5 {
                r[i] -= self.period[i] * turns.round();
            }
        }
        r
    }

    /// The periodic copy of `x` inside the box.
    pub fn wrapped(&self, x: Vec2) -> Vec2 {
        let mut y = x;
        for i in 0..2 {
            y[i] -= self.period[i] * ((x[i] - self.bounds.min[i]) * self.inverse_period[i]).floor();
            // Rounding can give exactly the upper side, which is identified with the lower one.
            if self.periodic[i] && y[i] >= self.bounds.max[i] {
                y[i] = self.bounds.min[i];
            }
        }
        y
    }

    /// The period in m along each direction, `None` where it is not periodic.
    pub fn periods(&self) -> [Option<f64>; 2] {
        [0, 1].map(|i| self.periodic[i].then_some(self.period[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(periodic: [bool; 2]) -> Domain {
        Domain::new(Bounds { min: Vec2::new(-1.0, 0.0), max: Vec2::new(1.0, 1.0) }, periodic, vec![])
    }

    #[test]
    fn separation_takes_the_shortest_way_through_a_periodic_side() {
        let r = unit([true, false]).separation(Vec2::new(0.9, 0.9), Vec2::new(-0.9, 0.1));
        assert!((r - Vec2::new(-0.2, 0.8)).norm() < 1e-14);
    }

    #[test]
    fn wrapping_brings_a_point_back_and_leaves_walls_alone() {
        let x = unit([true, false]).wrapped(Vec2::new(1.25, 1.25));
        assert!((x - Vec2::new(-0.75, 1.25)).norm() < 1e-14);
        assert!(unit([true, true]).wrapped(Vec2::new(-1.0 - 1e-18, 0.0)).x < 1.0);
    }
}
