//! What every part of meniscus is built on: plain vectors, diagrams, tables and snapshots; the trait of solvers; and input files with the place of every
//! mistake.
//!
//! SI units; angles in rad, in degrees where a name says so.
#![warn(unreachable_pub)]

pub mod diagram;
pub mod input;
pub mod label;
pub mod math;
pub mod playback;
pub mod snapshot;
pub mod solver;
pub mod table;
