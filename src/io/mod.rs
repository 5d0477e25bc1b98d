//! Files: everything that a run writes, each file whole or not at all, or row by row under a checksum.
//!
//! [`atomic`] is the way to a whole file, [`journal`] to one that grows. [`vtk`] turns snapshots into VTK files, [`pvd`] joins them to time series, [`frames`]
//! lists them, [`series`] keeps `series.csv`, [`restart`] the saved state, [`picture`] and [`diagram`]
//! draw, [`html`] frames pages. Nothing here knows a solver or a case.

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
