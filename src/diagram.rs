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
    /// The area within a closed line, in a light tone of the color of the next line.
    Band,
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

/// A color as red, green, blue.
pub(crate) type Color = [u8; 3];

/// How an area is colored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tone {
    /// By a number, along the color bar.
    Value(f64),
    /// By the class of this index.
    Class(usize),
}

/// An area of the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    /// Its closed boundary in m, the first vertex not repeated.
    pub boundary: Vec<[f64; 2]>,
    /// Its color.
    pub tone: Tone,
}

/// A line and its width, both in m.
pub(crate) type Strip = (Vec<[f64; 2]>, f64);

/// A map of the plane: areas colored by a number, with lines over them.
#[derive(Debug, Clone, PartialEq)]
pub struct Mosaic {
    /// Its file is `picture-NAME.png`; that of the first one `picture.png`.
    pub name: &'static str,
    /// What stands below the title: where the run stands.
    pub note: String,
    /// The quantity of the color bar with its unit.
    pub label: &'static str,
    /// Both ends of the color bar.
    pub range: [f64; 2],
    /// Names and colors of the classes.
    pub classes: Vec<(&'static str, Color)>,
    /// Lower left and upper right corner of the drawing in m; what no area covers is solid.
    pub bounds: [[f64; 2]; 2],
    /// The areas.
    pub areas: Vec<Area>,
    /// Thin dark lines: walls.
    pub walls: Vec<Vec<[f64; 2]>>,
    /// Colored lines with their name in the legend: menisci, throats.
    pub lines: (&'static str, Vec<Vec<[f64; 2]>>),
    /// Lines of a width in m with their name in the legend, below the others: films.
    pub strips: (&'static str, Vec<Strip>),
}
