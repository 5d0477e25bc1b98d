//! Verification of a network by direct simulation of subdomains: selected throats run as an ordinary study of `[sph]` cases and are compared
//! with the formula of the network.
//!
//! [`choose`] selects throats; [`subdomain`] constructs the box of each, [`case_text`] its cases; [`plan`] writes them with their study,
//! which [`crate::study`] runs; [`results`] evaluates the runs, and [`report`] writes the tables, the page, and the file of measured values
//! that a network can read.

pub mod case_text;
pub mod choose;
pub mod fluids;
mod page;
pub mod plan;
pub(crate) mod report;
pub(crate) mod results;
pub mod subdomain;
pub mod subject;
mod wall_path;
