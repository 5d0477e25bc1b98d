//! Errors of drawings for other programs.

/// Why a drawing cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// The name's ending is none of ours.
    #[error(
        "`.{ending}` names no format that can be written; use .svg, .dxf, .wkt, .geojson, .xyr, .toml, .png or .vtu"
    )]
    Ending {
        /// The ending.
        ending: String,
    },
    /// A list holds discs only.
    #[error("{others} of {all} shapes are no discs, and a list holds discs only; write .toml, .svg or .dxf")]
    NoDisc {
        /// Shapes that are none.
        others: usize,
        /// All shapes.
        all: usize,
    },
    /// The mask would be too large, or has no pixel.
    #[error(
        "a pixel of {pixel:e} m makes {width:.0} x {height:.0} pixels; a mask has 4 to 8192 a side: choose another --mask-pixel"
    )]
    Pixels {
        /// Side of a pixel in m.
        pixel: f64,
        /// Pixels along x.
        width: f64,
        /// Pixels along y.
        height: f64,
    },
    /// A library refused the data.
    #[error("{0}")]
    Library(String),
}
