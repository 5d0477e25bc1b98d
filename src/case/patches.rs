//! Parts of the walls with angles of their own, checked.

use crate::math::Vec2;
use crate::wetting::Wetting;

/// A part of the walls with angles of its own (`[[sph.wetting.patches]]`); later ones lie over earlier ones.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct WettingPatch {
    /// Which walls.
    pub on: PatchedWall,
    /// Which part of them; absent: all.
    pub stripes: Option<Stripes>,
    /// The model with the angles of the patch.
    pub model: Wetting,
}

/// The walls that a patch lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PatchedWall {
    /// All of them.
    All,
    /// A shape by its number, from 0 on.
    Shape(u32),
    /// The left, right, bottom or top side, 0 to 3.
    Side(u32),
}

/// Stripes across an axis: where the coordinate less `start`, modulo `period`, is below `width`.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Stripes {
    /// 0: along x, 1: along y.
    pub axis: usize,
    /// Where one of them begins, in m.
    pub start: f64,
    /// Width in m.
    pub width: f64,
    /// From one to the next in m; absent: a single stripe.
    pub period: Option<f64>,
}

impl Stripes {
    /// Whether a point of the wall with the given coordinates in m lies in a stripe.
    #[must_use]
    pub fn contains(&self, x: Vec2) -> bool {
        let along = x[self.axis] - self.start;
        let along = self.period.map_or(along, |period| along.rem_euclid(period));
        (0.0..self.width).contains(&along)
    }
}
