//! Fluids with known properties, and the tensions of their pairs.

mod aqueous;
mod fluids;
mod gases;
mod pairs;
mod properties;

pub use self::fluids::Preset;
pub(crate) use self::pairs::named;
pub use self::pairs::{PAIRS, Pair, between};
pub use self::properties::{Properties, State, Unknown};
