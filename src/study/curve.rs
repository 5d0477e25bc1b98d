//! The curves of a study as SVG: measures or errors over a parameter, one line per value of another parameter.

use super::apart::Apart;
use super::definition::{Curve, Quantity};
use super::raw::RawScale;
use super::results::RunResult;
use super::values::{ascending, is_geometric, number_of};
use super::wording::Wording;
use meniscus_core::diagram::{Axis, Diagram, Stroke, Trace};
use meniscus_core::label::Label;
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
    /// The first number that separates it from others, if it is one.
    pub number: Option<f64>,
    /// Points by increasing x.
    pub points: Vec<Point>,
    /// Reference values of y, by increasing x.
    pub reference: Vec<[f64; 2]>,
}

/// The parameters whose values separate the lines of a curve: its series and, if a line would have two values at one x, others that vary.
fn series(curve: &Curve, results: &[RunResult]) -> Vec<String> {
    let names = curve.series.iter().cloned().collect();
    let is_parameter = results.iter().any(|result| result.run.value(&curve.x).is_some());
    // Over a measure, equal runs are not on one point.
    if is_parameter { Apart { shown: &[&curve.x], results }.names(names, |_| true) } else { names }
}

/// The lines of a curve, from runs that have the values; points that a logarithmic scale cannot show are left out.
pub(crate) fn lines(curve: &Curve, results: &[RunResult]) -> Vec<Line> {
    let series = series(curve, results);
    let mut lines: Vec<Line> = Vec::new();
    let fits = |scale, value: f64| value.is_finite() && (scale == RawScale::Linear || value > 0.0);
    for result in results {
        let name = result.run.plain_values(&series);
        let number = series.first().and_then(|name| result.run.value(name)).and_then(number_of);
        let (Some(x), Some(y)) = (result.number(&curve.x), result.number(&curve.y)) else { continue };
        let reference = curve.reference.as_ref().and_then(|reference| result.run.quantity(reference));
        let shown_y = if curve.error { (y - reference.unwrap_or(0.0)).abs() } else { y };
        let index = lines.iter().position(|line| line.name == name).unwrap_or_else(|| {
            lines.push(Line { name, number, points: Vec::new(), reference: Vec::new() });
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
pub(crate) fn svg(curve: &Curve, results: &[RunResult], wording: &Wording) -> Result<Option<String>, DiagramError> {
    let lines = lines(curve, results);
    let axis =
        |label: Label, scale| Axis { label: label.to_string().into(), logarithmic: scale == RawScale::Logarithmic };
    let axes = [axis(wording.label(&curve.x), curve.x_scale), axis(y_label(curve, wording), curve.y_scale)];
    let traces = lines.iter().flat_map(|line| traces(curve, line)).collect();
    let series = series(curve, results);
    let names_give = wording.labels(&series);
    let diagram = Diagram { names_give, ..Diagram::new("curve", title(curve, wording), axes, traces) };
    let diagram = match &series[..] {
        [name] if !shows_orders(curve) => shaded(diagram, wording.label(name), &lines),
        _ => diagram,
    };
    let x_positions = lines.iter().flat_map(|line| line.points.iter().map(|point| point.x)).collect();
    svg_with(&diagram, &Layout { size: (720, 480), title: 20, x_positions })
}

/// The same with lines colored by the number of their series where they are many.
fn shaded(diagram: Diagram, label: Label, lines: &[Line]) -> Diagram {
    match lines.iter().map(|line| line.number).collect::<Option<Vec<f64>>>() {
        Some(numbers) => diagram.shaded_if_many(shades_axis(&label, &numbers), numbers),
        None => diagram,
    }
}

/// The quantity of a scale of colors for the numbers of lines.
pub(crate) fn shades_axis(label: &Label, numbers: &[f64]) -> Axis {
    Axis { label: label.to_string().into(), logarithmic: is_geometric(&ascending(numbers.iter().copied())) }
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

fn y_label(curve: &Curve, wording: &Wording) -> Label {
    let y = wording.label(&curve.y);
    let of = |words: &str| match &curve.reference {
        Some(Quantity::Parameter(name)) => format!("|{words} − {}|", Label::of(name, None).words),
        Some(Quantity::Number(number)) if *number != 0.0 => format!("|{words} − {number}|"),
        _ => format!("|{words}|"),
    };
    if curve.error { y.in_words(of(&y.words)) } else { y }
}

/// The title: the words of y and x if none is given.
fn title(curve: &Curve, wording: &Wording) -> String {
    let [x, y] = [&curve.x, &curve.y].map(|name| wording.label(name).words);
    let default = || if curve.error { format!("error of {y} over {x}") } else { format!("{y} over {x}") };
    curve.title.clone().unwrap_or_else(default)
}

/// Whether the scales show a power law as a straight line, whose order or slope is then in the legend.
fn shows_orders(curve: &Curve) -> bool {
    curve.x_scale == RawScale::Logarithmic && curve.y_scale == RawScale::Logarithmic
}

/// The name of a line in the legend, with the observed order or slope if the scales show it.
fn legend(curve: &Curve, line: &Line) -> String {
    let counted = line.points.iter().filter(|point| !point.is_rounding);
    let (x, y): (Vec<f64>, Vec<f64>) = counted.map(|point| (point.x, point.y)).unzip();
    let order = observed_order(&x, &y);
    let word = if curve.error { "order" } else { "slope" };
    let order = (shows_orders(curve) && order.is_finite()).then(|| format!("{word} {order:.2}"));
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
            let text = svg(&study.report.curves[0], results, &Wording::default()).unwrap().unwrap();
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
        assert_eq!(names, ["3, 5", "3, 6", "4, 5", "4, 6"]);
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
        assert_eq!((found[1].name.as_str(), found[1].points.len()), ("60", 2));
        assert_eq!(found[1].reference, [[0.1, 60.0], [0.2, 60.0]]);
        let text = svg(&study.report.curves[1], &results, &Wording::of(&study, &results)).unwrap().unwrap();
        assert!(text.starts_with("<svg") && text.matches("order 2.00").count() == 2, "{text}");
        assert!(text.contains("|m − angle| (degrees)") && !text.contains("NaN"));
        assert_eq!(svg(&study.report.curves[0], &[], &Wording::default()).unwrap(), None);
    }

    #[test]
    fn thirty_lines_have_a_bar_and_thirty_of_words_have_names() {
        let values = (0..30).map(|k| format!("{}", 20 + 2 * k)).collect::<Vec<_>>().join(", ");
        let words = (0..30).map(|k| format!("'word {k}'")).collect::<Vec<_>>().join(", ");
        let drawn = |values: &str| {
            let study = study(&format!(
                "[[axis]]\nname = 'angle'\nkey = 'network.wetting.young.contact-angle-deg'\nvalues = [{values}]\n\
                 [[axis]]\nkey = 'x'\nvalues = [1, 2, 3]\n[[report.curve]]\nx = 'x'\ny = 'm'\nseries = 'angle'\n"
            ));
            let results = complete(&study, |run| run.index as f64);
            svg(&study.report.curves[0], &results, &Wording::of(&study, &results)).unwrap().unwrap()
        };
        let (bar, names) = (drawn(&values), drawn(&words));
        assert!(bar.contains("contact angle (degrees)") && !bar.lines().any(|line| line.trim() == "22"), "{bar}");
        assert!((0..30).all(|k| names.lines().any(|line| line.trim() == format!("word {k}"))), "{names}");
    }
}
