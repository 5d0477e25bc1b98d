//! Throats of a network by direct simulation: chosen throats, and pores where a meniscus touches a third wall or two menisci meet, are cut out,
//! run as an ordinary study of `[sph]` cases, and compared with the formula of the network.
//!
//! [`choose`] says which throats and [`events`] which touches and overlaps, [`subdomain`] and [`whole_pore`] make a box of each, [`case_text`] its
//! cases, [`plan`] writes them with their study, which [`crate::study`] runs; [`results`] and [`event_results`] read what came out, and [`report`]
//! writes the tables, the page, and what a network takes up.

pub mod case_text;
pub mod choose;
pub(crate) mod event_results;
pub mod events;
pub mod fluids;
mod page;
pub mod plan;
pub(crate) mod report;
pub(crate) mod results;
pub mod subdomain;
pub mod subject;
mod wall_path;
pub mod whole_pore;
