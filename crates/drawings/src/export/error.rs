//! Errors of exported drawings.

/// Why a drawing cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// Unknown file extension.
    #[error("`.{ending}` is not a supported output format; use .svg, .dxf, .wkt, .geojson, .xyr, .toml, .png or .vtu")]
    Ending {
        /// The extension.
        ending: String,
    },
    /// A list can hold discs only.
    #[error("{others} of {all} shapes are not discs, and a list contains discs only; write .toml, .svg or .dxf")]
    NoDisc {
        /// Number of other shapes.
        others: usize,
        /// Number of all shapes.
        all: usize,
    },
    /// The mask would be too large, or have no pixel.
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
