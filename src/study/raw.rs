//! The keys of a study file, as written: all optional, nothing checked but names and types.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::case::raw::tables;

tables! {
    /// A study file: one or more base cases, what varies, what must come out, what is shown.
    pub struct RawStudy {
        /// Version of the format: 1.
        pub format: u32,
        /// One line that says what the study shows.
        pub title: String,
        /// The base case, relative to the study file.
        pub case: PathBuf,
        /// Values that are the same in all runs and differ from the base case: `KEY=VALUE` as in `--set`.
        pub set: Vec<String>,
        /// What varies; every value of an axis meets every value of the others.
        pub axis: Vec<RawAxis>,
        /// Measures that must come out as said.
        pub expect: Vec<RawExpectation>,
        /// Errors that must fall with a parameter.
        pub trend: Vec<RawTrend>,
        /// What the report shows.
        pub report: RawReport,
    }

    /// What varies: one key with `values` or a `range`, several keys that vary together (`pair`), the rows of a CSV file
    /// (`table`), or several base cases (`cases`).
    pub struct RawAxis {
        /// Name of the parameter in tables, curves and expectations (default the last part of the key).
        pub name: String,
        /// Key path in the case file, as in `--set`.
        pub key: String,
        /// The values of the key.
        #[schemars(with = "Option<Vec<serde_json::Value>>")]
        pub values: Vec<toml::Value>,
        /// The values of the key, as a range.
        pub range: RawRange,
        /// Parameters that vary together, all with as many values.
        pub pair: Vec<RawColumn>,
        /// CSV file with a head line, relative to the study file; a run per row.
        pub table: PathBuf,
        /// Key path in the case file by column of the CSV file; other columns are parameters without a key.
        pub columns: BTreeMap<String, String>,
        /// Base cases, relative to the study file.
        pub cases: Vec<PathBuf>,
    }

    /// One of several parameters that vary together.
    pub struct RawColumn {
        /// Name of the parameter (default the last part of the key).
        pub name: String,
        /// Key path in the case file; a parameter without a key is a number to compare with.
        pub key: String,
        /// The values.
        #[schemars(with = "Option<Vec<serde_json::Value>>")]
        pub values: Vec<toml::Value>,
        /// The values, as a range.
        pub range: RawRange,
    }

    /// Numbers from one to another, both included.
    pub struct RawRange {
        /// The first number.
        pub from: f64,
        /// The last number.
        pub to: f64,
        /// How many, at least 2.
        pub count: usize,
        /// Equal steps (`linear`, the default) or equal ratios (`logarithmic`).
        pub scale: RawScale,
    }

    /// A measure that must come out as said.
    pub struct RawExpectation {
        /// Name of the measure.
        pub measure: String,
        /// Expected value: a number, or the name of a parameter.
        #[schemars(with = "Option<serde_json::Value>")]
        pub value: toml::Value,
        /// Largest accepted deviation: a number, or the name of a parameter.
        #[schemars(with = "Option<serde_json::Value>")]
        pub tolerance: toml::Value,
        /// Only for runs with these values of parameters (default all runs).
        #[serde(rename = "where")]
        #[schemars(with = "Option<BTreeMap<String, serde_json::Value>>")]
        pub only: BTreeMap<String, toml::Value>,
    }

    /// An error that must fall as a parameter falls.
    pub struct RawTrend {
        /// Name of the measure.
        pub measure: String,
        /// What the measure should be, a number or the name of a parameter: the error is the deviation from it (default 0).
        #[schemars(with = "Option<serde_json::Value>")]
        pub reference: toml::Value,
        /// The parameter, as a rule a spacing.
        pub along: String,
        /// Least observed order: the slope of log error over log parameter (default none).
        pub order: f64,
        /// Error that counts as converged: what other errors than that of the parameter leave (default 0).
        pub floor: f64,
        /// Only for runs with these values of parameters (default all runs).
        #[serde(rename = "where")]
        #[schemars(with = "Option<BTreeMap<String, serde_json::Value>>")]
        pub only: BTreeMap<String, toml::Value>,
    }

    /// What the report shows.
    pub struct RawReport {
        /// The measures in the table, and `steps`, `unknowns`, `wall-time-s`, `solver-time-s`, `cpu-s` (default all measures of the runs).
        pub measures: Vec<String>,
        /// The curves.
        pub curve: Vec<RawCurve>,
        /// Whether the page shows the picture of each run (default yes).
        pub pictures: bool,
    }

    /// A curve.
    pub struct RawCurve {
        /// Title (default the names of y and x).
        pub title: String,
        /// Parameter or measure along x.
        pub x: String,
        /// Measure along y.
        pub y: String,
        /// Parameter that makes a line of its own per value (default one line).
        pub series: String,
        /// What y should be, a number or the name of a parameter: drawn as a dashed line.
        #[schemars(with = "Option<serde_json::Value>")]
        pub reference: toml::Value,
        /// Whether the deviation of y from `reference` is drawn in place of y (default no).
        pub error: bool,
        /// Scale of x (default linear).
        pub x_scale: RawScale,
        /// Scale of y (default linear).
        pub y_scale: RawScale,
    }
}

/// Equal steps or equal ratios.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawScale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios.
    Logarithmic,
}
