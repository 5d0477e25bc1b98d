//! Two displacements at one saturation as SVG: the network on the left, the direct simulation on the right, each a map of the phases under the outline of the
//! solids.

use std::fmt::Write;

use super::track::Grid;
use meniscus_case::FluidPhase;
use meniscus_core::diagram::colors;
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::Lines;
use meniscus_output::picture::{length_text, round_length};

/// Width of a map in pixels of the page, and the gap between both.
const WIDTH: f64 = 468.0;
const GAP: f64 = 24.0;
/// Space for titles above the maps, and for scale bar and legend below them.
const HEAD: f64 = 30.0;
const FOOT: f64 = 46.0;
/// Largest width of the scale bar relative to that of a map.
const BAR: f64 = 0.25;

/// Common to both maps.
pub(crate) struct Maps<'a> {
    /// Their cells.
    pub(crate) grid: &'a Grid,
    /// The outline of the solids in m.
    pub(crate) outline: &'a Lines<'a>,
    /// The invading phase.
    pub(crate) invading: FluidPhase,
}

/// Both maps; `invaded` states for each cell of the pore whether it has the invading phase, `saturation` is that of the wetting phase.
pub(crate) fn svg(maps: &Maps<'_>, invaded: [&[bool]; 2], saturation: [f64; 2]) -> String {
    let [columns, rows] = maps.grid.counts;
    let size = maps.grid.bounds.size();
    let tall = WIDTH * size.y / size.x;
    let (width, height) = (2.0 * WIDTH + GAP, HEAD + tall + FOOT);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" \
         font-family=\"sans-serif\" font-size=\"15\"><rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"white\"/>"
    );
    let placing = Placing { maps, tall };
    let [invading, defending] = match maps.invading {
        FluidPhase::Wetting => [colors::WETTING, colors::NON_WETTING],
        FluidPhase::NonWetting => [colors::NON_WETTING, colors::WETTING],
    }
    .map(hex);
    for (side, name) in ["network", "direct simulation"].into_iter().enumerate() {
        let left = side as f64 * (WIDTH + GAP);
        // Writing to a string cannot fail.
        let _ = write!(
            svg,
            "<text x=\"{left:.0}\" y=\"20\">{name}, S<tspan font-size=\"11\" dy=\"3\">w</tspan><tspan dy=\"-3\"> = {:.3}</tspan></text>",
            saturation[side]
        );
        let _ = write!(
            svg,
            "<g transform=\"translate({left:.0} {HEAD:.0}) scale({:.6} {:.6})\" shape-rendering=\"crispEdges\">\
             <rect width=\"{columns}\" height=\"{rows}\" fill=\"{}\"/>",
            WIDTH / columns as f64,
            tall / rows as f64,
            hex(colors::SOLID)
        );
        for (color, wanted) in [(&invading, true), (&defending, false)] {
            let _ = write!(svg, "<path fill=\"{color}\" d=\"{}\"/>", runs(maps.grid, invaded[side], wanted));
        }
        let _ = write!(
            svg,
            "</g><g transform=\"translate({left:.0} {HEAD:.0})\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\">\
             <path d=\"{}\"/><path stroke-width=\"1\" d=\"M0 0H{WIDTH:.0}V{tall:.1}H0Z\"/></g>",
            hex(colors::WALL),
            placing.outline()
        );
    }
    let below = HEAD + tall + 18.0;
    let bar = round_length(BAR * size.x);
    let _ = write!(
        svg,
        "<rect x=\"0\" y=\"{below:.1}\" width=\"{:.1}\" height=\"5\"/><text x=\"0\" y=\"{:.1}\">{}</text>",
        bar / size.x * WIDTH,
        below + 22.0,
        length_text(bar)
    );
    let entries = [("wetting", colors::WETTING), ("non-wetting", colors::NON_WETTING), ("solid", colors::SOLID)];
    for ((name, color), x) in entries.into_iter().zip([WIDTH + GAP, WIDTH + GAP + 100.0, WIDTH + GAP + 230.0]) {
        let _ = write!(
            svg,
            "<rect x=\"{x:.0}\" y=\"{:.1}\" width=\"14\" height=\"14\" fill=\"{}\" stroke=\"{}\"/><text x=\"{:.0}\" y=\"{:.1}\">{name}</text>",
            below - 4.0,
            hex(color),
            hex(colors::WALL),
            x + 20.0,
            below + 8.0
        );
    }
    svg + "</svg>"
}

/// A color in SVG notation.
fn hex([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Transformation from meters to pixels of a map.
struct Placing<'a> {
    maps: &'a Maps<'a>,
    tall: f64,
}

impl Placing<'_> {
    /// The outline of the solids within the domain as a path.
    fn outline(&self) -> String {
        let bounds = &self.maps.grid.bounds;
        let pixel = |x: Vec2| {
            let fraction = (x - bounds.min).component_div(&bounds.size());
            [WIDTH * fraction.x, self.tall * (1.0 - fraction.y)]
        };
        let slack = 1.0e-9 * bounds.size().max();
        let is_inside = |x: &Vec2| bounds.grown(slack).contains(*x);
        let mut path = String::new();
        for line in &self.maps.outline.lines {
            let mut pen_is_down = false;
            for x in line.iter().filter_map(|&i| self.maps.outline.points.get(i as usize)) {
                let [left, top] = pixel(*x);
                let is_visible = is_inside(x);
                if is_visible {
                    let _ = write!(path, "{}{left:.1} {top:.1}", if pen_is_down { "L" } else { "M" });
                }
                pen_is_down = is_visible;
            }
        }
        path
    }
}

/// The cells of one phase, adjacent ones of a row merged into one rectangle.
fn runs(grid: &Grid, invaded: &[bool], wanted: bool) -> String {
    let [columns, rows] = grid.counts;
    let chosen = grid.cells.iter().zip(invaded).filter(|(_, invaded)| **invaded == wanted).map(|((cell, _), _)| *cell);
    let cells: Vec<usize> = chosen.collect();
    let mut path = String::new();
    for run in cells.chunk_by(|a, b| a + 1 == *b && a / columns == b / columns) {
        let (x, row, length) = (run[0] % columns, run[0] / columns, run.len());
        // The first row of cells is at the bottom.
        let _ = write!(path, "M{x} {}h{length}v1h-{length}z", rows - 1 - row);
    }
    path
}
