//! Files: everything that a run writes, each file whole or not at all, or row by row under a checksum.
//!
//! [`atomic`] is the way to a whole file, [`journal`] to one that grows. [`vtk`] turns snapshots into VTK files, [`pvd`] joins them to time series, [`frames`]
//! lists them, [`series`] keeps `series.csv`, [`restart`] the saved state, [`picture`] and [`diagram`]
//! draw. Nothing here knows a solver or a case.

pub mod atomic;
pub mod axes;
pub mod checksum;
pub mod diagram;
pub mod frames;
pub mod journal;
pub mod picture;
pub mod pvd;
pub mod restart;
pub mod series;
pub mod table;
pub mod vtk;

pub use atomic::FileError;
