//! A checked study: what varies, what is expected, what is shown.

use std::path::PathBuf;

use toml::Value;

use super::raw::RawScale;
use meniscus_core::input::{InputError, Problem};

/// A study that can be planned.
#[derive(Debug, Clone)]
pub struct Study {
    /// Name: that of its file without the ending.
    pub name: String,
    /// One line that describes the study.
    pub title: String,
    /// The base case; `None` if an axis gives the cases.
    pub case: Option<PathBuf>,
    /// The comparison of each run with a network, if any.
    pub compare: Option<ComparisonPlan>,
    /// Values common to all runs.
    pub set: Vec<Assignment>,
    /// What varies; the first one varies slowest.
    pub axes: Vec<Axis>,
    /// Sampling of uncertain values; `None` if there are none.
    pub sampling: Option<Sampling>,
    /// Expected measures.
    pub expectations: Vec<Expectation>,
    /// Errors that must decrease.
    pub trends: Vec<Trend>,
    /// What the report shows.
    pub report: ReportPlan,
    pub(super) document: meniscus_core::input::Document,
}

/// The network that the cases of all runs are compared with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ComparisonPlan {
    /// The case of the network.
    pub network: PathBuf,
    /// Number of compared states of the direct simulation.
    pub records: usize,
}

/// A value for a key of the case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assignment {
    /// `KEY=VALUE`, as in `--set`.
    pub text: String,
    /// Its source: a key path in the study file.
    pub origin: String,
}

/// Sampling of uncertain values. One axis has the samples: a row for each of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sampling {
    /// Number of samples; with Sobol indices each has further runs.
    pub count: usize,
    /// Whether the rows are those of Sobol indices: for each sample a row of A, one of B, and one of A with the column of B for each input.
    pub indices: bool,
    /// Whether samples of networks run as processes, too.
    pub processes: bool,
    /// The uncertain values.
    pub inputs: Vec<Input>,
}

impl Sampling {
    /// Number of rows of a sample.
    pub(crate) fn rows(&self) -> usize {
        if self.indices { self.inputs.len() + 2 } else { 1 }
    }

    /// Number of initial rows of a sample that are independent draws of all inputs.
    pub(crate) fn draws(&self) -> usize {
        if self.indices { 2 } else { 1 }
    }

    /// Whether a parameter belongs to the axis of samples.
    pub(crate) fn has(&self, name: &str) -> bool {
        name == SAMPLE || (self.indices && name == MATRIX) || self.inputs.iter().any(|input| input.name == name)
    }
}

/// The parameters of the axis of samples besides the inputs: the index of its row, and for Sobol indices the role of the row.
pub(crate) const SAMPLE: &str = "sample";
pub(crate) const MATRIX: &str = "matrix";

/// An uncertain value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Input {
    /// Name of its parameter.
    pub name: String,
    /// Keys of the case that are set to it.
    pub keys: Vec<String>,
}

/// Parameters that vary together.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The parameters, at least one, all with the same number of values.
    pub columns: Vec<Column>,
}

impl Axis {
    /// Number of values.
    pub(crate) fn len(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }
}

/// What a parameter changes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Target {
    /// Keys of the case, at least one, that are set to the same value.
    Keys(Vec<String>),
    /// The base case: the files, one per value.
    Case(Vec<PathBuf>),
    /// Nothing: a number for comparison only.
    Nothing,
}

/// A parameter with its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name.
    pub name: String,
    /// What it changes.
    pub target: Target,
    /// The values.
    pub values: Vec<Value>,
    /// The source of each value: a key path in the study file.
    pub origins: Vec<String>,
}

/// A number, or the parameter with its value.
#[derive(Debug, Clone, PartialEq)]
pub enum Quantity {
    /// A number.
    Number(f64),
    /// The name of a parameter.
    Parameter(String),
}

/// Parameter values that select runs; empty: all.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Choice(pub Vec<(String, Value)>);

/// An expected measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Expectation {
    /// Name of the measure.
    pub measure: String,
    /// Expected value in the measure's unit.
    pub value: Quantity,
    /// Largest accepted deviation, same unit.
    pub tolerance: Quantity,
    /// Selection of runs.
    pub only: Choice,
}

/// An error that must decrease with a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Trend {
    /// Name of the measure.
    pub measure: String,
    /// Reference value of the measure.
    pub reference: Quantity,
    /// The parameter.
    pub along: String,
    /// Smallest accepted observed order.
    pub order: Option<f64>,
    /// Error that counts as converged, in the measure's unit; 0 if not given.
    pub floor: f64,
    /// Selection of runs.
    pub only: Choice,
}

/// What the report shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ReportPlan {
    /// The measures in the table; `None` for all.
    pub measures: Option<Vec<String>>,
    /// The curves.
    pub curves: Vec<Curve>,
    /// The maps.
    pub maps: Vec<MapPlan>,
    /// Whether the page shows the picture of each run.
    pub pictures: bool,
}

/// A curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Title; the words of y and x if `None`.
    pub title: Option<String>,
    /// Parameter or measure along x.
    pub x: String,
    /// Measure along y.
    pub y: String,
    /// Parameter with one line per value.
    pub series: Option<String>,
    /// Reference value of y.
    pub reference: Option<Quantity>,
    /// Whether the deviation from the reference is drawn instead of y.
    pub error: bool,
    /// Scale of x.
    pub x_scale: RawScale,
    /// Scale of y.
    pub y_scale: RawScale,
}

/// A measure over two parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPlan {
    /// Title; the words of the measure and of x and y if `None`.
    pub title: Option<String>,
    /// Parameter along x.
    pub x: String,
    /// Parameter along y.
    pub y: String,
    /// The measure.
    pub measure: String,
    /// Scale of x.
    pub x_scale: RawScale,
    /// Scale of y.
    pub y_scale: RawScale,
    /// Scale of the colors.
    pub scale: RawScale,
}

impl Study {
    /// All parameters in the order of the axes.
    pub(crate) fn parameters(&self) -> impl Iterator<Item = &Column> {
        self.axes.iter().flat_map(|axis| &axis.columns)
    }

    /// Locates problems in the study file.
    ///
    /// # Errors
    /// [`InputError`] if there are problems.
    pub(crate) fn refuse(&self, problems: Vec<Problem>) -> Result<(), InputError> {
        self.document.refuse(problems)
    }
}
