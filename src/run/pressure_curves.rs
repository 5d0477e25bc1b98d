//! The capillary pressure curves of several network runs in one diagram, read from their files.

use std::path::{Path, PathBuf};

use meniscus_core::diagram::{Axis, Diagram, Stroke, Trace};
use meniscus_output::diagram::{DiagramError, svg};

/// Name of the diagram: its file is `capillary-pressure.svg`.
pub(crate) const NAME: &str = "capillary-pressure";
/// Its title, and what is along x and y.
pub(crate) const TITLE: &str = "Capillary pressure over saturation";
pub(crate) const LABELS: [&str; 2] = ["saturation of the wetting phase", "capillary pressure p_n - p_w (Pa)"];
/// With films, the curve at every pressure.
const CURVE: &str = "capillary_pressure.csv";
/// Otherwise saturations change only at events.
const EVENTS: &str = "events.csv";

/// A point of a curve: the half cycle, the wetting saturation and p_n - p_w in Pa; no pressure at the start of a half cycle.
#[derive(Debug, Clone, Copy, serde::Deserialize)]
struct Row {
    half_cycle: usize,
    saturation: f64,
    #[serde(rename = "capillary_pressure_Pa")]
    pressure: Option<f64>,
}

/// A run whose curve is drawn with those of others.
#[derive(Debug, Clone)]
pub(crate) struct Overlaid {
    /// Its name in the legend.
    pub(crate) name: String,
    /// The number by which it differs from the others, if it is one alone.
    pub(crate) number: Option<f64>,
    /// Its folder.
    pub(crate) folder: PathBuf,
}

/// The curves of the runs as SVG, with names that give `names_give`, or colored by their numbers, whose quantity is `shades`; `None` if no run has one.
pub(crate) fn overlay(
    runs: &[Overlaid],
    names_give: String,
    shades: &dyn Fn(&[f64]) -> Axis,
) -> Result<Option<String>, DiagramError> {
    let trace = |run: &Overlaid| {
        Some((run.number, Trace { name: run.name.clone(), stroke: Stroke::Full, points: curve(&run.folder)? }))
    };
    let (numbers, traces): (Vec<Option<f64>>, Vec<Trace>) = runs.iter().filter_map(trace).unzip();
    if traces.is_empty() {
        return Ok(None);
    }
    let diagram = Diagram { names_give, ..Diagram::linear(NAME, TITLE, LABELS, traces) };
    match numbers.into_iter().collect::<Option<Vec<f64>>>() {
        Some(numbers) => svg(&diagram.shaded_if_many(shades(&numbers), numbers)),
        None => svg(&diagram),
    }
}

/// The curve of the quasi-static displacement in a folder, half cycles joined.
fn curve(folder: &Path) -> Option<Vec<[f64; 2]>> {
    let rows = |name: &str| -> Option<Vec<Row>> {
        csv::Reader::from_path(folder.join(name)).ok()?.into_deserialize().collect::<Result<_, _>>().ok()
    };
    let points = match rows(CURVE) {
        Some(rows) => rows.iter().filter_map(|row| Some([row.saturation, row.pressure?])).collect(),
        None => staircase(&rows(EVENTS)?),
    };
    Some(points).filter(|points| !points.is_empty())
}

/// The pressure changes at constant saturation, and the saturation at constant pressure.
fn staircase(rows: &[Row]) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut before: Option<Row> = None;
    for row in rows {
        if let Some(pressure) = row.pressure {
            // After a reversal, what is open at the inlet fills at the first pressure.
            let turned = before.filter(|before| before.pressure.is_none() && before.half_cycle > 1);
            let end = points.last().copied().filter(|_| turned.is_some());
            points.extend(end.map(|end| [end[0], pressure]));
            points.extend(before.map(|before| [before.saturation, pressure]));
            points.push([row.saturation, pressure]);
        }
        before = Some(*row);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_cycles_are_joined_stairs_and_each_run_has_its_line() {
        let folder = tempfile::tempdir().unwrap();
        let text = "half_cycle,event,saturation,capillary_pressure_Pa\n1,beginning,1,\n1,burst,0.5,10\n1,burst,0.25,20\n\
                    2,beginning,0.375,\n2,burst,0.75,5\n";
        std::fs::write(folder.path().join(EVENTS), text).unwrap();
        let stairs = [[1.0, 10.0], [0.5, 10.0], [0.5, 20.0], [0.25, 20.0], [0.25, 5.0], [0.375, 5.0], [0.75, 5.0]];
        assert_eq!(curve(folder.path()).unwrap(), stairs);
        let empty = tempfile::tempdir().unwrap();
        let runs = [(40.0, &folder), (60.0, &empty)].map(|(angle, it)| Overlaid {
            name: format!("angle = {angle}"),
            number: Some(angle),
            folder: it.path().to_owned(),
        });
        let shades = |_: &[f64]| Axis::linear("angle (degrees)");
        let drawn = overlay(&runs, String::new(), &shades).unwrap().unwrap();
        assert!(drawn.contains("angle = 40") && !drawn.contains("angle = 60"));
        assert_eq!(overlay(&runs[1..], String::new(), &shades).unwrap(), None);
        let many = overlay(&vec![runs[0].clone(); 30], String::new(), &shades).unwrap().unwrap();
        assert!(many.contains("angle (degrees)") && !many.contains("angle = 40"));
    }
}
