//! Drawings of other programs: each reader turns a file into a [`Drawing`](drawing::Drawing) in the file's own unit; what follows is the same for all.

pub mod drawing;
pub mod mask;
