//! Diagrams as data: what a solver knows of its own history, drawn by others.

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What stands along it, with its unit.
    pub label: &'static str,
    /// Whether equal steps are equal ratios; what is not above zero is left out then.
    pub logarithmic: bool,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// A line of its own color.
    Full,
    /// One of many that belong together: thin and gray.
    Thin,
    /// What is expected: dashed and black.
    Dashed,
    /// Dots of its own color.
    Dots,
}

/// Points in the order in which they are joined.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// How it is drawn.
    pub stroke: Stroke,
    /// x and y.
    pub points: Vec<[f64; 2]>,
}

/// A quantity over both axes, drawn in bands of colors.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The quantity with its unit.
    pub label: &'static str,
    /// Ascending places along x: the middles of columns.
    pub x: Vec<f64>,
    /// Ascending places along y: the middles of rows.
    pub y: Vec<f64>,
    /// Values, row by row.
    pub values: Vec<f64>,
}

/// A diagram.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// Its file is `diagram-NAME.svg`.
    pub name: &'static str,
    /// What it shows, in a line.
    pub title: &'static str,
    /// The axis along x.
    pub x: Axis,
    /// The axis along y.
    pub y: Axis,
    /// What lies below the lines, if anything.
    pub map: Option<Map>,
    /// The lines.
    pub traces: Vec<Trace>,
}
