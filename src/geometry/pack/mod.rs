//! Generators of grains: random packs, regular arrays and micromodels, from a seed and a few sizes.
//!
//! Numbers come from ChaCha8 and from sums, products, quotients and square roots only, so that a seed gives the same grains on every
//! machine. What is made is plain discs (and, around a micromodel, polygons): a file written from it needs no generator.

mod array;
mod cells;
mod error;
mod micromodel;
mod random;

use crate::geometry::spec::{Disc, ShapeSpec};

pub use array::array;
pub use error::PackError;
pub use micromodel::{Micromodel, micromodel};
pub use random::random_pack;

/// The smallest gap between any two discs in m, also across periodic sides; infinite where there are not two.
pub fn smallest_gap(discs: &[Disc], region: [[f64; 2]; 2], periodic: [bool; 2]) -> f64 {
    let largest = discs.iter().map(|disc| disc.radius).fold(0.0, f64::max);
    let size = [region[1][0] - region[0][0], region[1][1] - region[0][1]];
    let longest = size[0].max(size[1]);
    let mut reach = 2.2 * largest;
    loop {
        let mut cells = cells::Cells::new(region, periodic, reach);
        cells.fill(discs.iter().map(|disc| disc.center));
        let mut least = f64::INFINITY;
        for (i, disc) in discs.iter().enumerate() {
            cells.near(disc.center, |j| {
                if j > i {
                    let distance = cells.distance(disc.center, discs[j].center);
                    least = least.min(distance - disc.radius - discs[j].radius);
                }
            });
        }
        // A pair with a gap below this would be closer than the reach.
        if least <= reach - 2.0 * largest || reach > 2.0 * longest || !(reach > 0.0) {
            return least;
        }
        reach *= 2.0;
    }
}

impl ShapeSpec {
    /// The plain shapes that a generator stands for; any other shape as it is.
    ///
    /// # Errors
    /// Why a generator cannot make what is asked for.
    pub fn expanded(&self) -> Result<Vec<Self>, PackError> {
        let discs = match self {
            Self::RandomPack(pack) => random_pack(pack)?,
            Self::Array(spec) => array(spec)?,
            other => return Ok(vec![other.clone()]),
        };
        Ok(discs.into_iter().map(Self::Disc).collect())
    }
}
