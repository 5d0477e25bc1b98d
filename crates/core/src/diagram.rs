//! Diagrams as data: the history of a solver, drawn by other modules.

use std::borrow::Cow;

use crate::math::Vec2;
use crate::snapshot::Outlines;

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity with its unit.
    pub label: Cow<'static, str>,
    /// Whether the scale is logarithmic; values that are not above zero are then omitted.
    pub logarithmic: bool,
}

/// Line style.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// A line of its own color.
    Full,
    /// One of many lines of a family: thin and gray.
    Thin,
    /// The expected line: dashed and black.
    Dashed,
    /// Dots of its own color.
    Dots,
    /// The area within a closed line, in a light tint of the color of the next line.
    Band,
    /// The reference of the last line: dashed, of its color.
    Reference,
    /// An error bar of the last line.
    Bar,
    /// White dots, on which the last line has its points.
    Blank,
    /// Points of the last line.
    Disc,
    /// The same, hollow.
    Ring,
}

/// A polyline.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Its name in the legend; empty for none.
    pub name: String,
    /// Its line style.
    pub stroke: Stroke,
    /// x and y.
    pub points: Vec<[f64; 2]>,
}

/// A quantity as a function of both axes, drawn as colored cells with edges midway between positions.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The quantity and the scale of its colors.
    pub quantity: Axis,
    /// Ascending positions along x: the centers of columns.
    pub x: Vec<f64>,
    /// Ascending positions along y: the centers of rows.
    pub y: Vec<f64>,
    /// Values, row by row; NaN where there is none.
    pub values: Vec<f64>,
    /// Range of the colors; that of the values if `None`.
    pub range: Option<[f64; 2]>,
    /// Indices in `values` of cells with a ring, and its name in the legend.
    pub ringed: (&'static str, Vec<usize>),
}

/// A number by which lines are colored where names would be too many.
#[derive(Debug, Clone, PartialEq)]
pub struct Shades {
    /// The quantity and the scale of its colors.
    pub quantity: Axis,
    /// Its value for each line of its own color, in their order.
    pub values: Vec<f64>,
}

/// A diagram.
#[derive(Debug, Clone, PartialEq)]
pub struct Diagram {
    /// Its file is `diagram-NAME.svg`.
    pub name: &'static str,
    /// Title in one line.
    pub title: Cow<'static, str>,
    /// The axis along x.
    pub x: Axis,
    /// The axis along y.
    pub y: Axis,
    /// The map below the lines, if any.
    pub map: Option<Map>,
    /// The lines.
    pub traces: Vec<Trace>,
    /// What the names of the lines give, above them in the legend; empty if they are whole.
    pub names_give: String,
    /// The number by which the lines are colored, if not each by its own color.
    pub shades: Option<Shades>,
}

impl Axis {
    /// A linear axis.
    pub fn linear(label: impl Into<Cow<'static, str>>) -> Self {
        Self { label: label.into(), logarithmic: false }
    }

    /// Whether it can show a value.
    pub fn shows(&self, value: f64) -> bool {
        value.is_finite() && (!self.logarithmic || value > 0.0)
    }

    /// A logarithmic axis.
    pub fn logarithmic(label: impl Into<Cow<'static, str>>) -> Self {
        Self { label: label.into(), logarithmic: true }
    }
}

impl Diagram {
    /// A diagram of lines.
    pub fn new(name: &'static str, title: impl Into<Cow<'static, str>>, [x, y]: [Axis; 2], traces: Vec<Trace>) -> Self {
        Self { name, title: title.into(), x, y, map: None, traces, names_give: String::new(), shades: None }
    }

    /// The same with lines colored by a number, one for each line of its own color, in place of their names where these would be too many.
    #[must_use]
    pub fn shaded_if_many(mut self, quantity: Axis, values: Vec<f64>) -> Self {
        /// Most lines that are told apart by their colors.
        const MOST: usize = 10;
        if values.len() > MOST {
            self.traces.iter_mut().for_each(|trace| trace.name.clear());
            self.names_give.clear();
            self.shades = Some(Shades { quantity, values });
        }
        self
    }

    /// A diagram of lines with linear axes of these labels.
    pub fn linear(name: &'static str, title: &'static str, labels: [&'static str; 2], traces: Vec<Trace>) -> Self {
        Self::new(name, title, labels.map(Axis::linear), traces)
    }
}

/// A color as red, green, blue.
pub type Color = [u8; 3];

/// The colors of all pictures, distinguishable by color-blind readers (Okabe and Ito 2008). `postprocess/colors.py` has the same.
pub mod colors {
    use crate::diagram::Color;

    /// The wetting phase; darker where it is trapped.
    pub const WETTING: Color = [86, 180, 233];
    pub const WETTING_TRAPPED: Color = [0, 114, 178];
    /// The non-wetting phase; darker where it is trapped.
    pub const NON_WETTING: Color = [230, 159, 0];
    pub const NON_WETTING_TRAPPED: Color = [166, 86, 0];
    /// Phases that were there before the half cycle in which they invade.
    pub const WETTING_BEFORE: Color = [70, 180, 140];
    pub const NON_WETTING_BEFORE: Color = [240, 228, 66];
    /// Solids and their walls.
    pub const SOLID: Color = [190, 190, 190];
    pub const WALL: Color = [80, 80, 80];
    /// Menisci.
    pub const MENISCUS: Color = [0, 0, 0];
    /// Pore space without a fluid.
    pub const PORE: Color = [255, 255, 255];
    /// Positions where the spacing does not resolve a phase; throats.
    pub const MARK: Color = [213, 60, 140];

    /// From the first to the last invaded region, around the color of the invading phase.
    pub const WETTING_IN_ORDER: &[Color] =
        &[[220, 240, 252], [150, 210, 244], WETTING, [30, 140, 200], [0, 104, 165], [0, 66, 110]];
    pub const NON_WETTING_IN_ORDER: &[Color] =
        &[[255, 238, 196], [248, 204, 106], NON_WETTING, [198, 122, 0], [150, 82, 0], [98, 48, 0]];
    /// Sizes, the largest one dark: viridis at quarters (van der Walt and Smith 2015).
    pub const SIZES: &[Color] = &[[253, 231, 37], [92, 200, 99], [33, 144, 141], [59, 81, 139], [68, 1, 84]];
}

/// Flow through an open side.
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

/// Color of an area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tone {
    /// A value, by the color bar.
    Value(f64),
    /// The class with this index.
    Class(usize),
}

/// An area of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    /// The number of its outline.
    pub cell: usize,
    /// Its shift from there in m.
    pub shift: Vec2,
    /// Its color.
    pub tone: Tone,
}

/// A line and its width, both in m.
pub(crate) type Strip = (Vec<[f64; 2]>, f64);

/// A map of the plane: areas colored by a number, with lines on top.
#[derive(Debug, Clone, PartialEq)]
pub struct RegionMap {
    /// The part of the run that it belongs to, from 0: the half cycle. Maps of one part have one color bar.
    pub part: usize,
    /// The line below the title: the progress of the run.
    pub note: String,
    /// The quantity of the color bar with its unit.
    pub label: &'static str,
    /// The ends of the color bar.
    pub range: [f64; 2],
    /// The colors along it, from low to high.
    pub bar: &'static [Color],
    /// Names and colors of the classes.
    pub classes: Vec<(&'static str, Color)>,
    /// The frame; what is not covered by an area is solid.
    pub frame: Frame,
    /// The areas.
    pub areas: Vec<Area>,
    /// Their outlines.
    pub outlines: Outlines,
    /// Thin dark lines: walls.
    pub walls: Vec<Vec<[f64; 2]>>,
    /// Lines with their name in the legend.
    pub menisci: (&'static str, Vec<Vec<[f64; 2]>>),
    /// Dashed lines with their name in the legend, below the others.
    pub throats: (&'static str, Vec<Vec<[f64; 2]>>),
    /// Lines of a width in m with their name in the legend and their color, below the others and within the areas: films.
    pub strips: (&'static str, Color, Vec<Strip>),
}

impl RegionMap {
    /// The vertices of an area in m.
    pub fn boundary(&self, area: &Area) -> impl Iterator<Item = Vec2> + use<> {
        let shift = area.shift;
        self.outlines.of(area.cell).into_iter().map(move |point| point + shift)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_scripts_have_the_same_colors() {
        let script = include_str!("../../../postprocess/colors.py");
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
