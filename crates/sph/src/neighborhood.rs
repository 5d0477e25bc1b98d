//! Neighborhood of each particle: its neighbors, and the images of particles behind mirror sides.
//!
//! Recomputed whenever particles have moved.

use crate::cells::Cells;
use crate::domain::Domain;
use crate::images::Images;
use crate::kernel::WendlandC2;
use crate::pairs::Pairs;
use meniscus_core::math::Vec2;

/// Pairs and images at the present positions.
#[derive(Debug, Clone, Default)]
pub struct Neighborhood {
    /// Pairs within the support of the kernel.
    pub pairs: Pairs,
    /// Images of the particles behind mirror sides.
    pub images: Images,
}

impl Neighborhood {
    /// Recomputes pairs and images for particles at `position` (m).
    pub(crate) fn update(&mut self, position: &[Vec2], domain: &Domain, kernel: &WendlandC2) {
        let mut points = position.to_vec();
        self.images = Images::append(&mut points, domain, kernel.support());
        let cells = Cells::build(&points, domain, kernel.support());
        self.pairs.update(&cells, &points, position.len(), domain, kernel);
    }
}
