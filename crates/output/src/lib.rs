//! Files: everything that a run writes, each file atomically, or row by row under a checksum.
//!
//! [`atomic`] writes whole files, [`journal`] append-only ones. [`vtk`] turns snapshots into VTK files, [`pvd`] collects them into time series, [`frames`]
//! lists them, [`series`] writes `series.csv`, [`restart`] the saved state; [`picture`] and [`diagram`] draw, [`html`] formats pages. Independent of solvers
//! and cases.
#![warn(unreachable_pub)]

pub mod atomic;
pub(crate) mod axes;
pub mod checksum;
pub mod diagram;
pub mod frames;
pub mod html;
pub mod journal;
pub mod movie;
pub mod picture;
pub mod pvd;
pub mod restart;
pub mod series;
pub mod table;
pub mod vtk;

pub use atomic::FileError;
