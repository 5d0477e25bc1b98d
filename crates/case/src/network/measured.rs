//! Entry pressures measured by direct simulation: `measured.json` of `meniscus network verify`, and the same within a case.

use std::path::{Path, PathBuf};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use meniscus_core::input::Checker;
use meniscus_core::input::tables::Value;

/// Measured entry pressures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Measured {
    /// Hash of the geometry, as in `network.json`.
    pub geometry_hash: String,
    /// The measured throats.
    pub throats: Vec<MeasuredThroat>,
}

/// A throat whose entry pressure was measured. Curvatures are those of the meniscus, above 0 if it bulges into the displaced phase.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct MeasuredThroat {
    /// Index of the throat before the merge.
    pub index: usize,
    /// Entry curvature in 1/m that the formula gives; the measured value replaces no other.
    pub formula_curvature: f64,
    /// Measured entry curvature in 1/m.
    pub entry_curvature: f64,
}

impl Value for Measured {}

/// Replaces the file of measured values, if there is one, by the values.
pub(crate) fn read(checker: &mut Checker, named: &mut Option<PathBuf>, values: &mut Option<Measured>, folder: &Path) {
    let Some(file) = named.take() else { return };
    const PATH: &str = "network.measured";
    if values.is_some() {
        return checker.refuse(
            PATH,
            "measured values are given twice, by this file and by [network.measured-throats]",
            "keep one of both",
        );
    }
    let path = folder.join(&file);
    let help = "name the measured.json of `meniscus network verify`, relative to the case file";
    match std::fs::read(&path) {
        Err(error) => checker.refuse(PATH, format!("{} cannot be read: {error}", path.display()), help),
        Ok(bytes) => match serde_json::from_slice::<Measured>(&bytes) {
            Err(error) => {
                checker.refuse(PATH, format!("{} is not a list of measured throats: {error}", path.display()), help)
            }
            Ok(measured) => *values = Some(measured),
        },
    }
}
