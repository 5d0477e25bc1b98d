//! Parameter studies: plans, runs, files, clusters.

#[path = "../support/mod.rs"]
mod support;

mod files;
mod runs;
mod samples;
mod slurm;
