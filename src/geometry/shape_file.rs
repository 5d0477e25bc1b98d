//! Shape files of other programs: lists of discs, well-known text, GeoJSON, shapefiles, SVG, DXF, masks.
//!
//! Our own TOML shape files are read by the case module, which keeps source locations in TOML.

use std::path::{Path, PathBuf};

use crate::geometry::import::build::{Imported, Refused};
use crate::geometry::import::drawing::Refusal;
use crate::geometry::import::format::Format;
use crate::geometry::import::options::Options;
use crate::geometry::import::read::read;
use crate::geometry::import::reading::build;
use crate::input::file;
use crate::input::problem::Problem;

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
    /// Keys besides the file are missing or invalid.
    #[error("{}: {}", path.display(), join(problems))]
    Keys {
        /// Absolute path.
        path: PathBuf,
        /// The problems; their paths are keys, such as `unit`.
        problems: Vec<Problem>,
    },
    /// Parts of the file cannot be read: all of them.
    #[error("{}: {} mistake(s)\n{}", path.display(), refusals.len(), join(refusals))]
    Parts {
        /// Absolute path.
        path: PathBuf,
        /// The parts in order.
        refusals: Vec<Refusal>,
    },
    /// Every part can be read, but the shapes are invalid.
    #[error("{}: {} problem(s)\n{}", path.display(), problems.len(), join(problems))]
    Shapes {
        /// Absolute path.
        path: PathBuf,
        /// The problems, with the shapes numbered as in the file.
        problems: Vec<Problem>,
    },
}

fn join<T: ToString>(items: &[T]) -> String {
    items.iter().map(|item| format!("  {}", item.to_string())).collect::<Vec<_>>().join("\n")
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
    let problems = options.problems(format);
    if !problems.is_empty() {
        return Err(ShapeFileError::Keys { path, problems });
    }
    let bytes = match file::read(&path, file::LARGEST) {
        Ok(bytes) => bytes,
        Err(source) => return Err(ShapeFileError::Read { path, source }),
    };
    let drawing = match read(&bytes, &path, format, options) {
        Ok(drawing) => drawing,
        Err(refusals) => return Err(ShapeFileError::Parts { path, refusals }),
    };
    build(drawing, format, options).map_err(|refused| match refused {
        Refused::Keys(problems) => ShapeFileError::Keys { path, problems },
        Refused::Parts(refusals) => ShapeFileError::Parts { path, refusals },
        Refused::Shapes(problems) => ShapeFileError::Shapes { path, problems },
    })
}
