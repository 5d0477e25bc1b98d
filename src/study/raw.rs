//! The keys of a study file, as written: all optional; only names and types are checked.

use std::collections::BTreeMap;
use std::path::PathBuf;

use meniscus_core::input::Range;
use meniscus_core::input::tables::{Key, Value, tables};

tables! {
    /// A study file: one or more base cases, what varies, what is expected, what is shown.
    pub(crate) struct RawStudy {
        /// Version of the format: 1 (required).
        pub format: u32 => Key::required("format = 1"),
        /// One line that describes the study (required).
        pub title: String => Key::required("title = \"what the study shows\""),
        /// Base case, relative to the study file (required without `cases`).
        pub case: PathBuf,
        /// Values for all runs, `"KEY=VALUE"` as in `--set`.
        pub set: Vec<String>,
        /// Each run compares its case, a direct simulation, with a network of the same geometry, as `meniscus compare` does.
        pub compare: RawComparison,
        /// What varies; every value of an axis is combined with every value of the others.
        pub axis: Vec<RawAxis>,
        /// How the axes with a distribution are sampled.
        pub sampling: RawSampling,
        /// Measures expected of every run.
        pub expect: Vec<RawExpectation>,
        /// Errors that must decrease with a parameter.
        pub trend: Vec<RawTrend>,
        /// Contents of the report.
        pub report: RawReport,
    }

    /// The network that the case is compared with.
    pub(crate) struct RawComparison {
        /// Case of the network, relative to the study file (required).
        pub network: PathBuf => Key::required("network = \"../cases/network/compare.toml\""),
        /// Number of compared states of the direct simulation, 1 to 10 000 (default 100).
        pub records: usize,
    }

    /// Samples of the axes that have a distribution.
    pub(crate) struct RawSampling {
        /// Number of samples, 2 to 10 000; a power of two makes the most of the sequence (required).
        pub count: usize => Key::required("count = 256"),
        /// Seed of the samples: the same ones on every machine (default 1).
        pub seed: u32,
        /// Estimates first-order and total Sobol indices, which needs (inputs + 2) `count` runs (default false).
        pub indices: bool,
        /// Correlations between inputs, by a Gaussian copula; inputs that are not named are independent.
        pub correlation: Vec<RawCorrelation>,
        /// Runs samples of networks as processes, too, each with an output folder (default false).
        pub processes: bool,
    }

    /// A correlation of two inputs.
    pub(crate) struct RawCorrelation {
        /// Names of the two parameters (required).
        pub axes: Vec<String> => Key::required("axes = [\"angle\", \"tension\"]"),
        /// Correlation of the underlying normal variables, above -1 and below 1 (required).
        pub value: f64 => Key::number("a correlation", Range::Between(-1.0, 1.0)).example("value = 0.5"),
    }

    /// Distribution of an uncertain value; exactly one of these.
    pub(crate) struct RawDistribution {
        /// A normal distribution, truncated if bounds are given.
        pub normal: RawNormal,
        /// A lognormal distribution: its logarithm is normal.
        pub lognormal: RawLognormal,
        /// A uniform distribution between two bounds.
        pub uniform: RawUniform,
        /// A density that rises linearly to its mode and falls linearly after it.
        pub triangular: RawTriangular,
    }

    /// A normal distribution.
    pub(crate) struct RawNormal {
        /// Mean, before truncation (required).
        pub mean: f64 => Key::required("mean = 40.0"),
        /// Standard deviation, before truncation (required).
        pub deviation: f64 => Key::positive("a standard deviation").example("deviation = 5.0"),
        /// Lower bound (default: none).
        pub at_least: f64,
        /// Upper bound (default: none).
        pub at_most: f64,
    }

    /// A lognormal distribution.
    pub(crate) struct RawLognormal {
        /// Median (required).
        pub median: f64 => Key::positive("a median").example("median = 1.0e-9"),
        /// Geometric standard deviation: the factor between the median and one standard deviation above it, above 1 (required).
        pub geometric_deviation: f64 => GEOMETRIC_DEVIATION,
    }

    /// A uniform distribution.
    pub(crate) struct RawUniform {
        /// Smallest value (required).
        pub from: f64 => Key::required("from = 0.07"),
        /// Largest value (required).
        pub to: f64 => Key::required("to = 0.08"),
    }

    /// A triangular distribution.
    pub(crate) struct RawTriangular {
        /// Smallest value (required).
        pub from: f64 => Key::required("from = 0.07"),
        /// Most likely value (required).
        pub mode: f64 => Key::required("mode = 0.072"),
        /// Largest value (required).
        pub to: f64 => Key::required("to = 0.08"),
    }

    /// What varies: one key with `values`, a `range` or a `distribution`, several keys that vary together (`pair`), the rows of a CSV file (`table`), or
    /// several base cases (`cases`).
    pub(crate) struct RawAxis {
        /// Name of the parameter: letters, digits, `-` and `_` (default: last part of the key).
        pub name: String,
        /// Key path in the case file, as in `--set`; with `values`, `range` or `distribution`.
        pub key: String,
        /// Further key paths that are set to the same values.
        pub also: Vec<String>,
        /// Values of the key.
        #[schemars(with = "Option<Vec<serde_json::Value>>")]
        pub values: Vec<toml::Value>,
        /// Values of the key as a range of numbers.
        pub range: RawRange,
        /// Distribution of an uncertain value of the key; `[sampling]` gives the number of samples.
        pub distribution: RawDistribution,
        /// Parameters that vary together, with the same number of values.
        pub pair: Vec<RawColumn>,
        /// CSV file with a header line: a run per row, a parameter per column; `#` begins a comment.
        pub table: PathBuf,
        /// Key path of each CSV column; other columns are numbers for comparison only.
        pub columns: BTreeMap<String, String>,
        /// Base cases instead of `case`; default parameter name `case`.
        pub cases: Vec<PathBuf>,
    }

    /// One of several parameters that vary together.
    pub(crate) struct RawColumn {
        /// Name of the parameter (default: last part of the key).
        pub name: String,
        /// Key path in the case file; a parameter without a key is a number for comparison only.
        pub key: String,
        /// Further key paths that are set to the same values.
        pub also: Vec<String>,
        /// Values of the key.
        #[schemars(with = "Option<Vec<serde_json::Value>>")]
        pub values: Vec<toml::Value>,
        /// Values of the key as a range of numbers.
        pub range: RawRange,
    }

    /// Numbers from the first to the last, both included.
    pub(crate) struct RawRange {
        /// First number (required).
        pub from: f64 => Key::required("from = 1.0"),
        /// Last number, included (required).
        pub to: f64 => Key::required("to = 2.0"),
        /// Number of values, at least 2 (required).
        pub count: usize => Key::required("count = 3"),
        /// Linear or logarithmic steps (default `linear`).
        pub scale: RawScale,
    }

    /// An expected measure.
    pub(crate) struct RawExpectation {
        /// Name of a measure (required).
        pub measure: String => Key::required("measure = \"contact-angle-deg\""),
        /// Expected value: number or name of a parameter (required).
        #[schemars(with = "Option<serde_json::Value>")]
        pub value: toml::Value => Key::required("value = 1.0, or the name of a parameter"),
        /// Largest accepted deviation: number above 0 or name of a parameter (required).
        #[schemars(with = "Option<serde_json::Value>")]
        pub tolerance: toml::Value => Key::required("tolerance = 0.02"),
        /// Parameter values of the runs that count, as in `{ spacing = 2.5e-5 }` (default: all runs).
        #[serde(rename = "where")]
        #[schemars(with = "Option<BTreeMap<String, serde_json::Value>>")]
        pub only: BTreeMap<String, toml::Value>,
    }

    /// An error that must decrease with a parameter.
    pub(crate) struct RawTrend {
        /// Name of a measure (required).
        pub measure: String => Key::required("measure = \"contact-angle-deg\""),
        /// Ideal value, number or name of a parameter (default 0).
        #[schemars(with = "Option<serde_json::Value>")]
        pub reference: toml::Value,
        /// Parameter with which the error must decrease, usually a spacing (required).
        pub along: String => Key::required("along = \"spacing\""),
        /// Smallest accepted order: least-squares slope of log error over log parameter.
        pub order: f64,
        /// Error that counts as converged, due to other causes: errors below it need not decrease and do not count for the order (default 0).
        pub floor: f64 => Key::positive("an error, in the unit of the measure,"),
        /// Parameter values of the runs that count (default: all runs).
        #[serde(rename = "where")]
        #[schemars(with = "Option<BTreeMap<String, serde_json::Value>>")]
        pub only: BTreeMap<String, toml::Value>,
    }

    /// What the report shows.
    pub(crate) struct RawReport {
        /// Measures in the table; also `steps`, `unknowns`, `wall-time-s`, `solver-time-s`, `cpu-s` (default: all
        /// measures).
        pub measures: Vec<String>,
        /// The curves.
        pub curve: Vec<RawCurve>,
        /// The maps; without one, a study of two axes with at least three numbers each, none of them a spacing, has maps of its curves, or of the first of
        /// `measures`.
        pub map: Vec<RawMap>,
        /// Shows picture and diagrams of each run (default true).
        pub pictures: bool,
    }

    /// A curve.
    pub(crate) struct RawCurve {
        /// Title (default: words of y and x).
        pub title: String,
        /// Parameter or measure along x (required).
        pub x: String => Key::required("x = \"spacing\""),
        /// Measure along y (required).
        pub y: String => Key::required("y = \"contact-angle-deg\""),
        /// Parameter with one line per value (default: one line).
        pub series: String,
        /// Ideal y, number or name of a parameter: a dashed line.
        #[schemars(with = "Option<serde_json::Value>")]
        pub reference: toml::Value,
        /// Draws the deviation of y from `reference` (default false).
        pub error: bool,
        /// Scale of x (default `linear`).
        pub x_scale: RawScale,
        /// Scale of y (default `linear`).
        pub y_scale: RawScale,
    }

    /// A measure over two parameters: a map for each combination of the others, of samples their mean.
    pub(crate) struct RawMap {
        /// Title (default: words of the measure and of x and y).
        pub title: String,
        /// Parameter along x (required).
        pub x: String => Key::required("x = \"rate\""),
        /// Parameter along y (required).
        pub y: String => Key::required("y = \"angle\""),
        /// Measure (required).
        pub measure: String => Key::required("measure = \"trapped-saturation\""),
        /// Scale of x (default `linear`).
        pub x_scale: RawScale,
        /// Scale of y (default `linear`).
        pub y_scale: RawScale,
        /// Scale of the colors (default `linear`).
        pub scale: RawScale,
    }
}

/// The geometric standard deviation of a lognormal distribution.
const GEOMETRIC_DEVIATION: Key =
    Key::number("a geometric standard deviation", Range::Above(1.0)).example("geometric-deviation = 1.5");

/// Linear or logarithmic steps.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawScale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal ratios.
    Logarithmic,
}

impl Value for RawScale {}
