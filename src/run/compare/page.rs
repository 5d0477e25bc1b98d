//! The page of a comparison: one HTML file without external resources.

use std::fmt::Write;

use super::comparison::{Comparison, Side};
use crate::run::pressure_curves::{LABELS, TITLE};
use meniscus_core::diagram::{Diagram, Stroke, Trace};
use meniscus_output::diagram;
use meniscus_output::html::{self, escaped};

/// The page as HTML.
pub(crate) fn page(comparison: &Comparison) -> String {
    let [network, direct] = comparison.titles.each_ref().map(|title| escaped(title));
    let mut html =
        format!("<h1>Network and direct simulation</h1>\n<p>Network: {network}.<br>Direct simulation: {direct}.</p>\n");
    html += &table(comparison);
    html += &warnings(comparison);
    for diagram in diagrams(comparison) {
        let _ = writeln!(html, "<h2>{}</h2>", diagram.title);
        html += &match diagram::svg(&diagram) {
            Ok(svg) => svg.unwrap_or_else(|| "<p>There is no pressure to show.</p>".to_owned()),
            Err(error) => format!("<p>{}</p>", escaped(&error.to_string())),
        };
    }
    html += "\n<h2>At equal saturation</h2>\n<p>Network on the left, direct simulation on the right.</p>\n";
    for at in &comparison.at_equal_saturation {
        let [one, other] = at.saturation;
        // Writing to a string cannot fail.
        let _ = writeln!(
            html,
            "<figure>{}<figcaption>Saturation of the wetting phase {one:.3} and {other:.3}; overlap of the invaded areas {:.3}</figcaption></figure>",
            at.picture, at.overlap
        );
    }
    html::page(&comparison.titles[1], &html)
}

fn table(comparison: &Comparison) -> String {
    let number = |value: Option<f64>| value.map_or("not measured".to_owned(), |value| format!("{value:.4e}"));
    let fraction = |value: Option<f64>| value.map_or("not measured".to_owned(), |value| format!("{value:.3}"));
    let seconds = |value: Option<f64>| value.map_or("not measured".to_owned(), |value| format!("{value:.2}"));
    let both = [&comparison.network, &comparison.direct];
    let row = |name: &str, cells: [String; 2]| {
        format!("<tr><th>{name}</th><td>{}</td><td>{}</td></tr>\n", cells[0], cells[1])
    };
    let of = |value: &dyn Fn(&Side) -> String| both.map(value);
    let first = match comparison.is_in_time {
        true => row("breakthrough time in s", of(&|side| number(side.breakthrough_time_s))),
        false => row("breakthrough pressure in Pa", of(&|side| number(side.breakthrough_pressure_pa))),
    };
    let rows = [
        first,
        row("saturation at breakthrough", of(&|side| fraction(side.saturation_at_breakthrough))),
        row("permeability along x in m&sup2;", of(&|side| number(side.permeability_m2))),
        row("pores; particles", of(&|side| side.unknowns.to_string())),
        row("events; time steps", of(&|side| side.steps.to_string())),
        row("wall time in s", of(&|side| format!("{:.2}", side.wall_time_s))),
        row("processor time in s", of(&|side| seconds(side.processor_time_s))),
    ];
    let missing: String = ["network", "direct simulation"]
        .into_iter()
        .zip(both)
        .filter_map(|(name, side)| {
            Some(format!("<p>No breakthrough of the {name}: {}.</p>\n", side.no_breakthrough.as_ref()?))
        })
        .collect();
    format!(
        "<table>\n<tr><th></th><th>network</th><th>direct simulation</th></tr>\n{}</table>\n{missing}<p>Rank correlation of the order in which {} \
         elements were filled: {}. Overlap of the invaded areas, mean over all records: {}.</p>\n",
        rows.concat(),
        comparison.elements_in_both,
        fraction(comparison.rank_correlation),
        fraction(comparison.mean_overlap)
    )
}

/// What a reader must know before trusting either.
fn warnings(comparison: &Comparison) -> String {
    let of = |name: &str, side: &Side| -> String {
        side.warnings.iter().map(|warning| format!("<li>{name}: {}</li>\n", escaped(warning))).collect()
    };
    let all = of("network", &comparison.network) + &of("direct simulation", &comparison.direct);
    if all.is_empty() { all } else { format!("<h2>Warnings</h2>\n<ul>\n{all}</ul>\n") }
}

/// Both curves in common axes: capillary pressure over saturation; of displacements in time, saturation over time, and the pressure difference over time and
/// over saturation.
pub(crate) fn diagrams(comparison: &Comparison) -> Vec<Diagram> {
    if comparison.is_in_time { in_time(comparison) } else { vec![quasi_static(comparison)] }
}

fn trace(name: &str, points: Vec<[f64; 2]>) -> Trace {
    Trace { name: name.to_owned(), stroke: Stroke::Full, points }
}

/// Pairs for which there is a pressure.
fn known(over: &[f64], pressures: &[Option<f64>]) -> Vec<[f64; 2]> {
    over.iter().zip(pressures).filter_map(|(over, pressure)| Some([*over, (*pressure)?])).collect()
}

fn quasi_static(comparison: &Comparison) -> Diagram {
    let points = |side: &Side| known(&side.saturation, &side.capillary_pressure_pa);
    // In the network, the pressure rises at constant saturation, and the saturation changes at constant pressure.
    let network = points(&comparison.network);
    let first = comparison.network.saturation.first().copied();
    let before = first.into_iter().chain(network.iter().map(|point| point[0]));
    let stairs = network.iter().zip(before).flat_map(|(point, before)| [[before, point[1]], *point]).collect();
    let traces = vec![trace("network", stairs), trace("direct simulation", points(&comparison.direct))];
    Diagram::linear("compare", TITLE, LABELS, traces)
}

fn in_time(comparison: &Comparison) -> Vec<Diagram> {
    let (time, pressure) = ("time (s)", "pressure at the inlet less that at the outlet (Pa)");
    let both = |points: &dyn Fn(&Side) -> Vec<[f64; 2]>| {
        vec![trace("network", points(&comparison.network)), trace("direct simulation", points(&comparison.direct))]
    };
    vec![
        Diagram::linear(
            "compare",
            "Pressure difference over saturation",
            [LABELS[0], pressure],
            both(&|side| known(&side.saturation, &side.pressure_difference_pa)),
        ),
        Diagram::linear(
            "compare-saturation",
            "Saturation over time",
            [time, LABELS[0]],
            both(&|side| side.time_s.iter().zip(&side.saturation).map(|(time, s)| [*time, *s]).collect()),
        ),
        Diagram::linear(
            "compare-pressure",
            "Pressure difference over time",
            [time, pressure],
            both(&|side| known(&side.time_s, &side.pressure_difference_pa)),
        ),
    ]
}
