//! `[thin-film]`: droplets on a flat wall. Keys as written, their checks, the checked film, and the film written out again.

mod check;
pub mod checked;
pub mod raw;
mod resolve;

pub(super) use check::thin_film;
pub(super) use resolve::raw as resolved;
