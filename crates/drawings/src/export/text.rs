//! Text formats in m: well-known text, GeoJSON, lists of discs, TOML shape files.

use std::fmt::Write;

use serde_json::json;

use super::error::ExportError;
use super::sheet::{Sheet, rings_of, sampled};
use crate::import::drawing::{Outline, Ring};
use meniscus_geometry::spec::{Disc, GeometrySpec, ShapeSpec, SolidSide};
use meniscus_geometry::validate::ring_area;

/// Maximum distance of chords from arcs over the radius: 100 vertices on a circle.
const CHORD: f64 = 5e-4;

fn domain(sheet: &Sheet) -> String {
    let (min, max) = (sheet.frame.min, sheet.frame.max);
    format!("# domain {} {} {} {}\n", min.x, min.y, max.x, max.y)
}

/// A ring as points, closed by repeating the first, counter-clockwise if it is an outer one.
fn closed(ring: &Ring, is_outer: bool) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = sampled(ring, CHORD).into_iter().map(Into::into).collect();
    if (ring_area(&points) > 0.0) != is_outer {
        points.reverse();
    }
    points.extend(points.first().copied());
    points
}

/// The polygons of a sheet, outer ring first. A solid with several components (all around a pore, say) gives one polygon each.
fn polygons(sheet: &Sheet) -> Vec<Vec<Vec<[f64; 2]>>> {
    let mut found = Vec::new();
    for outline in &sheet.outlines {
        // Solid lies on the left of every ring, so that outer ones run counter-clockwise.
        let rings: Vec<Vec<[f64; 2]>> = rings_of(outline)
            .iter()
            .map(|ring| {
                let is_outer = ring_area(&sampled(ring, CHORD).into_iter().map(Into::into).collect::<Vec<_>>()) > 0.0;
                closed(ring, is_outer)
            })
            .collect();
        let (outer, holes): (Vec<_>, Vec<_>) = rings.into_iter().partition(|ring| ring_area(ring) > 0.0);
        let first = found.len();
        found.extend(outer.into_iter().map(|ring| vec![ring]));
        for hole in holes {
            // The smallest outer ring around it.
            let around = (first..found.len())
                .filter(|&k| hole.first().is_some_and(|&p| contains(&found[k][0], p)))
                .min_by(|&a, &b| ring_area(&found[a][0]).total_cmp(&ring_area(&found[b][0])));
            if let Some(k) = around.or((first < found.len()).then_some(first)) {
                found[k].push(hole);
            }
        }
    }
    found
}

/// Whether a ray from `p` crosses the closed ring an odd number of times.
fn contains(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let passes = |w: &[[f64; 2]]| {
        let ([x0, y0], [x1, y1]) = (w[0], w[1]);
        (y0 > y) != (y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)
    };
    ring.windows(2).filter(|w| passes(w)).count() % 2 == 1
}

pub(super) fn well_known_text(sheet: &Sheet) -> String {
    let mut text = domain(sheet);
    let point = |[x, y]: &[f64; 2]| format!("{x} {y}");
    let ring = |points: &Vec<[f64; 2]>| format!("({})", points.iter().map(point).collect::<Vec<_>>().join(", "));
    for polygon in polygons(sheet) {
        let rings = polygon.iter().map(ring).collect::<Vec<_>>().join(", ");
        // Writing to a string cannot fail.
        let _ = writeln!(text, "POLYGON ({rings})");
    }
    text
}

pub(super) fn geojson(sheet: &Sheet) -> Result<String, ExportError> {
    let (min, max) = (sheet.frame.min, sheet.frame.max);
    let features: Vec<serde_json::Value> = polygons(sheet)
        .into_iter()
        .map(
            |rings| json!({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": rings}}),
        )
        .collect();
    let all = json!({
        "type": "FeatureCollection",
        "unit": "m",
        "domain": [min.x, min.y, max.x, max.y],
        "features": features,
    });
    serde_json::to_string(&all).map_err(|error| ExportError::Library(error.to_string()))
}

pub(super) fn discs(sheet: &Sheet) -> Result<String, ExportError> {
    let mut text = domain(sheet) + "# x y r in m\n";
    let mut others = 0;
    for outline in &sheet.outlines {
        match outline {
            Outline::Disc { center, radius } => {
                let _ = writeln!(text, "{} {} {radius}", center.x, center.y);
            }
            Outline::Area { .. } => others += 1,
        }
    }
    if others == 0 { Ok(text) } else { Err(ExportError::NoDisc { others, all: sheet.outlines.len() }) }
}

/// A shape file with one shape per line, and its depth in m if there is one.
pub(super) fn toml(spec: &GeometrySpec, depth: Option<f64>) -> Result<String, ExportError> {
    let pair = |[x, y]: [f64; 2]| format!("[{x:?}, {y:?}]");
    let mut text = format!("format = 1\nmin = {} # m\nmax = {}\n", pair(spec.min), pair(spec.max));
    if let Some(depth) = depth {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "depth = {depth:?} # from the floor to the lid");
    }
    if spec.solid == SolidSide::Outside {
        text += "solid = \"outside\"\n";
    }
    text += "shapes = [\n";
    for shape in &spec.shapes {
        let line = match shape {
            ShapeSpec::Disc(Disc { center, radius }) => {
                format!("{{ disc = {{ center = {}, radius = {radius:?} }} }}", pair(*center))
            }
            other => toml::Value::try_from(other).map_err(|error| ExportError::Library(error.to_string()))?.to_string(),
        };
        let _ = writeln!(text, "    {line},");
    }
    Ok(text + "]\n")
}
