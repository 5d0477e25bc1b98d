//! The command line: only this module prints. Results go to standard output, progress and errors to standard error.
//!
//! [`arguments`] defines the arguments, [`exit`] the exit codes, `source` loads cases and shapes; each command has its own file.

pub(crate) mod arguments;
mod check;
mod compare;
mod compare_networks;
mod couple;
mod entry;
pub(crate) mod exit;
mod geometry;
pub(crate) mod import_arguments;
mod interrupt;
mod list;
mod man;
mod movie;
mod network;
mod new;
mod new_pack;
mod opened_study;
mod output;
pub mod processor;
mod progress;
mod run;
mod source;
mod stages;
mod study;
mod study_arguments;
mod study_run;
mod study_samples;
mod summary;
mod threads;
mod verify;
pub(crate) mod verify_arguments;
mod write_shapes;

pub use entry::main;
