//! Files: everything that a run writes, each file atomically, or row by row under a checksum.
//!
//! [`atomic`] writes whole files, [`journal`] append-only ones. [`vtk`] turns snapshots into VTK files, [`pvd`] collects them into time series, [`frames`]
//! lists them, [`series`] writes `series.csv`, [`restart`] the saved state; [`picture`] and [`diagram`] draw, [`html`] formats pages. Independent of solvers
//! and cases.

pub(crate) mod atomic;
pub(crate) mod axes;
pub(crate) mod checksum;
pub mod diagram;
pub(crate) mod frames;
pub(crate) mod html;
pub(crate) mod journal;
pub(crate) mod picture;
pub(crate) mod pvd;
pub mod restart;
pub(crate) mod series;
pub mod table;
pub(crate) mod vtk;

pub(crate) use atomic::FileError;
