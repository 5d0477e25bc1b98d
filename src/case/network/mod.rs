//! `[network]`: displacement in a pore network.

mod displacement;
mod dynamic;
mod films;
pub(crate) mod measured;
mod pore_network;
mod region;
pub mod state;
mod table;

pub use displacement::Trapping;
pub(crate) use displacement::{NetworkDisplacement, Process, Stop};
pub use dynamic::{DEFAULT_LARGEST_STEP, Drive, DynamicDrive};
pub(super) use films::refuse_films;
pub(crate) use pore_network::{NetworkInterface, PoreNetwork};
pub(super) use pore_network::{network, raw};
pub use region::Region;
pub use table::Events;
pub(crate) use table::{RawNetwork, RawNetworkSide, RawNetworkSides, RawProcess};
