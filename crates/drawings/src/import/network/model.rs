//! A network in the plane, as its tables say.

use meniscus_core::math::Vec2;

/// A pore.
#[derive(Debug, Clone)]
pub(super) struct Pore {
    /// Its center in m.
    pub(super) center: Vec2,
    /// Its inscribed radius in m.
    pub(super) radius: f64,
    /// Whether it is labeled as at the left, right, bottom and top side.
    pub(super) at_side: [bool; 4],
    /// Whether it is labeled as an inlet, and as an outlet.
    pub(super) at_end: [bool; 2],
    /// Whether it is a boundary pore: the opening of the pore behind it, without a disc.
    pub(super) is_opening: bool,
    /// Where it is written.
    pub(super) location: String,
}

/// A throat.
#[derive(Debug, Clone)]
pub(super) struct Throat {
    /// Its pores.
    pub(super) pores: [usize; 2],
    /// Its width in m.
    pub(super) width: f64,
    /// Its middle in m, where the channel passes.
    pub(super) middle: Option<Vec2>,
    /// Its length in m from pore center to pore center, if given.
    pub(super) length: Option<f64>,
    /// Where it is written.
    pub(super) location: String,
}

/// Pores and throats.
#[derive(Debug, Clone, Default)]
pub(super) struct Network {
    pub(super) pores: Vec<Pore>,
    /// Those between two different pores. Numbers of throats in messages are those of the file.
    pub(super) throats: Vec<Throat>,
    /// The number of each throat in the file.
    pub(super) numbers: Vec<usize>,
    /// Number of throats from a pore to itself.
    pub(super) loops: usize,
}

impl Network {
    /// The centers of the pores of a throat.
    pub(super) fn ends(&self, throat: &Throat) -> [Vec2; 2] {
        throat.pores.map(|pore| self.pores[pore].center)
    }

    /// Whether a throat leads to a boundary pore: it is drawn as an opening.
    pub(super) fn is_opening(&self, throat: &Throat) -> bool {
        throat.pores.iter().any(|&pore| self.pores[pore].is_opening)
    }
}
