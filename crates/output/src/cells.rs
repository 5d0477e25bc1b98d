//! The cells of a map: rectangles with edges midway between its positions, numbers in them, marks where there is no value.

use std::ops::Range;

use plotters::style::{BLACK, RGBColor, WHITE};

use super::shade::Scale;
use super::ticks::short;
use meniscus_core::diagram::{Diagram, Map};

/// A corner of a rectangle and the opposite one.
pub(super) type Corners = [(f64, f64); 2];

/// A map with the edges of its cells and its colors.
pub(super) struct Cells<'a> {
    map: &'a Map,
    x: Vec<f64>,
    y: Vec<f64>,
    /// Its colors.
    pub(super) scale: Scale,
}

impl<'a> Cells<'a> {
    /// The cells of the map of a diagram; `None` if it has none, or nothing to show.
    pub(super) fn of(diagram: &'a Diagram) -> Option<Self> {
        let map = diagram.map.as_ref().filter(|map| map.x.len() > 1 && map.y.len() > 1)?;
        let scale = Scale::of(&map.quantity, map.range.as_ref().map_or(&map.values[..], |range| range), false)?;
        let (x, y) = (edges(&map.x, diagram.x.logarithmic), edges(&map.y, diagram.y.logarithmic));
        Some(Self { map, x, y, scale })
    }

    /// The map.
    pub(super) fn map(&self) -> &'a Map {
        self.map
    }

    /// From the first to the last edge along x and y.
    pub(super) fn ranges(&self) -> [Range<f64>; 2] {
        [&self.x, &self.y].map(|edges| edges[0]..edges[edges.len() - 1])
    }

    /// The corners of a cell by its index.
    pub(super) fn corners(&self, index: usize) -> Corners {
        let (row, column) = (index / self.map.x.len(), index % self.map.x.len());
        [(self.x[column], self.y[row]), (self.x[column + 1], self.y[row + 1])]
    }

    /// Rectangles of one color, neighbors in a row as one.
    pub(super) fn rectangles(&self) -> Vec<(Corners, RGBColor)> {
        let columns = self.map.x.len();
        let step = |index: usize| {
            let value = self.map.values.get(index).copied().filter(|value| self.map.quantity.shows(*value))?;
            Some(Scale::step(self.scale.fraction(value)))
        };
        let mut found = Vec::new();
        for row in 0..self.map.y.len() {
            let of = |column: usize| step(row * columns + column);
            let mut first = 0;
            for column in 1..=columns {
                if column < columns && of(column) == of(first) {
                    continue;
                }
                if let Some(step) = of(first) {
                    let corners = [(self.x[first], self.y[row]), (self.x[column], self.y[row + 1])];
                    found.push((corners, self.scale.color_of_step(step)));
                }
                first = column;
            }
        }
        found
    }

    /// The cells without a value.
    pub(super) fn empty(&self) -> Vec<usize> {
        let is_empty = |index: &usize| !self.map.values.get(*index).is_some_and(|v| self.map.quantity.shows(*v));
        (0..self.map.x.len() * self.map.y.len()).filter(is_empty).collect()
    }

    /// The numbers of the cells with their colors, by index, if there are few; four digits at most.
    pub(super) fn numbers(&self) -> Vec<(usize, String, RGBColor)> {
        /// More numbers along a side would not be read.
        const MOST: usize = 10;
        if self.map.x.len() > MOST || self.map.y.len() > MOST {
            return Vec::new();
        }
        let digits = |value: f64| short(format!("{value:.2e}").parse().unwrap_or(value));
        let shown = self.map.values.iter().enumerate().filter(|(_, value)| self.map.quantity.shows(**value));
        shown.map(|(index, value)| (index, digits(*value), self.ink(index))).collect()
    }

    /// The color that can be read on a cell.
    pub(super) fn ink(&self, index: usize) -> RGBColor {
        /// Weights of red, green, blue in the luminance (ITU-R BT.709), and the gray on which black and white read equally well.
        const WEIGHTS: [f64; 3] = [0.2126, 0.7152, 0.0722];
        const MIDDLE: f64 = 130.0;
        let value = self.map.values.get(index).copied().filter(|value| self.map.quantity.shows(*value));
        let RGBColor(red, green, blue) = value.map_or(WHITE, |value| self.scale.color(value));
        let luminance: f64 =
            [red, green, blue].iter().zip(WEIGHTS).map(|(part, weight)| weight * f64::from(*part)).sum();
        if luminance > MIDDLE { BLACK } else { WHITE }
    }
}

/// The edges between positions, at the midpoints, and those of the first and the last.
fn edges(positions: &[f64], logarithmic: bool) -> Vec<f64> {
    let to = |x: f64| if logarithmic { x.ln() } else { x };
    let from = |x: f64| if logarithmic { x.exp() } else { x };
    let n = positions.len();
    let at = |i: usize| to(positions[i]);
    let edge = |i: usize| match i {
        0 => 1.5 * at(0) - 0.5 * at(1),
        _ if i == n => 1.5 * at(n - 1) - 0.5 * at(n - 2),
        _ => 0.5 * (at(i - 1) + at(i)),
    };
    (0..=n).map(|i| from(edge(i))).collect()
}

/// The lines of a hatching within a rectangle of pixels.
pub(super) fn hatching([(left, top), (right, bottom)]: [(i32, i32); 2]) -> Vec<[(i32, i32); 2]> {
    /// Distance of the lines along x in pixels.
    const APART: usize = 8;
    let height = bottom - top;
    let line = |foot: i32| {
        let (from, to) = ((left - foot).max(0), (right - foot).min(height));
        (from < to).then(|| [(foot + from, bottom - from), (foot + to, bottom - to)])
    };
    (left - height..right).step_by(APART).filter_map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::diagram::Axis;

    fn diagram(values: Vec<f64>) -> Diagram {
        let (x, y) = (vec![1.0, 2.0, 3.0, 5.0], vec![1.0, 10.0]);
        let map = Map { quantity: Axis::linear("h (m)"), x, y, values, range: None, ringed: ("not at rest", vec![1]) };
        let axes = [Axis::linear("x (m)"), Axis::logarithmic("t (s)")];
        Diagram { map: Some(map), ..Diagram::new("test", "A test", axes, Vec::new()) }
    }

    #[test]
    fn cells_cover_a_map_without_a_gap_and_equal_neighbors_are_one() {
        let diagram = diagram(vec![0.0, 0.01, 0.01, -1.0, 0.5, 0.5, 0.5, 0.5]);
        let cells = Cells::of(&diagram).unwrap();
        assert_eq!(cells.x, [0.5, 1.5, 2.5, 4.0, 6.0]);
        let found = cells.rectangles();
        let width = |row: f64| -> f64 {
            found.iter().filter(|(corners, _)| corners[0].1 == row).map(|([a, b], _)| b.0 - a.0).sum()
        };
        assert_eq!((found.len(), width(cells.y[0]), width(cells.y[1])), (3, 5.5, 5.5));
        assert!(cells.empty().is_empty());
        assert_eq!(cells.corners(6), [(2.5, cells.y[1]), (4.0, cells.y[2])]);
    }

    #[test]
    fn a_cell_without_a_value_is_empty_and_the_others_have_numbers_that_can_be_read() {
        let diagram = diagram(vec![1.0, f64::NAN, 3.0, 4.0, 5.0, 6.0, 7.0, 12345.6]);
        let cells = Cells::of(&diagram).unwrap();
        assert_eq!(cells.empty(), [1]);
        let numbers = cells.numbers();
        assert_eq!(numbers.iter().map(|n| n.1.as_str()).collect::<Vec<_>>(), ["1", "3", "4", "5", "6", "7", "12300"]);
        assert_eq!((numbers[0].2, numbers[6].2), (BLACK, WHITE));
        assert!(Cells::of(&super::tests::diagram(vec![f64::NAN; 8])).is_none());
    }

    #[test]
    fn hatching_stays_in_its_rectangle() {
        let lines = hatching([(10, 20), (31, 60)]);
        assert!(lines.len() > 5);
        let inside = |&(x, y): &(i32, i32)| (10..=31).contains(&x) && (20..=60).contains(&y);
        assert!(lines.iter().flatten().all(inside), "{lines:?}");
    }
}
