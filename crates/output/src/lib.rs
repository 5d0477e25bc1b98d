//! Files: everything that a run writes, each file atomically, or row by row under a checksum.
//!
//! [`atomic`] writes whole files, [`journal`] append-only ones. [`vtk`] turns snapshots into VTK files, [`pvd`] collects them into time series, [`frames`]
//! lists them, [`series`] writes `series.csv`, [`restart`] the saved state; [`picture`] and [`diagram`] draw, [`html`] formats pages, [`network_page`] that
//! on which a displacement is played. Independent of solvers and cases.
#![warn(unreachable_pub)]

pub mod atomic;
pub(crate) mod axes;
pub(crate) mod cells;
pub mod checksum;
pub mod diagram;
pub mod frames;
pub mod html;
pub mod journal;
pub(crate) mod legend;
pub mod movie;
pub mod network_page;
pub mod picture;
pub mod pvd;
pub mod restart;
pub mod series;
pub(crate) mod shade;
pub mod table;
pub(crate) mod ticks;
pub mod vtk;

pub use atomic::FileError;
