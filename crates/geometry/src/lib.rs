//! Pore geometry: shapes, the signed distance to their surface and its normal, shape files and measures.
//!
//! A specified shape ([`spec`]) becomes closed bodies with surface curves (segments and arcs); `boundary` unites them; [`Geometry`] provides distance and
//! normal; [`measures`] and [`throats`] provide porosity, wall length and throats.
#![warn(unreachable_pub)]

pub mod analysis;
pub mod body;
pub mod boundary;
pub mod closest;
pub(crate) mod cosine;
pub mod critical;
pub mod curve;
pub(crate) mod curve_set;
pub mod elements;
mod etch;
pub(crate) mod extent;
#[cfg(test)]
mod growth;
pub mod interface;
pub mod intersect;
pub(crate) mod measures;
pub mod offset_curves;
pub(crate) mod outline;
pub mod pack;
pub mod rings;
pub mod solid;
pub mod spec;
pub(crate) mod surface;
pub mod throats;
pub mod tree;
pub mod validate;
pub mod weld;
pub(crate) mod winding;

pub use solid::{Geometry, GeometryError, Wall};
