//! Shape files of other programs: lists of discs, tables of networks, well-known text, GeoJSON, shapefiles, SVG, DXF, masks.
//!
//! Our own TOML shape files are read by the case module, which keeps source locations in TOML.

use std::path::{Path, PathBuf};

use crate::import::build::{Imported, Refused};
use crate::import::format::Format;
use crate::import::network;
use crate::import::options::Options;
use crate::import::read::{format_of, read};
use crate::import::reading::build;
use meniscus_core::input::file;

/// Why a shape file was refused.
#[derive(Debug, thiserror::Error)]
pub enum ShapeFileError {
    /// The file cannot be opened or is not a file.
    #[error("cannot read the shape file {}: {source}", path.display())]
    Read {
        /// Absolute path.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file extension is unknown.
    #[error("the shape file {} has none of the endings {}", path.display(), Format::endings())]
    Ending {
        /// Absolute path.
        path: PathBuf,
    },
    /// A TOML file, which the case module should read.
    #[error("{} is a TOML shape file, which only the case reader reads", path.display())]
    Toml {
        /// Absolute path.
        path: PathBuf,
    },
    /// The file can be read, but not its shapes.
    #[error("{}: {refused}", path.display())]
    Refused {
        /// Absolute path.
        path: PathBuf,
        /// The reason.
        refused: Refused,
    },
}

/// Reads a shape file, by its extension; the result has no problems.
///
/// # Errors
/// See [`ShapeFileError`]; all invalid parts are reported at once.
pub fn load(path: &Path, options: &Options) -> Result<Imported, ShapeFileError> {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let format = match Format::of(&path) {
        Some(Format::Toml) => return Err(ShapeFileError::Toml { path }),
        Some(format) => format,
        None => return Err(ShapeFileError::Ending { path }),
    };
    let bytes = match file::read(&path, file::LARGEST) {
        Ok(bytes) => bytes,
        Err(source) => return Err(ShapeFileError::Read { path, source }),
    };
    let format = format_of(&bytes, format, options);
    let problems = options.problems(format);
    if !problems.is_empty() {
        return Err(ShapeFileError::Refused { path, refused: Refused::Keys(problems) });
    }
    let of_network = (format == Format::Network).then(|| network::options(options));
    let options = of_network.as_ref().unwrap_or(options);
    let drawing = read(&bytes, &path, format, options).map_err(Refused::Parts);
    let shapes = drawing.and_then(|drawing| build(drawing, format, options));
    shapes.map_err(|refused| ShapeFileError::Refused { path, refused })
}
