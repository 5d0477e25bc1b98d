//! Why a movie cannot be made.

/// A movie that cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum MovieError {
    /// No frames.
    #[error("there is no frame")]
    Empty,
    /// A frame of another size.
    #[error("a frame of {found:?} pixels follows one of {expected:?}")]
    Size {
        /// Width and height of the first frames.
        expected: [u32; 2],
        /// Those of the frame.
        found: [u32; 2],
    },
    /// The encoder failed.
    #[error("the movie cannot be encoded: {0}")]
    Encode(String),
}
