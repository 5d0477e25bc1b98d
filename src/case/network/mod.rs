//! `[network]`: displacement in a pore network.

mod displacement;
mod dynamic;
pub mod measured;
mod pore_network;
pub mod state;
mod table;

pub use displacement::{NetworkDisplacement, Process, Stop};
pub use dynamic::{DEFAULT_LARGEST_STEP, Drive, DynamicDrive};
pub use pore_network::{DEFAULT_PERSISTENCE, NetworkInterface, PoreNetwork};
pub(super) use pore_network::{network, raw};
pub use table::{Events, RawNetwork, RawNetworkSide, RawNetworkSides, RawProcess, RawStop};
