//! Case files: what the user wrote, checked, with every mistake named at its place.
//!
//! [`load`] goes from a path to a [`Loaded`] case: TOML -> [`raw`] types (all keys optional, so that one mistake does not
//! hide another) -> checks -> [`checked`] types, which hold every value in SI units and in range.

mod check;
pub mod checked;
mod facts;
pub mod film;
mod initial;
mod kind;
mod load;
mod magnitude;
pub mod measures;
pub mod network;
mod numerics;
mod open;
mod patches;
mod permeability;
pub mod preset;
pub mod raw;
mod relative_permeability;
mod resolve;
mod schema;
mod shapes;
mod sides;
mod sph;
mod start;
mod steady;
mod wetting;

pub use facts::{Facts, check_against};
pub use kind::is_case;
pub(crate) use kind::other_than_a_study;
pub(crate) use load::read;
pub use load::{Loaded, load, load_default, load_shapes, load_started};
pub use schema::{schema, starter_case};
