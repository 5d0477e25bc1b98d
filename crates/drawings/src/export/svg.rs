//! SVG in mm: circles as `circle`, all others as `path` with arcs; the y axis points down there, so that y changes its sign.

use std::fmt::Write;

use super::sheet::Sheet;
use crate::import::drawing::{Outline, Ring};
use meniscus_geometry::curve::Curve;

/// Millimeters per meter.
const MM: f64 = 1e3;

pub(super) fn svg(sheet: &Sheet) -> String {
    let (min, size) = (sheet.frame.min * MM, sheet.frame.size() * MM);
    let top = -sheet.frame.max.y * MM;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"{2} {top} {0} {1}\">\n<g fill=\"#444\" fill-rule=\"evenodd\">\n",
        size.x, size.y, min.x
    );
    for outline in &sheet.outlines {
        // Writing to a string cannot fail.
        let _ = match outline {
            Outline::Disc { center, radius } => {
                writeln!(text, "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>", center.x * MM, -center.y * MM, radius * MM)
            }
            Outline::Area { rings, .. } => {
                writeln!(text, "<path d=\"{}\"/>", rings.iter().map(path).collect::<Vec<_>>().join(" "))
            }
        };
    }
    text + "</g>\n</svg>\n"
}

fn path(ring: &Ring) -> String {
    let Some(&[x, y, _]) = ring.vertices.first() else { return String::new() };
    let mut text = format!("M{} {}", x * MM, -y * MM);
    for (i, &[x0, y0, bulge]) in ring.vertices.iter().enumerate() {
        let [x1, y1, _] = ring.vertices[(i + 1) % ring.vertices.len()];
        let (x, y) = (x1 * MM, -y1 * MM);
        let curve = Curve::from_bulge([x0, y0].into(), [x1, y1].into(), bulge);
        let _ = match curve {
            Curve::Segment { .. } => write!(text, " L{x} {y}"),
            Curve::Arc { radius, sweep, .. } => {
                let large = u8::from(sweep.abs() > std::f64::consts::PI);
                // With y pointing down, positive angles are clockwise.
                let turn = u8::from(sweep < 0.0);
                write!(text, " A{0} {0} 0 {large} {turn} {x} {y}", radius * MM)
            }
        };
    }
    text + " Z"
}
