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

/// The colors of all pictures, which color-blind eyes keep apart (Okabe and Ito 2008). `postprocess/colors.py` has the same.
pub(crate) mod colors {
    use crate::diagram::Color;

    /// The wetting phase; darker where it is trapped.
    pub(crate) const WETTING: Color = [86, 180, 233];
    pub(crate) const WETTING_TRAPPED: Color = [0, 114, 178];
    /// The non-wetting phase; darker where it is trapped.
    pub(crate) const NON_WETTING: Color = [230, 159, 0];
    pub(crate) const NON_WETTING_TRAPPED: Color = [166, 86, 0];
    /// Solids and their walls.
    pub(crate) const SOLID: Color = [190, 190, 190];
    pub(crate) const WALL: Color = [80, 80, 80];
    /// Menisci.
    pub(crate) const MENISCUS: Color = [0, 0, 0];
    /// A pore without a fluid.
    pub(crate) const PORE: Color = [255, 255, 255];
    /// Where the spacing does not resolve a phase; throats.
    pub(crate) const MARK: Color = [213, 60, 140];

    /// From first to last of what a phase has invaded, about its color.
    pub(crate) const WETTING_IN_ORDER: &[Color] =
        &[[220, 240, 252], [150, 210, 244], WETTING, [30, 140, 200], [0, 104, 165], [0, 66, 110]];
    pub(crate) const NON_WETTING_IN_ORDER: &[Color] =
        &[[255, 238, 196], [248, 204, 106], NON_WETTING, [198, 122, 0], [150, 82, 0], [98, 48, 0]];
    /// Sizes, the largest dark: viridis at quarters (van der Walt and Smith 2015).
    pub(crate) const SIZES: &[Color] = &[[253, 231, 37], [92, 200, 99], [33, 144, 141], [59, 81, 139], [68, 1, 84]];
}

/// Which way fluids pass an open side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Through {
    /// Into the domain.
    In,
    /// Out of it.
    Out,
}

/// The domain of a picture and what its sides are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Lower left and upper right corner in m.
    pub bounds: [[f64; 2]; 2],
    /// What passes the left, right, bottom and top side; none where a side is closed.
    pub open: [Option<Through>; 4],
    /// Whether the domain is joined along x and y.
    pub periodic: [bool; 2],
}

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
pub struct RegionMap {
    /// Its file is `picture-NAME.png`; that of the first one `picture.png`.
    pub name: &'static str,
    /// What stands below the title: where the run stands.
    pub note: String,
    /// The quantity of the color bar with its unit.
    pub label: &'static str,
    /// Both ends of the color bar.
    pub range: [f64; 2],
    /// The colors along it, from low to high.
    pub bar: &'static [Color],
    /// Names and colors of the classes.
    pub classes: Vec<(&'static str, Color)>,
    /// The drawing; what no area covers is solid.
    pub frame: Frame,
    /// The areas.
    pub areas: Vec<Area>,
    /// Thin dark lines: walls.
    pub walls: Vec<Vec<[f64; 2]>>,
    /// Lines with their name in the legend.
    pub menisci: (&'static str, Vec<Vec<[f64; 2]>>),
    /// Dashed lines with their name in the legend, below the others.
    pub throats: (&'static str, Vec<Vec<[f64; 2]>>),
    /// Lines of a width in m with their name in the legend, below the others: films.
    pub strips: (&'static str, Vec<Strip>),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_scripts_have_the_same_colors() {
        let script = include_str!("../postprocess/colors.py");
        for (name, [red, green, blue]) in [
            ("WETTING", colors::WETTING),
            ("WETTING_TRAPPED", colors::WETTING_TRAPPED),
            ("NON_WETTING", colors::NON_WETTING),
            ("NON_WETTING_TRAPPED", colors::NON_WETTING_TRAPPED),
            ("SOLID", colors::SOLID),
            ("WALL", colors::WALL),
            ("MENISCUS", colors::MENISCUS),
            ("PORE", colors::PORE),
            ("MARK", colors::MARK),
        ] {
            let line = format!("{name} = \"#{red:02x}{green:02x}{blue:02x}\"");
            assert!(script.lines().any(|found| found == line), "{line}");
        }
    }
}
