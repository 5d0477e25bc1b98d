//! Two-phase flow with partial wetting in pores.
//!
//! A run goes one way: case -> checked case -> geometry -> solver -> snapshot -> sinks -> report.

pub mod diagram;
pub mod math;
pub mod snapshot;
pub mod solver;
pub mod table;

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
