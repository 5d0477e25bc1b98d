//! The curves of a study as SVG: measures or errors over a parameter, one line per value of another parameter.

use plotters::coord::combinators::BindKeyPoints;
use plotters::prelude::*;

use super::definition::{Curve, Quantity};
use super::raw::RawScale;
use super::results::{RunResult, measures};
use super::values::shown;
use crate::analysis::convergence::observed_order;
use crate::io::axes::{DrawingError, LEGEND, NumberAxis, color_of, draw_legend, logarithmic_ticks, range, short};

/// Width and height of the drawing in pixels.
const SIZE: (u32, u32) = (720, 480);
/// A curve that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct CurveError(String);

/// A point of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    /// x.
    pub(crate) x: f64,
    /// y.
    pub(crate) y: f64,
    /// Uncertainty of y.
    pub(crate) uncertainty: Option<f64>,
    /// Whether y and x no longer changed at the end of the run; other points are hollow.
    pub(crate) is_at_rest: bool,
    /// Whether y is a rounding error, which has no order.
    pub(crate) is_rounding: bool,
}

/// One line of a curve.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    /// Its name; empty if there is only one line.
    pub name: String,
    /// Points by increasing x.
    pub points: Vec<Point>,
    /// Reference values of y, by increasing x.
    pub reference: Vec<(f64, f64)>,
}

/// The parameters whose values separate the lines of a curve: its series and, if a line would have two values at one x, others that vary.
fn series(curve: &Curve, results: &[RunResult]) -> Vec<String> {
    let mut names: Vec<String> = curve.series.iter().cloned().collect();
    let all = || results.iter().flat_map(|result| &result.run.parameters).map(|parameter| &parameter.name);
    let is_parameter = all().any(|name| *name == curve.x);
    // Otherwise equal runs would be on one point.
    let shared = |names: &[String]| {
        let keys = results.iter().map(|result| {
            let of_line: Vec<_> = names.iter().map(|name| result.run.value(name)).collect();
            (result.run.value(&curve.x), of_line)
        });
        let keys: Vec<_> = keys.collect();
        (1..keys.len()).filter(|&k| keys[..k].contains(&keys[k])).count()
    };
    for name in all() {
        let added = [&names[..], std::slice::from_ref(name)].concat();
        if is_parameter && *name != curve.x && !names.contains(name) && shared(&added) < shared(&names) {
            names = added;
        }
    }
    names
}

/// The lines of a curve, from runs that have the values; points that a logarithmic scale cannot show are left out.
pub(crate) fn lines(curve: &Curve, results: &[RunResult]) -> Vec<Line> {
    let series = series(curve, results);
    let mut lines: Vec<Line> = Vec::new();
    let fits = |scale, value: f64| value.is_finite() && (scale == RawScale::Linear || value > 0.0);
    for result in results {
        let of = |name: &String| Some(format!("{name} = {}", shown(result.run.value(name)?)));
        let name = series.iter().filter_map(of).collect::<Vec<_>>().join(", ");
        let (Some(x), Some(y)) = (result.number(&curve.x), result.number(&curve.y)) else { continue };
        let reference = curve.reference.as_ref().and_then(|reference| result.run.quantity(reference));
        let shown_y = if curve.error { (y - reference.unwrap_or(0.0)).abs() } else { y };
        let index = lines.iter().position(|line| line.name == name).unwrap_or_else(|| {
            lines.push(Line { name, points: Vec::new(), reference: Vec::new() });
            lines.len() - 1
        });
        if fits(curve.x_scale, x) && fits(curve.y_scale, shown_y) {
            let is_rounding = curve.error && shown_y <= result.rounding(&curve.y, reference.unwrap_or(0.0));
            let is_at_rest = [&curve.x, &curve.y].into_iter().all(|name| result.motion(name).is_none());
            let uncertainty = result.uncertainty(&curve.y);
            lines[index].points.push(Point { x, y: shown_y, uncertainty, is_at_rest, is_rounding });
        }
        if let Some(reference) = reference.filter(|r| !curve.error && fits(curve.x_scale, x) && fits(curve.y_scale, *r))
        {
            lines[index].reference.push((x, reference));
        }
    }
    for line in &mut lines {
        line.points.sort_by(|a, b| a.x.total_cmp(&b.x));
        line.reference.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    lines.retain(|line| !line.points.is_empty());
    lines
}

/// Draws a curve; `None` if there is no point yet.
pub(crate) fn svg(curve: &Curve, results: &[RunResult]) -> Result<Option<String>, CurveError> {
    let lines = lines(curve, results);
    if lines.is_empty() {
        return Ok(None);
    }
    let whiskers = |point: &Point| {
        let u = point.uncertainty.filter(|_| !curve.error).unwrap_or(0.0);
        [point.y - u, point.y + u]
    };
    let all_x = lines.iter().flat_map(|line| line.points.iter().map(|point| point.x));
    let all_y = lines
        .iter()
        .flat_map(|line| line.points.iter().flat_map(whiskers).chain(line.reference.iter().map(|point| point.1)));
    let x = range(all_x, curve.x_scale == RawScale::Logarithmic);
    let y = range(all_y, curve.y_scale == RawScale::Logarithmic);
    let labels = (curve.x.clone(), y_label(curve, results));
    let mut text = String::new();
    let x_ticks = distinct(&lines).filter(|_| curve.x_scale == RawScale::Logarithmic);
    let log = |range: std::ops::Range<f64>, ticks: Option<Vec<f64>>| {
        let ticks = ticks.unwrap_or_else(|| logarithmic_ticks(&range));
        range.log_scale().with_key_points(ticks)
    };
    let drawn = match (curve.x_scale, curve.y_scale) {
        (RawScale::Linear, RawScale::Linear) => draw(&mut text, curve, &lines, labels, x, y),
        (RawScale::Logarithmic, RawScale::Linear) => draw(&mut text, curve, &lines, labels, log(x, x_ticks), y),
        (RawScale::Linear, RawScale::Logarithmic) => draw(&mut text, curve, &lines, labels, x, log(y, None)),
        (RawScale::Logarithmic, RawScale::Logarithmic) => {
            draw(&mut text, curve, &lines, labels, log(x, x_ticks), log(y, None))
        }
    };
    drawn.map_err(|error| CurveError(error.to_string()))?;
    Ok(Some(text))
}

/// The values of x if they are few enough for tick labels.
fn distinct(lines: &[Line]) -> Option<Vec<f64>> {
    /// More labels would overlap.
    const MOST: usize = 8;
    let mut values: Vec<f64> = lines.iter().flat_map(|line| line.points.iter().map(|point| point.x)).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    Some(values).filter(|values| values.len() <= MOST)
}

fn y_label(curve: &Curve, results: &[RunResult]) -> String {
    let of = match (&curve.reference, curve.error) {
        (Some(Quantity::Parameter(name)), true) => format!("|{} − {name}|", curve.y),
        (Some(Quantity::Number(number)), true) if *number != 0.0 => format!("|{} − {number}|", curve.y),
        (_, true) => format!("|{}|", curve.y),
        (_, false) => curve.y.clone(),
    };
    match measures(results).get(&curve.y) {
        Some(unit) if !unit.is_empty() => format!("{of} in {unit}"),
        _ => of,
    }
}

/// The name of a line in the legend, with the observed order or slope if the scales show a power law as a straight line.
fn legend(curve: &Curve, line: &Line) -> String {
    let logarithmic = curve.x_scale == RawScale::Logarithmic && curve.y_scale == RawScale::Logarithmic;
    let counted = line.points.iter().filter(|point| !point.is_rounding);
    let (x, y): (Vec<f64>, Vec<f64>) = counted.map(|point| (point.x, point.y)).unzip();
    let order = observed_order(&x, &y);
    let word = if curve.error { "order" } else { "slope" };
    let order = (logarithmic && order.is_finite()).then(|| format!("{word} {order:.2}"));
    [Some(line.name.clone()).filter(|name| !name.is_empty()), order]
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(", ")
}

fn draw<'a>(
    text: &'a mut String,
    curve: &Curve,
    lines: &[Line],
    (x_label, y_label): (String, String),
    x: impl NumberAxis,
    y: impl NumberAxis,
) -> Result<(), DrawingError<'a>> {
    let name = |(number, line)| (legend(curve, line), color_of(number));
    let names: Vec<(String, RGBColor)> = lines.iter().enumerate().map(name).collect();
    let named = names.iter().any(|(name, _)| !name.is_empty());
    let width = SIZE.0 + if named { LEGEND } else { 0 };
    let canvas = SVGBackend::with_string(text, (width, SIZE.1)).into_drawing_area();
    canvas.fill(&WHITE)?;
    let (area, margin) = canvas.split_horizontally(SIZE.0);
    if named {
        draw_legend(&margin, &names)?;
    }
    let mut chart = ChartBuilder::on(&area)
        .caption(&curve.title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(48)
        .y_label_area_size(84)
        .build_cartesian_2d(x, y)?;
    let number = |value: &f64| short(*value);
    chart
        .configure_mesh()
        .x_desc(x_label)
        .y_desc(y_label)
        .label_style(("sans-serif", 14))
        .axis_desc_style(("sans-serif", 15))
        .light_line_style(RGBColor(240, 240, 240))
        .x_label_formatter(&number)
        .y_label_formatter(&number)
        .draw()?;
    for (number, line) in lines.iter().enumerate() {
        let color = color_of(number);
        let points = || line.points.iter().map(|point| (point.x, point.y));
        chart.draw_series(LineSeries::new(points(), color.stroke_width(2)))?;
        let bars = line
            .points
            .iter()
            .filter_map(|point| Some((point.x, point.y, point.uncertainty.filter(|_| !curve.error)?)));
        chart.draw_series(bars.map(|(x, y, u)| PathElement::new([(x, y - u), (x, y + u)], color)))?;
        // White below the rings of points that are not at rest.
        chart.draw_series(points().map(|point| Circle::new(point, 4, WHITE.filled())))?;
        let style = |point: &Point| if point.is_at_rest { color.filled() } else { color.stroke_width(2) };
        chart.draw_series(line.points.iter().map(|point| Circle::new((point.x, point.y), 4, style(point))))?;
        chart.draw_series(DashedLineSeries::new(line.reference.iter().copied(), 6, 4, color.into()))?;
    }
    canvas.present()
}

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, study};
    use super::*;

    #[test]
    fn what_is_not_at_rest_has_hollow_points() {
        let study = study("[[axis]]\nkey = 'dx'\nvalues = [1, 2, 3]\n[[report.curve]]\nx = 'dx'\ny = 'm'\n");
        let mut results = complete(&study, |run| run.index as f64);
        let hollow = |results: &[RunResult]| {
            let text = svg(&study.report.curves[0], results).unwrap().unwrap();
            text.matches("<circle").count()
                - text.lines().filter(|line| line.contains("<circle") && !line.contains("fill=\"none\"")).count()
        };
        assert_eq!(hollow(&results), 0);
        super::super::mock::set_moving(&mut results[1], 0.5);
        assert_eq!(hollow(&results), 1);
        assert_eq!(lines(&study.report.curves[0], &results)[0].points.iter().filter(|p| !p.is_at_rest).count(), 1);
    }

    #[test]
    fn no_line_joins_runs_that_differ_in_more_than_x() {
        let study = study(
            "[[axis]]\nkey = 'x'\nvalues = [1, 2]\n[[axis]]\nkey = 'slip'\nvalues = [3, 4]\n[[axis]]\nkey = 'dx'\nvalues = [5, 6]\n\
             [[report.curve]]\nx = 'x'\ny = 'm'\nseries = 'slip'\n",
        );
        let found = lines(&study.report.curves[0], &complete(&study, |run| run.index as f64));
        let names: Vec<&str> = found.iter().map(|line| line.name.as_str()).collect();
        assert_eq!(names, ["slip = 3, dx = 5", "slip = 3, dx = 6", "slip = 4, dx = 5", "slip = 4, dx = 6"]);
        assert!(found.iter().all(|line| line.points.len() == 2));
    }

    #[test]
    fn a_line_per_value_of_the_series_with_what_it_should_be() {
        let study = study(
            "[[axis]]\nname = 'angle'\nkey = 'a'\nvalues = [30, 60]\n[[axis]]\nkey = 'dx'\nvalues = [0.2, 0.1, 0.0]\n\
             [[report.curve]]\nx = 'dx'\ny = 'm'\nseries = 'angle'\nreference = 'angle'\nx-scale = 'logarithmic'\n\
             [[report.curve]]\nx = 'dx'\ny = 'm'\nseries = 'angle'\nreference = 'angle'\nerror = true\n\
             x-scale = 'logarithmic'\ny-scale = 'logarithmic'\n",
        );
        let results = complete(&study, |run| {
            run.quantity(&Quantity::Parameter("angle".into())).unwrap()
                + run.quantity(&Quantity::Parameter("dx".into())).unwrap().powi(2)
        });
        let found = lines(&study.report.curves[0], &results);
        // The spacing 0 cannot be shown on a logarithmic axis.
        assert_eq!(found.len(), 2);
        assert_eq!((found[1].name.as_str(), found[1].points.len()), ("angle = 60", 2));
        assert_eq!(found[1].reference, [(0.1, 60.0), (0.2, 60.0)]);
        let text = svg(&study.report.curves[1], &results).unwrap().unwrap();
        assert!(text.starts_with("<svg") && text.matches("order 2.00").count() == 2, "{text}");
        assert!(text.contains("|m − angle| in deg") && !text.contains("NaN"));
        assert_eq!(svg(&study.report.curves[0], &[]).unwrap(), None);
    }
}
