//! `[network]`: quasi-static displacement in a pore network. Keys as written, their checks, the checked network, and the network
//! written out again.

mod check;
pub mod checked;
pub mod measured;
mod quick;
pub mod raw;
mod resolve;
pub mod state;

pub(super) use check::network;
pub use quick::quick;
pub(super) use resolve::raw as resolved;
