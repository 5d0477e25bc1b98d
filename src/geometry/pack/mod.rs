//! Generators of grains: random packs, regular arrays and micromodels, from a seed and a few sizes.
//!
//! Numbers come from ChaCha8 and from sums, products, quotients and square roots only, so that a seed gives the same grains on every
//! machine. What is made is plain discs (and, around a micromodel, polygons): a file written from it needs no generator.

mod array;
mod cells;
mod micromodel;
mod random;

use crate::geometry::spec::{Disc, ShapeSpec};

pub use array::array;
pub use micromodel::{Micromodel, micromodel};
pub use random::random_pack;

/// What cannot be made, with the reason and a way out.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {message} ({help})")]
pub struct PackError {
    /// The key that is wrong, such as `radius`.
    pub key: &'static str,
    /// What is wrong with it.
    pub message: String,
    /// A way out.
    pub help: String,
}

impl PackError {
    fn new(key: &'static str, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { key, message: message.into(), help: help.into() }
    }

    fn unless(is_good: bool, key: &'static str, message: impl Into<String>, help: &str) -> Result<(), Self> {
        if is_good { Ok(()) } else { Err(Self::new(key, message, help)) }
    }
}

/// Most discs of one generator: more would be a slip of a unit.
const MOST_DISCS: f64 = 2e6;

/// A rectangle as lower left and upper right corner in m, checked.
fn size_of(region: [[f64; 2]; 2]) -> Result<[f64; 2], PackError> {
    let size = [region[1][0] - region[0][0], region[1][1] - region[0][1]];
    let is_good = region.as_flattened().iter().all(|v| v.is_finite()) && size.iter().all(|&s| s > 0.0);
    PackError::unless(
        is_good,
        "region",
        format!("{region:?} is no rectangle"),
        "give [[xmin, ymin], [xmax, ymax]] in m",
    )?;
    Ok(size)
}

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
