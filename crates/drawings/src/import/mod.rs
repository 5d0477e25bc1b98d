//! Import of drawings of other programs.
//!
//! Each reader converts a file to a [`Drawing`](drawing::Drawing) in the file's own unit; the rest is common to all: unit ([`options`]), fills and holes,
//! circles and arcs behind polygons, domain (`build`), clipping to a [`window`], and [`cut`]s at its sides.

pub(crate) mod affine;
pub(crate) mod biarc;
pub(crate) mod build;
pub(crate) mod closing;
pub(crate) mod combine;
pub(crate) mod contour;
pub(crate) mod cut;
pub mod drawing;
pub(crate) mod dxf;
pub(crate) mod esri;
pub(crate) mod fill;
pub(crate) mod format;
pub(crate) mod frame;
#[cfg(feature = "geojson")]
pub(crate) mod geojson;
pub(crate) mod header;
pub(crate) mod limits;
pub(crate) mod list;
#[cfg(feature = "masks")]
pub mod mask;
pub(crate) mod nest;
pub(crate) mod network;
pub(crate) mod nodes;
pub(crate) mod notes;
pub mod options;
pub(crate) mod overlap;
pub(crate) mod paint;
pub(crate) mod read;
pub(crate) mod reading;
pub(crate) mod recognize;
pub(crate) mod rings;
pub(crate) mod smooth;
pub(crate) mod spline;
#[cfg(feature = "svg")]
pub(crate) mod svg;
pub(crate) mod text;
pub(crate) mod units;
pub(crate) mod window;
#[cfg(feature = "wkt")]
pub(crate) mod wkt;

pub use build::windowed;
pub use build::{Imported, Refused};
pub use cut::{Beyond, cut_at_sides};
pub use format::Format;
pub use options::{Frame, Nested, Options};
