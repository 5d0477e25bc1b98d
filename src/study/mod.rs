//! Parameter studies: from a study file to many runs, a table, curves and a page.
//!
//! [`load`] reads a study file into a [`definition::Study`]; [`runs`] generates its [`run`]s and checks their cases; [`estimate`] estimates the cost of each;
//! [`execute`] does one of them, or a [`comparison`] of its case with a network, and [`engine`] all, each as a process; [`slurm`] submits them to a cluster,
//! and a Python program to its workers ([`numbered`], [`session`]). [`results`] reads their reports back, [`convergence`] and [`verdict`] evaluate them, and
//! [`report`] writes [`table`]s, [`curve`]s, [`map`]s and the [`page`]. Independent of solvers and models: a study consists of case files, folders and reports.

mod apart;
mod axis;
mod base_case;
pub(crate) mod child;
pub(crate) mod comparison;
pub(crate) mod convergence;
pub(crate) mod curve;
pub(crate) mod definition;
pub(crate) mod engine;
pub(crate) mod ensemble;
pub(crate) mod estimate;
pub mod execute;
pub(crate) mod folder;
pub mod load;
mod map;
mod measured;
#[cfg(test)]
mod mock;
mod names;
pub mod numbered;
pub(crate) mod page;
mod page_of_samples;
pub(crate) mod raw;
pub(crate) mod report;
pub(crate) mod resolution;
pub(crate) mod results;
pub(crate) mod run;
pub mod runs;
mod sampling;
pub mod session;
pub(crate) mod slurm;
pub(crate) mod table;
pub(crate) mod values;
pub(crate) mod verdict;
mod wording;

pub use engine::End;
pub use load::schema;
