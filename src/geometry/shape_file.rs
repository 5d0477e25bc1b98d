//! Shape files of other tools: disc lists (`.xyr`, `.txt`, `.csv`) and well-known text (`.wkt`).
//!
//! Our own TOML shape files are read by the case module, which knows places in TOML.

use std::path::{Path, PathBuf};

use crate::geometry::disc_list;
use crate::geometry::shape_lines::LineProblem;
use crate::geometry::spec::GeometrySpec;
use crate::geometry::well_known_text;
use crate::input::problem::Problem;

/// Why a shape file was refused.
#[derive(Debug, thiserror::Error)]
pub enum ShapeFileError {
    /// The file cannot be opened or is not text.
    #[error("cannot read the shape file {}: {source}", path.display())]
    Read {
        /// Absolute path.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The name's ending is not one of ours.
    #[error("the shape file {} ends in none of .xyr, .txt, .csv (discs), .wkt (polygons), .toml (shapes)", path.display())]
    Ending {
        /// Absolute path.
        path: PathBuf,
    },
    /// A TOML file came here by mistake: the case module reads those.
    #[error("{} is a TOML shape file, which the case reader has to read", path.display())]
    Toml {
        /// Absolute path.
        path: PathBuf,
    },
    /// Some lines cannot be read: all of them.
    #[error("{}: {} bad line(s)\n{}", path.display(), lines.len(), join(lines))]
    Lines {
        /// Absolute path.
        path: PathBuf,
        /// The lines in order.
        lines: Vec<LineProblem>,
    },
    /// Every line reads well, but the shapes make no sense.
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

/// Reads a shape file, chosen by its ending; shapes are solid, and the result has no problems.
///
/// # Errors
/// See [`ShapeFileError`]; all bad lines are named at once.
pub fn load(path: &Path) -> Result<GeometrySpec, ShapeFileError> {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    let parse = match ending.as_str() {
        "xyr" | "txt" | "csv" => disc_list::parse,
        "wkt" => well_known_text::parse,
        "toml" => return Err(ShapeFileError::Toml { path }),
        _ => return Err(ShapeFileError::Ending { path }),
    };
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(source) => return Err(ShapeFileError::Read { path, source }),
    };
    let spec = match parse(text.trim_start_matches('\u{feff}')) {
        Ok(spec) => spec,
        Err(lines) => return Err(ShapeFileError::Lines { path, lines }),
    };
    let problems = spec.problems();
    if problems.is_empty() { Ok(spec) } else { Err(ShapeFileError::Shapes { path, problems }) }
}
