//! Parameter studies: from a study file to many runs, a table, curves and a page.
//!
//! [`load`] reads a study file into a [`definition::Study`]; [`runs`] makes its runs and checks their cases; [`estimate`] tells what
//! each will take; [`execute`] does one of them, or a [`comparison`] of its case with a network, and [`engine`] all, each in a process of its own, or [`slurm`] hands them to
//! a cluster; [`results`] reads their reports back, [`convergence`] and [`verdict`] judge them, and [`report`] writes [`table`]s, [`curve`]s and the
//! [`page`]. Nothing here knows a solver or a model: a study is a matter of case files, folders and reports.

mod axis;
mod base_case;
pub mod child;
pub mod comparison;
pub mod convergence;
pub mod curve;
pub mod definition;
pub mod engine;
pub mod estimate;
pub mod execute;
pub mod folder;
pub mod load;
mod measured;
#[cfg(test)]
mod mock;
mod names;
pub mod page;
pub mod raw;
pub mod report;
pub mod resolution;
pub mod results;
pub mod runs;
pub mod slurm;
pub mod table;
pub mod values;
pub mod verdict;

pub use load::schema;
