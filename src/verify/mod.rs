//! Throats of a network by direct simulation: chosen throats are cut out, run as an ordinary study of `[sph]` cases, and compared with the
//! formula of the network.
//!
//! [`choose`] says which throats, [`cut_out`] makes a box of each, [`case_text`] its cases, [`plan`] writes them with their study, which
//! [`crate::study`] runs; [`results`] reads what came out, and [`report`] writes the table, the page, and what a network takes up.

pub mod case_text;
pub mod choose;
pub mod cut_out;
mod page;
pub mod plan;
pub mod report;
pub mod results;
pub mod subject;
mod wall_path;
