//! Drawings of pores: reading and writing of formats, and shape files.
//!
//! [`load`] reads a shape file or a drawing of any format of [`import::Format`]; [`export`] writes shapes as drawings.
#![warn(unreachable_pub)]
#![cfg_attr(
    not(all(feature = "geojson", feature = "masks", feature = "svg", feature = "wkt")),
    allow(dead_code, reason = "the formats left out use it")
)]

pub mod export;
pub mod import;
mod shape_file;

pub use shape_file::{ShapeFileError, load};
