//! Two-phase flow with partial wetting in pores.
//!
//! A run goes one way: case -> checked case -> geometry -> solver -> snapshot -> sinks -> report.
//!
//! What is `pub` is chosen; the rest is `pub(crate)`, so that the compiler sees what nobody uses.
#![warn(unreachable_pub)]
#![allow(rustdoc::private_intra_doc_links, reason = "comments are for readers of the source too")]

pub(crate) mod diagram;
pub mod math;
pub mod snapshot;
pub mod solver;
pub(crate) mod table;

pub mod input;

pub mod geometry;

pub mod interface;

pub mod analysis;

pub mod wetting;

pub mod case;

pub mod network;
pub mod sph;
pub mod thin_film;

pub mod benchmarks;

pub mod io;

pub mod run;

pub mod study;

pub mod verify;

pub mod cli;
