//! A run: from a solver and a checked case to a folder of results.
//!
//! [`execute`](execute::execute) prepares the [`folder`], then the [`simulation`] loop steps the solver to the stops of the
//! [`schedule`] and hands [`sink`]s what is due, and the [`report`] says at the end what came out. [`setup`] is the one
//! place that knows both a case and a solver. Nothing here prints: a [`Watcher`](simulation::Watcher) is told of each step.

pub mod advice;
pub mod avalanche;
pub mod claim;
pub mod compare;
pub mod drift;
pub mod execute;
pub mod folder;
pub mod memory;
#[cfg(test)]
pub(crate) mod mock;
pub mod numbers;
pub mod processor_time;
pub mod report;
pub mod schedule;
pub mod setup;
pub mod simulation;
pub mod sink;
pub mod steady;
pub mod trial;
mod writer;
