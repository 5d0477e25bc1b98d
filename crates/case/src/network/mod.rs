//! `[network]`: displacement in a pore network.

mod displacement;
mod dynamic;
mod films;
pub mod measured;
mod pore_network;
mod region;
pub mod state;
mod table;

pub use displacement::Trapping;
pub use displacement::{NetworkDisplacement, Process, Stop};
pub use dynamic::{DEFAULT_LARGEST_STEP, Drive, DynamicDrive};
pub(super) use films::films;
pub(super) use pore_network::network;
pub use pore_network::{NetworkInterface, PoreNetwork};
pub use region::Region;
pub(super) use region::pack_between_manifolds;
pub use table::{Events, FilmModel, InletDisc, NetworkResults, RegionExtent};
pub use table::{RawNetwork, RawNetworkSide, RawNetworkSides, RawProcess, RawRegion};
