//! Entry pressures measured by direct simulation: `measured.json` of `meniscus network verify`, and the same within a case.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::table::{RawMeasured, RawMeasuredThroat, RawNetwork};
use crate::input::Checker;

/// Measured entry pressures of throats.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Measured {
    /// Identifies the geometry, as in `network.json`.
    pub geometry_hash: String,
    /// The throats.
    pub throats: Vec<MeasuredThroat>,
}

/// A measured throat. Curvatures are those of the meniscus, above 0 if it bulges into the displaced phase.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct MeasuredThroat {
    /// Index among all throats of the network, including those that the merge removes.
    pub index: usize,
    /// Curvature by the formula in 1/m.
    pub formula_curvature: f64,
    /// Measured curvature in 1/m.
    pub entry_curvature: f64,
}

/// Replaces the file of measured values, if there is one, by the values.
pub(in crate::case) fn read(checker: &mut Checker, raw: &mut RawNetwork, folder: &Path) {
    let Some(file) = raw.measured.take() else { return };
    const PATH: &str = "network.measured";
    if raw.measured_throats.is_some() {
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
            Ok(measured) => raw.measured_throats = Some(table(&measured)),
        },
    }
}

/// The values as a table of a case.
pub(super) fn table(measured: &Measured) -> RawMeasured {
    let throat = |one: &MeasuredThroat| RawMeasuredThroat {
        index: Some(one.index),
        formula_curvature: Some(one.formula_curvature),
        entry_curvature: Some(one.entry_curvature),
    };
    RawMeasured {
        geometry_hash: Some(measured.geometry_hash.clone()),
        throats: Some(measured.throats.iter().map(throat).collect()),
    }
}

/// The values, `None` if one is missing.
pub(super) fn checked(raw: &RawMeasured) -> Option<Measured> {
    let throat = |raw: &RawMeasuredThroat| {
        Some(MeasuredThroat {
            index: raw.index?,
            formula_curvature: raw.formula_curvature?,
            entry_curvature: raw.entry_curvature?,
        })
    };
    let throats: Option<Vec<_>> = raw.throats.iter().flatten().map(throat).collect();
    Some(Measured { geometry_hash: raw.geometry_hash.clone()?, throats: throats? })
}
