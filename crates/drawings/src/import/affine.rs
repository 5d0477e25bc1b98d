//! Affine maps of the plane: the nested transforms of drawings.

use meniscus_core::math::{Mat2, Vec2};

/// x ↦ linear · x + shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Affine {
    /// The linear part.
    pub(crate) linear: Mat2,
    /// The image of the origin.
    pub(crate) shift: Vec2,
}

impl Affine {
    pub(crate) fn identity() -> Self {
        Self { linear: Mat2::identity(), shift: Vec2::zeros() }
    }

    /// The map with the given columns of the linear part.
    pub(crate) fn from_columns(x: Vec2, y: Vec2, shift: Vec2) -> Self {
        Self { linear: Mat2::from_columns(&[x, y]), shift }
    }

    /// The shift by `by`.
    pub(crate) fn translation(by: Vec2) -> Self {
        Self { linear: Mat2::identity(), shift: by }
    }

    /// The map that scales x by `x` and y by `y`.
    pub(crate) fn scaling(x: f64, y: f64) -> Self {
        Self { linear: Mat2::new(x, 0.0, 0.0, y), shift: Vec2::zeros() }
    }

    /// The counter-clockwise rotation about the origin by `degrees`, exact for multiples of 90.
    pub(crate) fn rotation_deg(degrees: f64) -> Self {
        let (sin, cos) = match degrees.rem_euclid(360.0) {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            turn => turn.to_radians().sin_cos(),
        };
        Self { linear: Mat2::new(cos, -sin, sin, cos), shift: Vec2::zeros() }
    }

    /// The composition: `first`, then this map.
    pub(crate) fn after(&self, first: &Self) -> Self {
        Self { linear: self.linear * first.linear, shift: self.apply(first.shift) }
    }

    /// The image of a point.
    pub(crate) fn apply(&self, x: Vec2) -> Vec2 {
        self.linear * x + self.shift
    }

    /// The image of a vector.
    pub(crate) fn turn(&self, v: Vec2) -> Vec2 {
        self.linear * v
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_after_another_does_that_one_first() {
        let (a, b) = (Affine::rotation_deg(30.0), Affine::translation(Vec2::new(2.0, 1.0)));
        let x = Vec2::new(-1.0, 4.0);
        assert!((a.after(&b).apply(x) - a.apply(b.apply(x))).norm() < 1e-15);
    }
}
