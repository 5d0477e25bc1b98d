//! Draws a [`Diagram`] as SVG: a map as colored cells, lines over it, the legend beside it (`plotters`).

use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axes::{DrawingError, NumberAxis, color_of, range};
use super::cells::Cells;
use super::legend::{Bar, Legend, Sign, draw_hatched, text_width, wrapped};
use super::shade::Scale;
use super::ticks::{LABEL_HEIGHT, label_width, short, ticks_at};
use meniscus_core::diagram::{Axis, Diagram, Stroke, Trace};

/// The layout of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Width and height without the legend in pixels.
    pub size: (u32, u32),
    /// Size of the title in pixels.
    pub title: u32,
    /// Positions along x that get the labels if they are few and short; empty for round numbers.
    pub x_positions: Vec<f64>,
}

/// The layout of the diagrams of a run.
const OF_RUN: Layout = Layout { size: (620, 440), title: 18, x_positions: Vec::new() };
/// Margin and space for the labels of the axes in pixels.
const MARGIN: u32 = 12;
const X_LABELS: u32 = 48;
const Y_LABELS: u32 = 84;
/// Opacity that each band adds to the one below it.
const BAND_SHARE: f64 = 0.25;
const GRAY: RGBColor = RGBColor(150, 150, 150);

/// A diagram that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[error("the diagram {name} cannot be drawn: {why}")]
pub struct DiagramError {
    /// Its name.
    pub name: &'static str,
    /// The error of the drawing library.
    pub why: String,
}

/// The diagram as SVG; `None` if there is nothing to show.
pub fn svg(diagram: &Diagram) -> Result<Option<String>, DiagramError> {
    svg_with(diagram, &OF_RUN)
}

/// The diagram as SVG in a layout; `None` if there is nothing to show.
pub fn svg_with(diagram: &Diagram, layout: &Layout) -> Result<Option<String>, DiagramError> {
    let fits = |point: &[f64; 2]| diagram.x.shows(point[0]) && diagram.y.shows(point[1]);
    let traces = diagram
        .traces
        .iter()
        .map(|trace| Trace { points: trace.points.iter().copied().filter(fits).collect(), ..trace.clone() });
    let traces: Vec<Trace> = traces.collect();
    let cells = Cells::of(diagram);
    if traces.iter().all(|trace| trace.points.is_empty()) && cells.is_none() {
        return Ok(None);
    }
    let of = |side: usize| traces.iter().flat_map(move |trace| trace.points.iter().map(move |point| point[side]));
    let [x, y] = match &cells {
        // A map fills its diagram.
        Some(cells) => cells.ranges(),
        None => [range(of(0), diagram.x.logarithmic), range(of(1), diagram.y.logarithmic)],
    };
    let [x_ticks, y_ticks] = ticks_of(layout, cells.as_ref(), [(&x, &diagram.x), (&y, &diagram.y)]);
    let axes = [
        NumberAxis { range: x, logarithmic: diagram.x.logarithmic, ticks: x_ticks },
        NumberAxis { range: y, logarithmic: diagram.y.logarithmic, ticks: y_ticks },
    ];
    let mut text = String::new();
    let drawn = draw(&mut text, Content { diagram, layout, cells, traces: &traces }, axes);
    drawn.map_err(|error| DiagramError { name: diagram.name, why: error.to_string() })?;
    Ok(Some(text))
}

/// The ticks along x and y: the positions of the layout or of the cells where they are readable.
fn ticks_of(layout: &Layout, cells: Option<&Cells<'_>>, axes: [(&Range<f64>, &Axis); 2]) -> [Vec<f64>; 2] {
    let [(x, x_axis), (y, y_axis)] = axes;
    let width = layout.size.0.saturating_sub(2 * MARGIN + Y_LABELS);
    let at_x = cells.map_or(&layout.x_positions, |cells| &cells.map().x);
    let at_y = cells.map_or(&[][..], |cells| &cells.map().y);
    let height = layout.size.1.saturating_sub(2 * MARGIN + X_LABELS + 2 * layout.title);
    [
        ticks_at(at_x, x, x_axis.logarithmic, &|value| label_width(value) / f64::from(width)),
        ticks_at(at_y, y, y_axis.logarithmic, &|_| LABEL_HEIGHT / f64::from(height)),
    ]
}

/// A color mixed with white; `fraction` is its part.
fn lightened(color: RGBColor, fraction: f64) -> RGBColor {
    let mix = |part: u8| (255.0 - fraction.min(1.0) * (255.0 - f64::from(part))).round() as u8;
    RGBColor(mix(color.0), mix(color.1), mix(color.2))
}

/// What is drawn: the map and the points of the traces that the axes can show.
struct Content<'a> {
    diagram: &'a Diagram,
    layout: &'a Layout,
    cells: Option<Cells<'a>>,
    traces: &'a [Trace],
}

/// Each trace with its color, and the scale of the lines if they are colored by a number.
fn colored<'t>(diagram: &Diagram, traces: &'t [Trace]) -> (Vec<(&'t Trace, RGBColor)>, Option<Scale>) {
    let scale = diagram.shades.as_ref().and_then(|shades| Scale::of(&shades.quantity, &shades.values, true));
    let count = traces.iter().filter(|trace| matches!(trace.stroke, Stroke::Full | Stroke::Dots)).count();
    let color = |number: usize| {
        let value = diagram.shades.as_ref().and_then(|shades| shades.values.get(number));
        value.zip(scale.as_ref()).map_or_else(|| color_of(number, count), |(value, scale)| scale.color(*value))
    };
    let (mut next, mut stacked) = (0, 0);
    let mut found = Vec::new();
    for trace in traces {
        if trace.stroke != Stroke::Band {
            stacked = 0;
        }
        let color = match trace.stroke {
            Stroke::Thin => GRAY,
            Stroke::Dashed => BLACK,
            Stroke::Full | Stroke::Dots => {
                next += 1;
                color(next - 1)
            }
            Stroke::Blank => WHITE,
            Stroke::Reference | Stroke::Bar | Stroke::Disc | Stroke::Ring => color(next.saturating_sub(1)),
            // Each lies on top of the one before.
            Stroke::Band => {
                stacked += 1;
                lightened(color(next), BAND_SHARE * f64::from(stacked))
            }
        };
        found.push((trace, color));
    }
    (found, scale)
}

/// The legend of a drawing.
fn legend(
    diagram: &Diagram,
    layout: &Layout,
    cells: Option<&Cells<'_>>,
    traces: &[(&Trace, RGBColor)],
    of_lines: Option<Scale>,
) -> Legend {
    let named = traces.iter().filter(|(trace, _)| !trace.name.is_empty() && !trace.points.is_empty());
    let mut names: Vec<(String, Sign)> = Vec::new();
    names.extend((!diagram.names_give.is_empty()).then(|| (diagram.names_give.clone(), Sign::Heading)));
    names.extend(named.map(|(trace, color)| (trace.name.clone(), Sign::Line(*color))));
    if let Some(cells) = cells {
        let (ring, ringed) = &cells.map().ringed;
        names.extend((!cells.empty().is_empty()).then(|| ("no value".to_owned(), Sign::Hatched)));
        names.extend((!ringed.is_empty()).then(|| ((*ring).to_owned(), Sign::Ring)));
    }
    let of_map = cells.map(|cells| (&cells.map().quantity.label, cells.scale.clone()));
    let of_lines = diagram.shades.as_ref().map(|shades| &shades.quantity.label).zip(of_lines);
    let bar = of_map.or(of_lines).map(|(label, scale)| Bar { label: label.to_string(), scale });
    Legend::new(&names, bar, layout.size.1)
}

fn draw<'a>(
    text: &'a mut String,
    Content { diagram, layout, cells, traces }: Content<'_>,
    [x, y]: [NumberAxis; 2],
) -> Result<(), DrawingError<'a>> {
    let (colored, scale) = colored(diagram, traces);
    let legend = legend(diagram, layout, cells.as_ref(), &colored, scale);
    let (width, height) = layout.size;
    let canvas = SVGBackend::with_string(text, (width + legend.size.0, legend.size.1)).into_drawing_area();
    canvas.fill(&WHITE)?;
    let (left, beside) = canvas.split_horizontally(width);
    legend.draw(&beside)?;
    let mut area = left.split_vertically(height).0.margin(MARGIN / 2, 0, 0, 0);
    let letters = width as usize / text_width("x", layout.title as i32) as usize;
    for line in wrapped(&diagram.title, letters) {
        area = area.titled(&line, ("sans-serif", layout.title))?;
    }
    let mut chart = ChartBuilder::on(&area)
        .margin(MARGIN)
        .margin_top(0)
        .x_label_area_size(X_LABELS)
        .y_label_area_size(Y_LABELS)
        .build_cartesian_2d(x, y)?;
    if let Some(cells) = &cells {
        let rectangle = |(corners, color): (_, RGBColor)| Rectangle::new(corners, color.filled());
        chart.draw_series(cells.rectangles().into_iter().map(rectangle))?;
        let pixel = |corner: &(f64, f64)| chart.plotting_area().map_coordinate(corner);
        draw_marks(&canvas, cells, &|index| {
            let [a, b] = cells.corners(index);
            let [a, b] = [pixel(&a), pixel(&b)];
            [(a.0.min(b.0), a.1.min(b.1)), (a.0.max(b.0), a.1.max(b.1))]
        })?;
    }
    let number = |value: &f64| short(*value);
    let mut mesh = chart.configure_mesh();
    if cells.is_some() {
        mesh.disable_mesh();
    }
    mesh.x_desc(&*diagram.x.label)
        .y_desc(&*diagram.y.label)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 15))
        .light_line_style(RGBColor(240, 240, 240))
        .x_label_formatter(&number)
        .y_label_formatter(&number)
        .draw()?;
    for (trace, color) in colored {
        let points = trace.points.iter().map(|point| (point[0], point[1]));
        let width = if matches!(trace.stroke, Stroke::Full | Stroke::Dashed | Stroke::Ring) { 2 } else { 1 };
        let line = color.stroke_width(width);
        match trace.stroke {
            Stroke::Full | Stroke::Thin | Stroke::Bar => chart.draw_series(LineSeries::new(points, line)).map(drop)?,
            Stroke::Dashed | Stroke::Reference => {
                chart.draw_series(DashedLineSeries::new(points, 6, 4, line)).map(drop)?;
            }
            Stroke::Band => {
                chart.draw_series([Polygon::new(points.collect::<Vec<_>>(), color.filled())]).map(drop)?;
            }
            Stroke::Dots => chart.draw_series(points.map(|point| Circle::new(point, 3, color.filled()))).map(drop)?,
            Stroke::Blank | Stroke::Disc => {
                chart.draw_series(points.map(|point| Circle::new(point, 4, color.filled()))).map(drop)?;
            }
            Stroke::Ring => chart.draw_series(points.map(|point| Circle::new(point, 4, line))).map(drop)?,
        }
    }
    canvas.present()
}

/// Hatches cells without a value, writes numbers into the others where all of them fit, and draws rings; `corners` are those of a cell in pixels, the upper
/// left one first.
fn draw_marks<'a>(
    canvas: &DrawingArea<SVGBackend<'a>, Shift>,
    cells: &Cells<'_>,
    corners: &dyn Fn(usize) -> [(i32, i32); 2],
) -> Result<(), DrawingError<'a>> {
    /// Size of numbers, space around them, and distance of a ring from the sides of its cell in pixels.
    const LETTERS: i32 = 12;
    const AROUND: i32 = 4;
    const RING: i32 = 8;
    for index in cells.empty() {
        draw_hatched(canvas, corners(index))?;
    }
    let numbers = cells.numbers();
    let fits = |(index, number, _): &(usize, String, RGBColor)| {
        let [a, b] = corners(*index);
        b.0 - a.0 >= text_width(number, LETTERS) + AROUND && b.1 - a.1 >= LETTERS + AROUND
    };
    let are_shown = numbers.iter().all(fits);
    for (index, number, color) in numbers.into_iter().filter(|_| are_shown) {
        let [a, b] = corners(index);
        let style = ("sans-serif", LETTERS).into_text_style(canvas).color(&color);
        let middle = style.pos(Pos::new(HPos::Center, VPos::Center));
        canvas.draw(&Text::new(number, ((a.0 + b.0) / 2, (a.1 + b.1) / 2), middle))?;
    }
    for &index in &cells.map().ringed.1 {
        let [a, b] = corners(index);
        let (x, y) = ((b.0 - RING).max((a.0 + b.0) / 2), (a.1 + RING).min((a.1 + b.1) / 2));
        canvas.draw(&Circle::new((x, y), 4, cells.ink(index).stroke_width(1)))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::diagram::{Map, Shades};

    fn diagram(traces: Vec<Trace>) -> Diagram {
        Diagram::new("test", "A test", ["x (m)", "t (s)"].map(Axis::logarithmic), traces)
    }

    fn trace(name: String, stroke: Stroke) -> Trace {
        Trace { name, stroke, points: vec![[0.0, 1.0], [1.0, 2.0], [10.0, f64::NAN], [10.0, 3.0]] }
    }

    #[test]
    fn lines_and_their_names_are_drawn_and_what_a_scale_cannot_show_is_left_out() {
        let strokes = [Stroke::Full, Stroke::Thin, Stroke::Dashed, Stroke::Dots, Stroke::Band];
        let named = strokes.map(|stroke| trace(format!("{stroke:?}"), stroke)).to_vec();
        let text = svg(&diagram(named)).unwrap().unwrap();
        assert!(text.starts_with("<svg") && !text.contains("NaN"));
        assert!(strokes.iter().all(|stroke| text.contains(&format!("{stroke:?}"))));
        let nothing = Trace { name: String::new(), stroke: Stroke::Full, points: vec![[-1.0, 1.0]] };
        assert_eq!(svg(&diagram(vec![nothing])).unwrap(), None);
    }

    #[test]
    fn a_map_has_numbers_a_bar_and_marks() {
        let values = vec![-2.0, 0.5, f64::NAN, 1.0];
        let map = Map {
            quantity: Axis::linear("capillary pressure (Pa)"),
            x: vec![1.0, 2.0],
            y: vec![1.0, 10.0],
            values,
            range: None,
            ringed: ("not at rest", vec![3]),
        };
        let text = svg(&Diagram { map: Some(map), ..diagram(Vec::new()) }).unwrap().unwrap();
        let has = |word: &str| text.lines().any(|line| line.trim() == word);
        assert!(["capillary pressure (Pa)", "no value", "not at rest", "-2", "0.5"].into_iter().all(has), "{text}");
        // The ring and its sign.
        assert_eq!(text.matches("<circle").count(), 2);
    }

    #[test]
    fn many_lines_have_a_bar_in_place_of_names() {
        let shades = Shades { quantity: Axis::linear("angle (degrees)"), values: (0..30).map(f64::from).collect() };
        let lines = (0..30).map(|_| trace(String::new(), Stroke::Full)).collect();
        let text = svg(&Diagram { shades: Some(shades), ..diagram(lines) }).unwrap().unwrap();
        assert!(text.contains("angle (degrees)"));
        let strokes = text.lines().filter(|line| line.contains("<polyline")).map(|line| line.split("stroke=\"").nth(1));
        let mut colors: Vec<&str> = strokes.flatten().filter_map(|rest| rest.split('"').next()).collect();
        colors.sort_unstable();
        colors.dedup();
        assert!(colors.len() >= 30, "{colors:?}");
    }

    #[test]
    fn a_long_title_has_several_lines_and_names_a_heading() {
        let traces = vec![trace("60".to_owned(), Stroke::Full)];
        let names_give = "angle (degrees)".to_owned();
        let long = Diagram { title: "long ".repeat(30).trim().to_owned().into(), names_give, ..diagram(traces) };
        let text = svg(&long).unwrap().unwrap();
        let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| line.starts_with("long long")).collect();
        assert!(lines.len() > 1 && lines.join(" ") == long.title, "{lines:?}");
        assert!(text.lines().any(|line| line.trim() == "angle (degrees)"));
    }
}
