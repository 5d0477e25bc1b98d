//! Two displacements at one saturation as SVG: the network on the left, the direct simulation on the right.

use std::fmt::Write;

use super::track::Grid;

/// Colors of the solid, of the invading and of the defending phase, as in the pictures of runs.
const SOLID: &str = "#c4c0b8";
const INVADING: &str = "#f6e8b0";
const DEFENDING: &str = "#5590cc";

/// Width of a picture in pixels of the page.
const WIDTH: f64 = 480.0;

/// Both maps; `invaded` tells for each cell of the pore whether it holds the invading phase.
pub(crate) fn svg(grid: &Grid, invaded: [&[bool]; 2]) -> String {
    let [columns, rows] = grid.counts;
    let gap = columns / 20 + 1;
    let (width, height) = (2 * columns + gap, rows);
    let scale = 2.0 * WIDTH / width as f64;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{:.0}\" height=\"{:.0}\" \
         shape-rendering=\"crispEdges\">",
        scale * width as f64,
        scale * height as f64
    );
    for (side, invaded) in invaded.into_iter().enumerate() {
        let x = side * (columns + gap);
        // Writing to a string cannot fail.
        let _ = write!(svg, "<rect x=\"{x}\" y=\"0\" width=\"{columns}\" height=\"{rows}\" fill=\"{SOLID}\"/>");
        for (color, wanted) in [(INVADING, true), (DEFENDING, false)] {
            let _ = write!(svg, "<path fill=\"{color}\" d=\"{}\"/>", runs(grid, invaded, wanted, x));
        }
    }
    svg + "</svg>"
}

/// The cells of one phase, those side by side in a row as one rectangle.
fn runs(grid: &Grid, invaded: &[bool], wanted: bool, shift: usize) -> String {
    let [columns, rows] = grid.counts;
    let chosen = grid.cells.iter().zip(invaded).filter(|(_, invaded)| **invaded == wanted).map(|((cell, _), _)| *cell);
    let cells: Vec<usize> = chosen.collect();
    let mut path = String::new();
    for run in cells.chunk_by(|a, b| a + 1 == *b && a / columns == b / columns) {
        let (x, row, length) = (run[0] % columns + shift, run[0] / columns, run.len());
        // The first row of cells lies at the bottom.
        let _ = write!(path, "M{x} {}h{length}v1h-{length}z", rows - 1 - row);
    }
    path
}
