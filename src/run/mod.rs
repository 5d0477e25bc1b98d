//! A run: from a solver and a checked case to a folder of results.
//!
//! [`execute`](execute::execute) prepares the [`folder`], then the [`simulation`] loop steps the solver to the stops of the [`schedule`] and passes records
//! that are due to [`sink`]s; at the end the [`report`] gives the results. Only [`setup`] depends on both the case and the solvers. Nothing here prints: a
//! [`Watcher`](simulation::Watcher) is notified of each step.

pub(crate) mod advice;
pub(crate) mod avalanche;
pub mod checked;
pub(crate) mod claim;
pub(crate) mod compare;
pub(crate) mod description;
pub(crate) mod drift;
pub(crate) mod ensemble;
pub mod execute;
mod extension;
pub(crate) mod folder;
pub(crate) mod folder_error;
pub(crate) mod memory;
#[cfg(test)]
pub(crate) mod mock;
pub(crate) mod movie;
pub(crate) mod numbers;
pub(crate) mod pressure_curves;
pub(crate) mod processor_time;
mod records;
pub mod report;
pub(crate) mod schedule;
pub mod setup;
pub mod simulation;
pub(crate) mod sink;
pub(crate) mod slips;
pub mod source;
pub(crate) mod steady;
pub(crate) mod trial;
mod writer;
