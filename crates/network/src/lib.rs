//! Pore networks: extraction from the exact geometry, displacement with the menisci of `interface`, conductance and permeability.
#![warn(unreachable_pub)]

mod angles;
mod channel;
pub mod conductance;
pub mod cycles;
pub mod displacement;
pub mod dynamic;
pub mod ensemble;
pub mod extract;
pub mod graph;
pub mod gravity;
mod ground;
pub(crate) mod laplacian;
pub mod permeability;
pub mod setup;
pub mod solver;

mod film_curve;
mod film_flow;
mod film_sums;
mod films;
mod flow;
mod half_cycle;
mod layers;
mod locate;
pub mod measures;
mod merge;
mod model;
pub(crate) mod moment;
mod occupation;
mod openpnm;
mod pictures;
mod playback;
mod region;
mod setup_error;
pub mod state;
mod summary;
mod tables;
mod warnings;

pub use extract::{ExtractError, extract};
