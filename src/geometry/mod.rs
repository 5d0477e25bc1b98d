//! Pore geometry: shapes, the signed distance to their surface and its normal, shape files and measures.

pub mod spec;
