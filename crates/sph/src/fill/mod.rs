//! Fills the pore and a layer of its walls with particles: on a lattice, and along walls and interfaces that are not aligned with it.

mod interface;
mod kept;
mod lattice;
mod positions;
mod region;
mod walls;

pub(crate) use interface::Interface;
pub use lattice::{Lattice, on_lattice};
pub use positions::Positions;
pub(crate) use region::Region;
pub(crate) use walls::along_walls;

use crate::domain::Domain;

/// The domain must be this many supports long along a periodic direction, or a pair would be counted twice.
pub(crate) const PERIODIC_SUPPORTS: f64 = 3.0;

/// Whether the periodic directions of `domain` are long enough for `support` (m).
pub(crate) fn fits(domain: &Domain, support: f64) -> bool {
    domain.periods().iter().flatten().all(|period| *period >= PERIODIC_SUPPORTS * support)
}
