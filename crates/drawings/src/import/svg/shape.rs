//! The shapes of SVG: the pieces of a `rect`, `circle`, `ellipse`, `polygon`, `polyline`, `line` or `path`.

use roxmltree::Node;
use svgtypes::PointsParser;

use super::page::{Along, Viewport};
use super::path::{self, Subpath};
use crate::import::contour::{EllipticArc, Piece};
use meniscus_core::math::Vec2;

/// The elements that are shapes.
pub(crate) const SHAPES: [&str; 7] = ["rect", "circle", "ellipse", "polygon", "polyline", "line", "path"];

/// The contours of a shape in its own coordinates, empty if it is not drawn. On a mistake, what was found.
pub(crate) fn contours(node: Node, viewport: Viewport) -> Result<Vec<Subpath>, String> {
    let length = |name: &str, along| Ok::<_, String>(viewport.length(node, name, along)?.unwrap_or(0.0));
    let size = |name: &str, along| match viewport.length(node, name, along)? {
        Some(value) if value < 0.0 => Err(format!("{name}=\"{value}\"")),
        value => Ok(value),
    };
    let ellipse = |rx: f64, ry: f64| {
        let center = Vec2::new(length("cx", Along::X)?, length("cy", Along::Y)?);
        let radii = [Vec2::new(rx, 0.0), Vec2::new(0.0, ry)];
        let arc = EllipticArc::new(center, radii, 0.0, std::f64::consts::TAU);
        Ok(if rx > 0.0 && ry > 0.0 { closed(vec![Piece::Ellipse(arc)]) } else { Vec::new() })
    };
    let subpaths = match node.tag_name().name() {
        "circle" => {
            let radius = size("r", Along::Diagonal)?.unwrap_or(0.0);
            ellipse(radius, radius)
        }
        "ellipse" => {
            // SVG 2: a single radius applies to both.
            let (rx, ry) = (size("rx", Along::X)?, size("ry", Along::Y)?);
            ellipse(rx.or(ry).unwrap_or(0.0), ry.or(rx).unwrap_or(0.0))
        }
        "rect" => {
            let (rx, ry) = (size("rx", Along::X)?, size("ry", Along::Y)?);
            let [width, height] = [size("width", Along::X)?, size("height", Along::Y)?].map(|side| side.unwrap_or(0.0));
            let corner = Vec2::new(length("x", Along::X)?, length("y", Along::Y)?);
            let radii =
                Vec2::new(rx.or(ry).unwrap_or(0.0).min(0.5 * width), ry.or(rx).unwrap_or(0.0).min(0.5 * height));
            let is_drawn = width > 0.0 && height > 0.0;
            Ok(if is_drawn { closed(rectangle(corner, Vec2::new(width, height), radii)) } else { Vec::new() })
        }
        "line" => {
            let ends = [
                Vec2::new(length("x1", Along::X)?, length("y1", Along::Y)?),
                Vec2::new(length("x2", Along::X)?, length("y2", Along::Y)?),
            ];
            Ok(vec![Subpath { pieces: vec![Piece::Line(ends)], is_closed: false }])
        }
        name @ ("polygon" | "polyline") => points(node, name == "polygon"),
        _ => match node.attribute("d").map(str::trim) {
            None | Some("" | "none") => Ok(Vec::new()),
            Some(data) => path::subpaths(data),
        },
    }?;
    let is_in_range = subpaths.iter().flat_map(|subpath| &subpath.pieces).all(Piece::is_in_range);
    if is_in_range { Ok(subpaths) } else { Err("a coordinate out of range".to_owned()) }
}

fn closed(pieces: Vec<Piece>) -> Vec<Subpath> {
    vec![Subpath { pieces, is_closed: true }]
}

fn points(node: Node, is_polygon: bool) -> Result<Vec<Subpath>, String> {
    let text = node.attribute("points").unwrap_or_default();
    let points: Vec<Vec2> = PointsParser::from(text).map(|(x, y)| Vec2::new(x, y)).collect();
    // The parser stops at the first error and drops half a point.
    let numbers = text.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty()).count();
    if points.len() * 2 < numbers {
        return Err(format!("points=\"...\" with {} points and something else behind", points.len()));
    }
    let pieces: Vec<Piece> = points.windows(2).map(|pair| Piece::Line([pair[0], pair[1]])).collect();
    let is_closed = is_polygon || (points.len() > 2 && points.first() == points.last());
    Ok(if pieces.is_empty() { Vec::new() } else { vec![Subpath { pieces, is_closed }] })
}

/// A rectangle whose corners are quarters of an ellipse.
fn rectangle(corner: Vec2, size: Vec2, radii: Vec2) -> Vec<Piece> {
    let [x0, y0, x1, y1] = [corner.x, corner.y, corner.x + size.x, corner.y + size.y];
    if !(radii.x > 0.0 && radii.y > 0.0) {
        let points = [Vec2::new(x0, y0), Vec2::new(x1, y0), Vec2::new(x1, y1), Vec2::new(x0, y1)];
        return (0..4).map(|i| Piece::Line([points[i], points[(i + 1) % 4]])).collect();
    }
    let axes = [Vec2::new(radii.x, 0.0), Vec2::new(0.0, radii.y)];
    let centers = [
        Vec2::new(x1 - radii.x, y0 + radii.y),
        Vec2::new(x1 - radii.x, y1 - radii.y),
        Vec2::new(x0 + radii.x, y1 - radii.y),
        Vec2::new(x0 + radii.x, y0 + radii.y),
    ];
    let quarter = std::f64::consts::FRAC_PI_2;
    let corners = [0, 1, 2, 3].map(|i| EllipticArc::new(centers[i], axes, quarter * (i as f64 - 1.0), quarter));
    let mut pieces = Vec::with_capacity(8);
    for i in 0..4 {
        pieces.push(Piece::Ellipse(corners[i]));
        pieces.push(Piece::Line([corners[i].ends[1], corners[(i + 1) % 4].ends[0]]));
    }
    pieces
}
