//! Draws a [`Diagram`] as SVG: a map as filled contours, lines over it, the legend beside it (`plotters`).

use plotters::coord::combinators::BindKeyPoints;
use plotters::prelude::*;

use super::axes::{DrawingError, LEGEND, NumberAxis, color_of, draw_legend, logarithmic_ticks, range, short};
use meniscus_core::diagram::{Axis, Diagram, Map, Stroke, Trace};

/// The layout of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Width and height without the legend in pixels.
    pub size: (u32, u32),
    /// Size of the title in pixels.
    pub title: u32,
    /// Most labels along x of a linear axis.
    pub x_labels: usize,
    /// The ticks along x of a logarithmic axis; round numbers if `None`.
    pub x_ticks: Option<Vec<f64>>,
}

/// The layout of the diagrams of a run.
const OF_RUN: Layout = Layout { size: (620, 440), title: 18, x_labels: 6, x_ticks: None };
/// Color bands of a map; few enough to be distinguishable, and to keep files small.
const BANDS: usize = 16;
/// Lightest and darkest band.
const LIGHT: [f64; 3] = [235.0, 243.0, 250.0];
const DARK: [f64; 3] = [8.0, 48.0, 107.0];
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
    let shown = |axis: &Axis, value: f64| value.is_finite() && (!axis.logarithmic || value > 0.0);
    let fits = |point: &[f64; 2]| shown(&diagram.x, point[0]) && shown(&diagram.y, point[1]);
    let mut traces: Vec<Trace> = diagram.traces.clone();
    traces.iter_mut().for_each(|trace| trace.points.retain(fits));
    traces.retain(|trace| !trace.points.is_empty());
    let map = diagram.map.as_ref().filter(|map| map.x.len() > 1 && map.y.len() > 1);
    if traces.is_empty() && map.is_none() {
        return Ok(None);
    }
    let of = |side: usize| traces.iter().flat_map(move |trace| trace.points.iter().map(move |point| point[side]));
    let (x, y) = match map {
        // A map fills its diagram.
        Some(map) => (ends(&map.x, diagram.x.logarithmic), ends(&map.y, diagram.y.logarithmic)),
        None => (range(of(0), diagram.x.logarithmic), range(of(1), diagram.y.logarithmic)),
    };
    let mut text = String::new();
    let log = |range: std::ops::Range<f64>, ticks: Option<&Vec<f64>>| {
        let ticks = ticks.cloned().unwrap_or_else(|| logarithmic_ticks(&range));
        range.log_scale().with_key_points(ticks)
    };
    let content = Content { diagram, layout, map, traces: &traces };
    let ticks = layout.x_ticks.as_ref();
    let drawn = match (diagram.x.logarithmic, diagram.y.logarithmic) {
        (false, false) => draw(&mut text, content, x, y),
        (true, false) => draw(&mut text, content, log(x, ticks), y),
        (false, true) => draw(&mut text, content, x, log(y, None)),
        (true, true) => draw(&mut text, content, log(x, ticks), log(y, None)),
    };
    drawn.map_err(|error| DiagramError { name: diagram.name, why: error.to_string() })?;
    Ok(Some(text))
}

fn ends(positions: &[f64], logarithmic: bool) -> std::ops::Range<f64> {
    let edges = edges(positions, logarithmic);
    edges.first().copied().unwrap_or(0.0)..edges.last().copied().unwrap_or(1.0)
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

fn band_color(band: usize) -> RGBColor {
    let fraction = band as f64 / (BANDS - 1) as f64;
    let [red, green, blue] = [0, 1, 2].map(|i| (LIGHT[i] + fraction * (DARK[i] - LIGHT[i])).round() as u8);
    RGBColor(red, green, blue)
}

/// A color mixed with white; `fraction` is its part.
fn lightened(color: RGBColor, fraction: f64) -> RGBColor {
    let mix = |part: u8| (255.0 - fraction.min(1.0) * (255.0 - f64::from(part))).round() as u8;
    RGBColor(mix(color.0), mix(color.1), mix(color.2))
}

/// Rectangles, each of one band: from and to corner.
fn bands(map: &Map, x: &[f64], y: &[f64]) -> Vec<([(f64, f64); 2], usize)> {
    let highest = map.values.iter().copied().fold(0.0, f64::max);
    let band = |value: f64| ((value / highest * BANDS as f64).max(0.0) as usize).min(BANDS - 1);
    let columns = map.x.len();
    let mut found = Vec::new();
    for (row, values) in map.values.chunks_exact(columns).enumerate().take(map.y.len()) {
        let mut first = 0;
        for column in 1..=columns {
            if column == columns || band(values[column]) != band(values[first]) {
                found.push(([(x[first], y[row]), (x[column], y[row + 1])], band(values[first])));
                first = column;
            }
        }
    }
    found
}

/// What is drawn: the map and the points of the traces that the axes can show.
struct Content<'a> {
    diagram: &'a Diagram,
    layout: &'a Layout,
    map: Option<&'a Map>,
    traces: &'a [Trace],
}

fn draw<'a>(
    text: &'a mut String,
    Content { diagram, layout, map, traces }: Content<'_>,
    x: impl NumberAxis,
    y: impl NumberAxis,
) -> Result<(), DrawingError<'a>> {
    let mut colors = 0..;
    let mut stacked = 0;
    let mut colored: Vec<(&Trace, RGBColor)> = Vec::new();
    for trace in traces {
        let color = match trace.stroke {
            Stroke::Thin => GRAY,
            Stroke::Dashed => BLACK,
            Stroke::Full | Stroke::Dots => color_of(colors.next().unwrap_or(0)),
            Stroke::Blank => WHITE,
            Stroke::Reference | Stroke::Bar | Stroke::Disc | Stroke::Ring => color_of(colors.start.saturating_sub(1)),
            // Each lies on top of the one before.
            Stroke::Band => {
                stacked += 1;
                lightened(color_of(colors.start), BAND_SHARE * f64::from(stacked))
            }
        };
        if trace.stroke != Stroke::Band {
            stacked = 0;
        }
        colored.push((trace, color));
    }
    let mut names: Vec<(String, RGBColor)> = colored
        .iter()
        .filter(|(trace, _)| !trace.name.is_empty())
        .map(|(trace, color)| (trace.name.clone(), *color))
        .collect();
    if let Some(map) = map {
        let highest = map.values.iter().copied().fold(0.0, f64::max);
        for band in [BANDS - 1, BANDS / 2, 0] {
            let middle = highest * (band as f64 + 0.5) / BANDS as f64;
            let value = short(format!("{middle:.1e}").parse().unwrap_or(middle));
            names.push((format!("{}: {value}", map.label), band_color(band)));
        }
    }
    let (width, height) = layout.size;
    let whole = width + if names.is_empty() { 0 } else { LEGEND };
    let canvas = SVGBackend::with_string(text, (whole, height)).into_drawing_area();
    canvas.fill(&WHITE)?;
    let (area, margin) = canvas.split_horizontally(width);
    draw_legend(&margin, &names)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(&diagram.title, ("sans-serif", layout.title))
        .margin(12)
        .x_label_area_size(48)
        .y_label_area_size(84)
        .build_cartesian_2d(x, y)?;
    if let Some(map) = map {
        let (x, y) = (edges(&map.x, diagram.x.logarithmic), edges(&map.y, diagram.y.logarithmic));
        let rectangle = |(corners, band)| Rectangle::new(corners, band_color(band).filled());
        chart.draw_series(bands(map, &x, &y).into_iter().map(rectangle))?;
    }
    let number = |value: &f64| short(*value);
    let mut mesh = chart.configure_mesh();
    if map.is_some() {
        mesh.disable_mesh();
    }
    mesh.x_desc(&*diagram.x.label)
        .y_desc(&*diagram.y.label)
        .x_labels(layout.x_labels)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn diagram(map: Option<Map>, traces: Vec<Trace>) -> Diagram {
        let axis = |label: &'static str| Axis { label: label.into(), logarithmic: true };
        Diagram { name: "test", title: "A test".into(), x: axis("x in m"), y: axis("t in s"), map, traces }
    }

    #[test]
    fn lines_and_their_names_are_drawn_and_what_a_scale_cannot_show_is_left_out() {
        let strokes = [Stroke::Full, Stroke::Thin, Stroke::Dashed, Stroke::Dots, Stroke::Band];
        let trace = |stroke| Trace {
            name: format!("{stroke:?}"),
            stroke,
            points: vec![[0.0, 1.0], [1.0, 2.0], [10.0, f64::NAN], [10.0, 3.0]],
        };
        let text = svg(&diagram(None, strokes.map(trace).to_vec())).unwrap().unwrap();
        assert!(text.starts_with("<svg") && !text.contains("NaN"));
        assert!(strokes.iter().all(|stroke| text.contains(&format!("{stroke:?}"))));
        let nothing = Trace { name: String::new(), stroke: Stroke::Full, points: vec![[-1.0, 1.0]] };
        assert_eq!(svg(&diagram(None, vec![nothing])).unwrap(), None);
    }

    #[test]
    fn a_map_is_covered_by_bands_without_a_gap() {
        let values = vec![0.0, 0.1, 0.1, 1.0, 0.5, 0.5, 0.5, 0.5];
        let map = Map { label: "h in m", x: vec![1.0, 2.0, 3.0, 4.0], y: vec![1.0, 10.0], values };
        let (x, y) = (edges(&map.x, false), edges(&map.y, true));
        assert_eq!(x, [0.5, 1.5, 2.5, 3.5, 4.5]);
        let found = bands(&map, &x, &y);
        let widths = |row: f64| -> f64 {
            found.iter().filter(|(corners, _)| corners[0].1 == row).map(|([a, b], _)| b.0 - a.0).sum()
        };
        assert_eq!((found.len(), widths(y[0]), widths(y[1])), (4, 4.0, 4.0));
        assert!(svg(&diagram(Some(map), Vec::new())).unwrap().unwrap().contains("h in m: "));
    }
}
