//! Pore geometry: shapes, the signed distance to their surface and its normal, shape files and measures.
//!
//! A specified shape ([`spec`]) becomes closed bodies with surface curves (segments and arcs); `boundary` unites them; [`Geometry`] provides distance and
//! normal; [`measures`] and [`throats`] provide porosity, wall length and throats.

pub(crate) mod body;
pub(crate) mod boundary;
pub(crate) mod closest;
pub(crate) mod cosine;
pub(crate) mod critical;
pub mod curve;
pub(crate) mod curve_set;
pub(crate) mod elements;
mod etch;
pub mod export;
pub(crate) mod extent;
#[cfg(test)]
mod growth;
pub mod import;
pub(crate) mod intersect;
pub(crate) mod measures;
pub mod offset_curves;
pub(crate) mod outline;
pub mod pack;
pub(crate) mod rings;
pub(crate) mod shape_file;
pub(crate) mod solid;
pub mod spec;
pub(crate) mod surface;
pub mod throats;
pub(crate) mod tree;
pub(crate) mod validate;
pub(crate) mod weld;
pub(crate) mod winding;

pub use shape_file::{ShapeFileError, load};
pub use solid::{Geometry, GeometryError, Wall};
