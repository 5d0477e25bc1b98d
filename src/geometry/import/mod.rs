//! Drawings of other programs.
//!
//! Each reader turns a file into a [`Drawing`](drawing::Drawing) in the file's own unit; what follows is the same for all: unit
//! ([`units`]), fills and holes, circles and arcs behind polygons, domain (`build`), what a [`window`] leaves out, and [`cut`]s at its sides.

pub mod affine;
pub mod biarc;
pub(crate) mod build;
pub mod closing;
pub(crate) mod combine;
pub mod contour;
pub mod cut;
pub mod drawing;
pub mod dxf;
pub(crate) mod esri;
pub(crate) mod fill;
pub mod format;
pub(crate) mod frame;
pub(crate) mod geojson;
pub(crate) mod header;
pub mod limits;
pub(crate) mod list;
pub mod mask;
pub(crate) mod nest;
pub(crate) mod nodes;
pub(crate) mod notes;
pub mod options;
pub(crate) mod overlap;
pub(crate) mod paint;
pub(crate) mod read;
pub(crate) mod recognize;
pub(crate) mod rings;
pub(crate) mod smooth;
pub mod spline;
pub mod svg;
pub(crate) mod text;
pub mod units;
pub mod window;
pub(crate) mod wkt;

pub use build::Imported;
pub use cut::{Beyond, cut_at_sides};
pub use format::Format;
pub use options::Options;
pub use window::windowed;
