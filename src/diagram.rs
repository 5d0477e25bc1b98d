//! Diagrams as data: what a solver records of its history, drawn elsewhere.

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Axis label with unit.
    pub label: &'static str,
    /// Whether the scale is logarithmic; values that are not above zero are then left out.
    pub logarithmic: bool,
}

/// Line style.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// A line of its own color.
    Full,
    /// One of a family of lines: thin and gray.
    Thin,
    /// Expected or theoretical: dashed and black.
    Dashed,
    /// Dots of its own color.
    Dots,
    /// The area inside a closed line, in a light tone of the color of the next line.
    Band,
}

/// A sequence of points, joined in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Name in the legend; empty if it has none.
    pub name: String,
    /// How it is drawn.
    pub stroke: Stroke,
    /// x and y.
    pub points: Vec<[f64; 2]>,
}

/// A quantity as a function of both axes, drawn as filled contours.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The quantity and its unit.
    pub label: &'static str,
    /// Ascending positions along x: centers of the columns.
    pub x: Vec<f64>,
    /// Ascending positions along y: centers of the rows.
    pub y: Vec<f64>,
    /// Values, row by row.
    pub values: Vec<f64>,
}

/// A diagram.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// The file is `diagram-NAME.svg`.
    pub name: &'static str,
    /// Title, in one line.
    pub title: &'static str,
    /// The axis along x.
    pub x: Axis,
    /// The axis along y.
    pub y: Axis,
    /// The filled map below the lines, if any.
    pub map: Option<Map>,
    /// The lines.
    pub traces: Vec<Trace>,
}

/// A color as red, green, blue.
pub(crate) type Color = [u8; 3];

/// The colors of all pictures, distinguishable for color-blind readers (Okabe and Ito 2008). `postprocess/colors.py` has the same.
pub(crate) mod colors {
    use crate::diagram::Color;

    /// The wetting phase; darker where it is trapped.
    pub(crate) const WETTING: Color = [86, 180, 233];
    pub(crate) const WETTING_TRAPPED: Color = [0, 114, 178];
    /// The non-wetting phase; darker where it is trapped.
    pub(crate) const NON_WETTING: Color = [230, 159, 0];
    pub(crate) const NON_WETTING_TRAPPED: Color = [166, 86, 0];
    /// Solids and walls.
    pub(crate) const SOLID: Color = [190, 190, 190];
    pub(crate) const WALL: Color = [80, 80, 80];
    /// Menisci.
    pub(crate) const MENISCUS: Color = [0, 0, 0];
    /// Pore space without fluid.
    pub(crate) const PORE: Color = [255, 255, 255];
    /// Where the spacing does not resolve a phase; also throats.
    pub(crate) const MARK: Color = [213, 60, 140];

    /// From the first to the last region invaded by a phase, around its color.
    pub(crate) const WETTING_IN_ORDER: &[Color] =
        &[[220, 240, 252], [150, 210, 244], WETTING, [30, 140, 200], [0, 104, 165], [0, 66, 110]];
    pub(crate) const NON_WETTING_IN_ORDER: &[Color] =
        &[[255, 238, 196], [248, 204, 106], NON_WETTING, [198, 122, 0], [150, 82, 0], [98, 48, 0]];
    /// Sizes, the largest dark: viridis at quarters (van der Walt and Smith 2015).
    pub(crate) const SIZES: &[Color] = &[[253, 231, 37], [92, 200, 99], [33, 144, 141], [59, 81, 139], [68, 1, 84]];
}

/// Direction of flow through an open side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Through {
    /// Into the domain.
    In,
    /// Out of it.
    Out,
}

/// The domain of a picture and its sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Lower left and upper right corner in m.
    pub bounds: [[f64; 2]; 2],
    /// Flow through the left, right, bottom and top side; `None` if a side is closed.
    pub open: [Option<Through>; 4],
    /// Whether the domain is periodic along x and y.
    pub periodic: [bool; 2],
}

/// How an area is colored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tone {
    /// By value, along the color bar.
    Value(f64),
    /// By class, given by its index.
    Class(usize),
}

/// An area of the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    /// Closed boundary in m, the first vertex not repeated.
    pub boundary: Vec<[f64; 2]>,
    /// Its color.
    pub tone: Tone,
}

/// A polyline and its width, both in m.
pub(crate) type Strip = (Vec<[f64; 2]>, f64);

/// A map of the plane: areas colored by value, with lines on top.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionMap {
    /// The file is `picture-NAME.png`; that of the first one `picture.png`.
    pub name: &'static str,
    /// Subtitle: the time or state of the run.
    pub note: String,
    /// The quantity of the color bar and its unit.
    pub label: &'static str,
    /// Lower and upper limit of the color bar.
    pub range: [f64; 2],
    /// Colors of the color bar, from low to high.
    pub bar: &'static [Color],
    /// Names and colors of the classes.
    pub classes: Vec<(&'static str, Color)>,
    /// The domain; whatever no area covers is solid.
    pub frame: Frame,
    /// The areas.
    pub areas: Vec<Area>,
    /// Walls: thin dark lines.
    pub walls: Vec<Vec<[f64; 2]>>,
    /// Menisci: the legend entry and the lines.
    pub menisci: (&'static str, Vec<Vec<[f64; 2]>>),
    /// Throats: the legend entry and the lines, dashed, below the others.
    pub throats: (&'static str, Vec<Vec<[f64; 2]>>),
    /// Films: the legend entry and the lines with their width in m, below the others.
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
