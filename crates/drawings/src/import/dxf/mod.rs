//! DXF drawings: closed outlines of model space as circles and rings of segments and arcs, blocks expanded.
//!
//! Source: Autodesk, DXF Reference (group codes; object coordinate systems by the arbitrary axis algorithm). Text and binary files of all releases. Each
//! closed ring is a separate area: DXF outlines have no fill, and nesting is resolved later. Ignored, but counted: HATCH, text, dimensions, points, solids in
//! space, paper space, and lines that do not close.
//!
//! The groups are read here and not by the crate `dxf`, which silently ends a section at the first value that it cannot read, drops HATCH and MPOLYGON, and
//! does not limit nesting.

mod block;
mod chain;
mod entity;
mod gaps;
mod group;
mod header;
mod wide;

use super::drawing::{Drawing, Refusal};

/// Reads a drawing. With `layers`, only entities on these; ends of lines within `join_within` in units of the drawing are joined.
pub(crate) fn read(bytes: &[u8], layers: Option<&[String]>, join_within: Option<f64>) -> Result<Drawing, Vec<Refusal>> {
    let groups = group::groups(bytes).map_err(|refusal| vec![refusal])?;
    let file = header::File::of(&groups).map_err(|refusal| vec![refusal])?;
    block::drawing(&file, bytes.len(), layers, join_within.unwrap_or(0.0))
}

#[cfg(test)]
mod tests;
