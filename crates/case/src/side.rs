//! The four sides of a domain and their kinds.

use meniscus_core::input::tables::words;

words! {
    /// Kind of a side.
    pub enum Side {
        /// Periodic with the opposite side.
        Periodic,
        /// A solid no-slip wall, which can have contact lines.
        Wall,
        /// A no-slip wall by image particles; no contact angle is set on it.
        Image,
        /// A mirror: free slip.
        Symmetry,
        /// Open, with a velocity, a flow rate or a pressure.
        Inlet,
        /// Open, with a pressure.
        Outlet,
    }

    /// A side by its name.
    pub enum SideName {
        /// x = min.
        Left,
        /// x = max.
        Right,
        /// y = min.
        Bottom,
        /// y = max.
        Top,
    }
}

impl SideName {
    /// The number of the side: 0 to 3 for left, right, bottom and top.
    pub(crate) fn number(self) -> usize {
        self as usize
    }
}

/// Names of the sides in the order of their numbers.
pub const SIDES: [&str; 4] = ["left", "right", "bottom", "top"];

/// The four sides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct Sides {
    /// x = min.
    pub left: Side,
    /// x = max.
    pub right: Side,
    /// y = min.
    pub bottom: Side,
    /// y = max.
    pub top: Side,
}

impl Sides {
    /// The sides in the order of their numbers.
    pub fn each(&self) -> [Side; 4] {
        [self.left, self.right, self.bottom, self.top]
    }

    /// Whether the domain is periodic along x and y.
    pub fn periodic(&self) -> [bool; 2] {
        [self.left, self.bottom].map(|side| side == Side::Periodic)
    }

    /// Which sides are walls.
    pub fn walls(&self) -> [bool; 4] {
        self.each().map(|side| side == Side::Wall)
    }

    /// Which sides are inlets and outlets.
    pub fn open(&self) -> [bool; 4] {
        self.each().map(|side| matches!(side, Side::Inlet | Side::Outlet))
    }
}
