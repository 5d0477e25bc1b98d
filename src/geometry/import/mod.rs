//! Drawings of other programs: each reader turns a file into a [`Drawing`](drawing::Drawing) in the file's own unit; what follows is
//! the same for all.

pub mod affine;
pub mod biarc;
pub mod contour;
pub mod drawing;
pub mod dxf;
pub mod limits;
pub mod spline;
pub mod svg;
