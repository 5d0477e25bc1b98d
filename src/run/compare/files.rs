//! The files of a comparison: the page, all numbers, the curves.

use std::path::Path;

use super::comparison::Comparison;
use super::page;
use meniscus_output::{FileError, atomic, diagram};

/// The page.
pub(crate) const PAGE: &str = "compare.html";
/// Pressure over saturation of both, one of the diagrams.
pub(crate) const CURVES: &str = "compare.svg";
/// All numbers.
const NUMBERS: &str = "compare.json";

/// Writes them; the page comes last.
pub(crate) fn write(found: &Comparison, folder: &Path) -> Result<(), FileError> {
    let numbers = folder.join(NUMBERS);
    let text = serde_json::to_string_pretty(found)
        .map_err(|error| FileError::Format { path: numbers.clone(), what: error.to_string() })?;
    atomic::write(&numbers, (text + "\n").as_bytes())?;
    for drawn in page::diagrams(found) {
        if let Ok(Some(svg)) = diagram::svg(&drawn) {
            atomic::write(&folder.join(format!("{}.svg", drawn.name)), svg.as_bytes())?;
        }
    }
    atomic::write(&folder.join(PAGE), page::page(found).as_bytes())
}
