//! The entities of DXF as pieces of contours: lines, arcs, circles, polylines with bulges, ellipses, splines, filled quadrangles, and insertions of blocks.

use std::f64::consts::TAU;

use super::group::Group;
use super::header::Record;
use super::wide::{self, Vertex};
use crate::import::affine::Affine;
use crate::import::contour::{EllipticArc, Piece};
use crate::import::drawing::Refusal;
use crate::import::limits::is_in_range;
use crate::import::spline::{BSpline, through_points};
use meniscus_core::math::{Vec2, perpendicular};

/// A polyline whose ends are nearer than this fraction of its size is closed.
pub(crate) const CLOSING_GAP: f64 = 1e-6;
/// Tolerance of full turns, for the digits that programs write.
const FULL_TURN: f64 = 1e-9;
/// A normal within this angle (sine) of the z axis is parallel to it.
const UPRIGHT: f64 = 1e-6;

/// Content of an entity.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Content {
    /// Consecutive pieces.
    Contour {
        pieces: Vec<Piece>,
        /// Whether they enclose an area.
        is_closed: bool,
    },
    /// Closed outlines of the area of a polyline with a width.
    Wide(Vec<Vec<Piece>>),
    /// Copies of a block.
    Insert(Insert),
    /// No enclosed area, with the name under which it is counted.
    Unused(String),
}

/// Copies of a block in rows and columns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Insert {
    /// The name of the block, in capitals.
    pub(crate) block: String,
    /// From the block's coordinates relative to its base point to the first copy.
    pub(crate) map: Affine,
    /// Number of columns and rows.
    pub(crate) number: [i64; 2],
    /// Displacement between columns, and between rows.
    pub(crate) steps: [Vec2; 2],
}

/// The first entity of `records` and the number of records it occupies: a POLYLINE is followed by its vertices.
pub(crate) fn read(records: &[Record]) -> Result<(Content, usize), Refusal> {
    let Some(record) = records.first() else { return Ok((Content::Unused(String::new()), 1)) };
    let kind = record.kind();
    let fields = Fields(record);
    let content = match kind.as_str() {
        "LINE" => contour(vec![Piece::Line([fields.point(0)?, fields.point(1)?])], false),
        "CIRCLE" => {
            let arc = EllipticArc::circle(fields.point(0)?, fields.radius()?);
            fields.in_plane(contour(vec![Piece::Ellipse(arc)], true))?
        }
        "ARC" => fields.in_plane(arc(&fields)?)?,
        "ELLIPSE" => ellipse(&fields)?,
        "LWPOLYLINE" => fields.in_plane(light_polyline(&fields)?)?,
        "POLYLINE" => return polyline(records),
        "SPLINE" => spline(&fields)?,
        "SOLID" | "TRACE" => {
            // The corners are in the order of a Z; a triangle repeats its last one.
            let [a, b, c] = [fields.point(0)?, fields.point(1)?, fields.point(2)?];
            let d = if fields.has(13) { fields.point(3)? } else { c };
            let lines = [[a, b], [b, d], [d, c], [c, a]].into_iter().filter(|[a, b]| a != b);
            fields.in_plane(contour(lines.map(Piece::Line).collect(), true))?
        }
        "INSERT" => insert(&fields)?,
        _ => Content::Unused(kind),
    };
    Ok((content, 1))
}

fn contour(pieces: Vec<Piece>, is_closed: bool) -> Content {
    Content::Contour { pieces, is_closed }
}

/// The groups of an entity by code.
struct Fields<'a, 'b>(&'b Record<'a>);

impl<'a> Fields<'a, '_> {
    fn find(&self, code: i32) -> Option<&'a Group<'a>> {
        self.0.groups.iter().find(|group| group.code == code)
    }

    fn has(&self, code: i32) -> bool {
        self.find(code).is_some()
    }

    fn real_or(&self, code: i32, default: f64) -> Result<f64, Refusal> {
        self.find(code).map_or(Ok(default), Group::real)
    }

    fn whole_or(&self, code: i32, default: i64) -> Result<i64, Refusal> {
        self.find(code).map_or(Ok(default), Group::whole)
    }

    fn real(&self, code: i32) -> Result<f64, Refusal> {
        match self.find(code) {
            Some(group) => group.real(),
            None => Err(self.refusal("a truncated entity", &format!("a value behind group code {code}"))),
        }
    }

    fn refusal(&self, found: &str, expected: &str) -> Refusal {
        Refusal::new(self.0.location(), found, expected)
    }

    /// Point 0 has the codes 10 and 20, point 1 11 and 21.
    fn point(&self, number: i32) -> Result<Vec2, Refusal> {
        Ok(Vec2::new(self.real(10 + number)?, self.real(20 + number)?))
    }

    fn radius(&self) -> Result<f64, Refusal> {
        let radius = self.real(40)?;
        if radius > 0.0 { Ok(radius) } else { Err(self.refusal(&format!("radius {radius}"), "a radius above 0")) }
    }

    /// The point of each group of the code `code`; y follows with code + 10.
    fn points(&self, code: i32) -> Result<Vec<Vec2>, Refusal> {
        let mut points: Vec<Vec2> = Vec::new();
        for group in self.0.groups {
            if group.code == code {
                points.push(Vec2::new(group.real()?, 0.0));
            } else if group.code == code + 10
                && let Some(point) = points.last_mut()
            {
                point.y = group.real()?;
            }
        }
        Ok(points)
    }

    fn reals(&self, code: i32) -> Result<Vec<f64>, Refusal> {
        self.0.groups.iter().filter(|group| group.code == code).map(Group::real).collect()
    }

    /// 1 if the normal points up, -1 if it points down, 0 if the entity is not in the plane.
    fn side(&self) -> Result<f64, Refusal> {
        let [x, y, z] = [self.real_or(210, 0.0)?, self.real_or(220, 0.0)?, self.real_or(230, 1.0)?];
        Ok(if x.hypot(y) <= UPRIGHT * z.abs() { z.signum() } else { 0.0 })
    }

    /// From object coordinates to those of the drawing: a normal that points down mirrors x (arbitrary axis algorithm).
    fn in_plane(&self, content: Content) -> Result<Content, Refusal> {
        let side = self.side()?;
        let map = Affine::scaling(side, 1.0);
        Ok(match content {
            _ if side == 0.0 => Content::Unused("entities out of the plane".to_owned()),
            content if side > 0.0 => content,
            Content::Contour { pieces, is_closed } => {
                contour(pieces.iter().map(|piece| piece.mapped(&map)).collect(), is_closed)
            }
            Content::Wide(outlines) => {
                let mapped = |pieces: &Vec<Piece>| pieces.iter().map(|piece| piece.mapped(&map)).collect();
                Content::Wide(outlines.iter().map(mapped).collect())
            }
            Content::Insert(insert) => Content::Insert(Insert {
                map: map.after(&insert.map),
                steps: insert.steps.map(|step| map.turn(step)),
                ..insert
            }),
            unused @ Content::Unused(_) => unused,
        })
    }
}

/// The counter-clockwise angle from `start` to `end`, a full turn if they are equal.
fn sweep(start: f64, end: f64) -> f64 {
    let sweep = (end - start).rem_euclid(TAU);
    if sweep <= FULL_TURN || sweep >= TAU - FULL_TURN { TAU } else { sweep }
}

fn arc(fields: &Fields) -> Result<Content, Refusal> {
    let radius = fields.radius()?;
    let [start, end] = [fields.real(50)?.to_radians(), fields.real(51)?.to_radians()];
    let radii = [Vec2::new(radius, 0.0), Vec2::new(0.0, radius)];
    let arc = EllipticArc::new(fields.point(0)?, radii, start, sweep(start, end));
    let is_closed = arc.sweep >= TAU;
    Ok(contour(vec![Piece::Ellipse(arc)], is_closed))
}

fn ellipse(fields: &Fields) -> Result<Content, Refusal> {
    let side = fields.side()?;
    if side == 0.0 {
        return Ok(Content::Unused("entities out of the plane".to_owned()));
    }
    let (major, ratio) = (fields.point(1)?, fields.real(40)?);
    if !(ratio > 0.0 && major.norm() > 0.0) {
        return Err(fields.refusal("an axis of no length", "two axes above 0"));
    }
    let [start, end] = [fields.real_or(41, 0.0)?, fields.real_or(42, TAU)?];
    let arc =
        EllipticArc::new(fields.point(0)?, [major, perpendicular(major) * (ratio * side)], start, sweep(start, end));
    let is_closed = arc.sweep >= TAU;
    Ok(contour(vec![Piece::Ellipse(arc)], is_closed))
}

fn light_polyline(fields: &Fields) -> Result<Content, Refusal> {
    let mut vertices: Vec<Vertex> = Vec::new();
    let constant = fields.real_or(43, 0.0)?;
    for group in fields.0.groups {
        match (group.code, vertices.last_mut()) {
            (10, _) => vertices.push(Vertex { point: Vec2::new(group.real()?, 0.0), bulge: 0.0, width: [constant; 2] }),
            (20, Some(vertex)) => vertex.point.y = group.real()?,
            (40, Some(vertex)) => vertex.width[0] = group.real()?,
            (41, Some(vertex)) => vertex.width[1] = group.real()?,
            (42, Some(vertex)) => vertex.bulge = group.real()?,
            _ => {}
        }
    }
    from_vertices(fields, &vertices, fields.whole_or(70, 0)? & 1 != 0)
}

fn polyline(records: &[Record]) -> Result<(Content, usize), Refusal> {
    /// Flags of group 70.
    const CLOSED: i64 = 1;
    const MESH: i64 = 16 | 64;
    /// Flag of a control vertex of a spline.
    const GUIDE: i64 = 16;
    let fields = Fields(&records[0]);
    let number = records[1..].iter().take_while(|record| record.head.begins("VERTEX")).count();
    let has_end = records.get(1 + number).is_some_and(|record| record.head.begins("SEQEND"));
    let taken = 1 + number + usize::from(has_end);
    let flags = fields.whole_or(70, 0)?;
    if flags & MESH != 0 {
        return Ok((Content::Unused("meshes".to_owned()), taken));
    }
    let all = [fields.real_or(40, 0.0)?, fields.real_or(41, 0.0)?];
    let mut vertices = Vec::with_capacity(number);
    for vertex in records[1..=number].iter().map(Fields) {
        if vertex.whole_or(70, 0)? & GUIDE == 0 {
            let width = [vertex.real_or(40, all[0])?, vertex.real_or(41, all[1])?];
            vertices.push(Vertex { point: vertex.point(0)?, bulge: vertex.real_or(42, 0.0)?, width });
        }
    }
    Ok((fields.in_plane(from_vertices(&fields, &vertices, flags & CLOSED != 0)?)?, taken))
}

fn from_vertices(fields: &Fields, vertices: &[Vertex], is_closed: bool) -> Result<Content, Refusal> {
    let is_wide = vertices.iter().any(|vertex| vertex.width != [0.0; 2]);
    let is_long = vertices.windows(2).any(|pair| pair[0].point != pair[1].point);
    if is_wide && is_long {
        let is_good = |v: &Vertex| is_in_range(v.point) && is_in_range(Vec2::from(v.width));
        if !vertices.iter().all(is_good) {
            return Err(
                fields.refusal("a coordinate out of range", "coordinates below 1e38 in the unit of the drawing")
            );
        }
        let is_closed = is_closed || ends_meet(vertices.iter().map(|vertex| vertex.point));
        return wide::outlines(vertices, is_closed)
            .map(Content::Wide)
            .map_err(|(found, expected)| fields.refusal(&found, expected));
    }
    let edge = |a: Vertex, b: Vec2| Piece::from_bulge([a.point, b], a.bulge);
    let pairs = vertices.windows(2).filter(|pair| pair[0].point != pair[1].point);
    let mut pieces: Vec<Piece> = pairs.map(|pair| edge(pair[0], pair[1].point)).collect();
    let (Some(&first), Some(&last)) = (vertices.first(), vertices.last()) else { return Ok(contour(pieces, false)) };
    if is_closed && first.point != last.point {
        pieces.push(edge(last, first.point));
    }
    let is_closed = is_closed || pieces.len() > 1 && ends_meet(vertices.iter().map(|vertex| vertex.point));
    Ok(contour(pieces, is_closed))
}

/// Whether the last point coincides with the first.
fn ends_meet(mut points: impl Iterator<Item = Vec2>) -> bool {
    let Some(first) = points.next() else { return false };
    let (low, high, last) =
        points.fold((first, first, first), |(low, high, _), point| (low.inf(&point), high.sup(&point), point));
    (last - first).norm() <= CLOSING_GAP * (high - low).norm()
}

fn spline(fields: &Fields) -> Result<Content, Refusal> {
    const CLOSED: i64 = 1;
    let is_closed = fields.whole_or(70, 0)? & CLOSED != 0;
    let control = fields.points(10)?;
    let pieces: Vec<Piece> = if control.is_empty() {
        let direction = |code: i32| {
            let (x, y) = (fields.real_or(code, 0.0)?, fields.real_or(code + 10, 0.0)?);
            Ok::<_, Refusal>(Vec2::new(x, y).try_normalize(0.0))
        };
        through_points(&fields.points(11)?, is_closed, [direction(12)?, direction(13)?])
            .into_iter()
            .map(Piece::Cubic)
            .collect()
    } else {
        let degree = usize::try_from(fields.whole_or(71, 3)?).unwrap_or(0);
        let expected = "knots, control points and weights that fit together, of degree 1 to 11";
        let spline = BSpline::new(degree, fields.reals(40)?, control, fields.reals(41)?)
            .map_err(|found| fields.refusal(&found, expected))?;
        vec![Piece::Spline(Box::new(spline))]
    };
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else {
        return Err(fields.refusal("no points", "control points or fit points"));
    };
    let inner = pieces.iter().map(Piece::middle);
    let is_closed = is_closed || ends_meet([first.ends()[0]].into_iter().chain(inner).chain([last.ends()[1]]));
    Ok(contour(pieces, is_closed))
}

fn insert(fields: &Fields) -> Result<Content, Refusal> {
    let Some(name) = fields.find(2) else { return Err(fields.refusal("no name", "the name of a block")) };
    let turn = Affine::rotation_deg(fields.real_or(50, 0.0)?);
    let scale = Affine::scaling(fields.real_or(41, 1.0)?, fields.real_or(42, 1.0)?);
    let steps = [Vec2::new(fields.real_or(44, 0.0)?, 0.0), Vec2::new(0.0, fields.real_or(45, 0.0)?)];
    let insert = Insert {
        block: name.text().to_uppercase(),
        map: Affine::translation(fields.point(0)?).after(&turn).after(&scale),
        number: [fields.whole_or(70, 1)?.max(1), fields.whole_or(71, 1)?.max(1)],
        steps: steps.map(|step| turn.turn(step)),
    };
    fields.in_plane(Content::Insert(insert))
}
