//! The curves of a study as SVG: measures or errors over a parameter, one line per value of another parameter.

use super::definition::{Curve, Quantity};
use super::raw::RawScale;
use super::results::{RunResult, measures};
use super::values::shown;
use meniscus_core::diagram::{Axis, Diagram, Stroke, Trace};
use meniscus_geometry::analysis::convergence::observed_order;
use meniscus_output::diagram::{DiagramError, Layout, svg_with};

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
    pub reference: Vec<[f64; 2]>,
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
            lines[index].reference.push([x, reference]);
        }
    }
    for line in &mut lines {
        line.points.sort_by(|a, b| a.x.total_cmp(&b.x));
        line.reference.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    lines.retain(|line| !line.points.is_empty());
    lines
}

/// Draws a curve; `None` if there is no point yet.
pub(crate) fn svg(curve: &Curve, results: &[RunResult]) -> Result<Option<String>, DiagramError> {
    let lines = lines(curve, results);
    let axis = |label: String, scale| Axis { label: label.into(), logarithmic: scale == RawScale::Logarithmic };
    let diagram = Diagram {
        name: "curve",
        title: curve.title.clone().into(),
        x: axis(curve.x.clone(), curve.x_scale),
        y: axis(y_label(curve, results), curve.y_scale),
        map: None,
        traces: lines.iter().flat_map(|line| traces(curve, line)).collect(),
    };
    let layout = Layout { size: (720, 480), title: 20, x_labels: 11, x_ticks: distinct(&lines) };
    svg_with(&diagram, &layout)
}

/// A line with the error bars and marks of its points, and its reference.
fn traces(curve: &Curve, line: &Line) -> Vec<Trace> {
    let unnamed = |stroke, points| Trace { name: String::new(), stroke, points };
    let all: Vec<[f64; 2]> = line.points.iter().map(|point| [point.x, point.y]).collect();
    let mut traces = vec![Trace { name: legend(curve, line), stroke: Stroke::Full, points: all.clone() }];
    let bar = |point: &Point| {
        let uncertainty = point.uncertainty.filter(|_| !curve.error)?;
        Some(unnamed(Stroke::Bar, [-uncertainty, uncertainty].map(|u| [point.x, point.y + u]).to_vec()))
    };
    traces.extend(line.points.iter().filter_map(bar));
    // White below the rings of points that are not at rest.
    traces.push(unnamed(Stroke::Blank, all));
    let mark =
        |point: &Point| unnamed(if point.is_at_rest { Stroke::Disc } else { Stroke::Ring }, vec![[point.x, point.y]]);
    traces.extend(line.points.iter().map(mark));
    traces.push(unnamed(Stroke::Reference, line.reference.clone()));
    traces
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

#[cfg(test)]
mod tests {
    use super::super::mock::{complete, number, study};
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
        let results = complete(&study, |run| number(run, "angle") + number(run, "dx").powi(2));
        let found = lines(&study.report.curves[0], &results);
        // The spacing 0 cannot be shown on a logarithmic axis.
        assert_eq!(found.len(), 2);
        assert_eq!((found[1].name.as_str(), found[1].points.len()), ("angle = 60", 2));
        assert_eq!(found[1].reference, [[0.1, 60.0], [0.2, 60.0]]);
        let text = svg(&study.report.curves[1], &results).unwrap().unwrap();
        assert!(text.starts_with("<svg") && text.matches("order 2.00").count() == 2, "{text}");
        assert!(text.contains("|m − angle| in deg") && !text.contains("NaN"));
        assert_eq!(svg(&study.report.curves[0], &[]).unwrap(), None);
    }
}
