//! The data of SVG paths: every command, relative and absolute; arcs by center and radii (SVG 1.1, F.6.5).
//!
//! The arc is our own: that of kurbo 0.13 treats radii below 1e-5 as straight lines, in any unit.

use svgtypes::{PathParser, PathSegment};

use crate::import::contour::{EllipticArc, Piece};
use meniscus_core::math::{Mat2, Vec2};
use meniscus_geometry::curve::cross;

/// Tolerance for a half turn: the center is the midpoint of the ends. Otherwise the square root of the rounding would displace it.
const HALF_TURN: f64 = 1e-13;

/// A subpath.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Subpath {
    /// Its consecutive pieces.
    pub(crate) pieces: Vec<Piece>,
    /// Whether it ends with the close command, or at its start.
    pub(crate) is_closed: bool,
}

/// The subpaths of path data; on a mistake, what was found.
pub(crate) fn subpaths(data: &str) -> Result<Vec<Subpath>, String> {
    let mut pen = Pen::default();
    for (number, segment) in PathParser::from(data).enumerate() {
        let segment = segment.map_err(|error| format!("path data, command {}: {error}", number + 1))?;
        pen.draw(segment).ok_or_else(|| format!("path data, command {}: a number out of range", number + 1))?;
    }
    Ok(pen.finish())
}

/// The state of drawing a path.
#[derive(Debug, Default)]
struct Pen {
    done: Vec<Subpath>,
    pieces: Vec<Piece>,
    start: Vec2,
    at: Vec2,
    /// The last control point of an immediately preceding cubic, and of a quadratic curve.
    cubic: Option<Vec2>,
    quadratic: Option<Vec2>,
}

impl Pen {
    /// Executes one command; `None` if a number is out of range.
    fn draw(&mut self, segment: PathSegment) -> Option<()> {
        let at = self.at;
        let point = |is_absolute: bool, x: f64, y: f64| Vec2::new(x, y) + if is_absolute { Vec2::zeros() } else { at };
        let (cubic, quadratic) = (self.cubic.take(), self.quadratic.take());
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                self.end_subpath(false);
                self.at = point(abs, x, y);
                self.start = self.at;
                crate::import::limits::is_in_range(self.at).then_some(())
            }
            PathSegment::ClosePath { .. } => {
                self.end_subpath(true);
                self.at = self.start;
                Some(())
            }
            PathSegment::LineTo { abs, x, y } => self.push(Piece::Line([at, point(abs, x, y)])),
            PathSegment::HorizontalLineTo { abs, x } => {
                self.push(Piece::Line([at, Vec2::new(point(abs, x, 0.0).x, at.y)]))
            }
            PathSegment::VerticalLineTo { abs, y } => {
                self.push(Piece::Line([at, Vec2::new(at.x, point(abs, 0.0, y).y)]))
            }
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                self.cubic(point(abs, x1, y1), point(abs, x2, y2), point(abs, x, y))
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                let first = cubic.map_or(at, |control| at * 2.0 - control);
                self.cubic(first, point(abs, x2, y2), point(abs, x, y))
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => self.quadratic(point(abs, x1, y1), point(abs, x, y)),
            PathSegment::SmoothQuadratic { abs, x, y } => {
                let control = quadratic.map_or(at, |control| at * 2.0 - control);
                self.quadratic(control, point(abs, x, y))
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let ends = [at, point(abs, x, y)];
                let arc = arc(ends, [rx, ry], x_axis_rotation, [large_arc, sweep]);
                self.push(arc.map_or(Piece::Line(ends), Piece::Ellipse))
            }
        }
    }

    fn cubic(&mut self, first: Vec2, second: Vec2, end: Vec2) -> Option<()> {
        self.cubic = Some(second);
        self.push(Piece::Cubic([self.at, first, second, end]))
    }

    fn quadratic(&mut self, control: Vec2, end: Vec2) -> Option<()> {
        self.quadratic = Some(control);
        self.push(Piece::quadratic([self.at, control, end]))
    }

    fn push(&mut self, piece: Piece) -> Option<()> {
        let [from, to] = piece.ends();
        if !piece.is_in_range() {
            return None;
        }
        self.at = to;
        if from != to || !matches!(piece, Piece::Line(_)) {
            self.pieces.push(piece);
        }
        Some(())
    }

    fn end_subpath(&mut self, is_closed: bool) {
        let pieces = std::mem::take(&mut self.pieces);
        if !pieces.is_empty() {
            self.done.push(Subpath { is_closed: is_closed || self.at == self.start, pieces });
        }
    }

    fn finish(mut self) -> Vec<Subpath> {
        self.end_subpath(false);
        self.done
    }
}

/// The elliptic arc between two points; `None` if a radius is 0, which gives a straight line.
fn arc(ends: [Vec2; 2], radii: [f64; 2], rotation_deg: f64, [is_large, is_positive]: [bool; 2]) -> Option<EllipticArc> {
    let [a, b] = ends;
    let [rx, ry] = radii.map(f64::abs);
    if !(rx > 0.0 && ry > 0.0) || a == b {
        return None;
    }
    let (sin, cos) = rotation_deg.to_radians().sin_cos();
    let (axis_x, axis_y) = (Vec2::new(cos, sin), Vec2::new(-sin, cos));
    // In units of the radii the arc lies on a unit circle.
    let to_unit = |v: Vec2| Vec2::new(axis_x.dot(&v) / rx, axis_y.dot(&v) / ry);
    let half = to_unit(b - a) * 0.5;
    let stretch = half.norm_squared();
    // Radii too small for the distance of the ends are enlarged as needed.
    let (grown, height) =
        if stretch > 1.0 - HALF_TURN { (stretch.sqrt(), 0.0) } else { (1.0, ((1.0 - stretch) / stretch).sqrt()) };
    let side = if is_large == is_positive { -1.0 } else { 1.0 };
    // The unit center, relative to the midpoint of the ends.
    let center = Vec2::new(-half.y, half.x) * (side * height) / grown;
    let half = half / grown;
    let (from, to) = (-half - center, half - center);
    let angle = cross(from, to).atan2(from.dot(&to));
    let sweep = match (is_positive, angle > 0.0) {
        _ if height == 0.0 => {
            if is_positive {
                std::f64::consts::PI
            } else {
                -std::f64::consts::PI
            }
        }
        (true, false) => angle + std::f64::consts::TAU,
        (false, true) => angle - std::f64::consts::TAU,
        _ => angle,
    };
    let linear = Mat2::from_columns(&[axis_x * (rx * grown), axis_y * (ry * grown)]);
    Some(EllipticArc {
        ends,
        center: 0.5 * (a + b) + linear * center,
        radii: [linear.column(0).into_owned(), linear.column(1).into_owned()],
        start: from.y.atan2(from.x),
        sweep,
    })
}
