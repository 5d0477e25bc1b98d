//! Etch offset: the walls of a drawing displaced by a uniform distance along their normals, as by under- or overetching of the mask.
//!
//! Discs, capsules, half-planes, channels and pairs of discs keep their type, with other sizes. Rings of segments and arcs are displaced curve by curve: a
//! gap at a corner is closed by an arc about it, and curves that cross are cut at their intersection. All of this is exact; a feature that would vanish, or
//! an outline that would intersect itself, is an error.

use std::f64::consts::TAU;

use crate::body::{Body, Location, bulged_ring};
use crate::boundary::split;
use crate::curve::{Curve, cross, unit};
use crate::intersect::crossings;
use crate::spec::{
    Capsule, Channel, CurvedPolygon, Disc, GeometrySpec, HalfPlane, Rectangle, ShapeSpec, SolidSide, ThroatDiscs,
};
use meniscus_core::input::problem::Problem;
use meniscus_core::math::{Bounds, Vec2, perpendicular};

/// Angle of a corner in rad below which two curves join smoothly.
const SMOOTH: f64 = 1e-4;

/// Gaps at corners below this fraction of the domain are closed by moving both ends: so short an arc would be lost to rounding.
const SHORTEST: f64 = 1e-8;

/// Lengths below this fraction of the domain count as zero.
const TOLERANCE: f64 = 1e-9;

/// Why a shape cannot be displaced, and a remedy.
type Refused = (String, &'static str);

const SMALLER: &str = "take a smaller etch offset, or draw the shape without such small details";

impl GeometrySpec {
    /// The same drawing with its walls displaced into the pore by `offset` in m, below 0 into the solid.
    ///
    /// # Errors
    /// The first shape that cannot be displaced so far, or the problems of the result.
    pub fn etched(&self, offset: f64) -> Result<Self, Problem> {
        // Growth of the shapes themselves.
        let growth = if self.solid == SolidSide::Inside { offset } else { -offset };
        if growth < 0.0
            && let Some([first, second]) = self.overlapping()
        {
            let what = if self.solid == SolidSide::Inside { "solid" } else { "pore" };
            let message = format!(
                "shapes[{first}] and shapes[{second}] overlap, and where they do their common outline does not shrink as each of them does"
            );
            let help = format!(
                "draw them as one shape: an etch offset that lets the {what} shrink takes shapes that lie apart"
            );
            return Err(Problem::new(format!("shapes[{first}]"), message, help));
        }
        let shortest = SHORTEST * (Vec2::from(self.max) - Vec2::from(self.min)).max();
        let move_one = |(index, shape): (usize, &ShapeSpec)| {
            shape.grown(growth, shortest).map_err(|(message, help)| Problem::new(at(index, shape), message, help))
        };
        let shapes = self.shapes.iter().enumerate().map(move_one).collect::<Result<_, _>>()?;
        let etched = Self { shapes, ..self.clone() };
        match etched.problems().into_iter().next() {
            Some(problem) => Err(Problem { help: format!("{}; {SMALLER}", problem.help), ..problem }),
            None => Ok(etched),
        }
    }

    /// Two shapes whose outlines overlap.
    fn overlapping(&self) -> Option<[usize; 2]> {
        let domain = Bounds { min: Vec2::from(self.min), max: Vec2::from(self.max) };
        let tolerance = TOLERANCE * domain.size().max();
        let shapes = self.shapes.iter().zip(0..);
        let mut bodies: Vec<Body> = shapes.flat_map(|(shape, index)| Body::of(shape, index, domain)).collect();
        bodies.sort_by(|a, b| a.bounds.min.x.total_cmp(&b.bounds.min.x));
        for (index, body) in bodies.iter().enumerate() {
            let near = bodies[index + 1..].iter().take_while(|other| other.bounds.min.x <= body.bounds.max.x);
            let other =
                near.filter(|other| other.shape != body.shape && other.bounds.overlaps(&body.bounds)).find(|other| {
                    reaches_into(body, other, domain, tolerance) || reaches_into(other, body, domain, tolerance)
                });
            if let Some(other) = other {
                let [a, b] = [body.shape as usize, other.shape as usize];
                return Some([a.min(b), a.max(b)]);
            }
        }
        None
    }
}

/// Whether the surface of a body enters another one, in the domain or near it.
fn reaches_into(body: &Body, other: &Body, domain: Bounds, tolerance: f64) -> bool {
    let near = domain.grown(domain.size().max());
    body.curves.iter().filter(|curve| near.overlaps(&curve.bounds())).any(|curve| {
        split(curve, other.curves.near(curve.bounds().grown(tolerance)), tolerance)
            .iter()
            .any(|part| other.locate(part.point(0.5), tolerance) == Location::In)
    })
}

fn at(index: usize, shape: &ShapeSpec) -> String {
    format!("shapes[{index}].{}", shape.key())
}

impl ShapeSpec {
    /// The shape with its outline displaced outwards by `by` in m, below 0 inwards, with no arc about a corner shorter than `shortest` in m.
    fn grown(&self, by: f64, shortest: f64) -> Result<Self, Refused> {
        Ok(match self {
            Self::Disc(disc) => Self::Disc(Disc { radius: left(disc.radius + by, "disc")?, ..disc.clone() }),
            Self::Capsule(capsule) => {
                Self::Capsule(Capsule { radius: left(capsule.radius + by, "capsule")?, ..capsule.clone() })
            }
            Self::HalfPlane(plane) => {
                let up = perpendicular(unit(plane.rotation_deg.to_radians()));
                Self::HalfPlane(HalfPlane { point: (Vec2::from(plane.point) + up * by).into(), ..plane.clone() })
            }
            Self::Channel(channel) => {
                Self::Channel(Channel { width: left(channel.width - 2.0 * by, "channel")?, ..channel.clone() })
            }
            Self::ThroatDiscs(throat) => Self::ThroatDiscs(ThroatDiscs {
                radii: [left(throat.radii[0] + by, "lower disc")?, left(throat.radii[1] + by, "upper disc")?],
                gap: left(throat.gap - 2.0 * by, "gap")?,
                ..throat.clone()
            }),
            Self::Rectangle(rectangle) => grown_rectangle(rectangle, by, shortest)?,
            Self::Polygon(polygon) => Self::CurvedPolygon(grown_polygon(&polygon.curved(), by, shortest)?),
            Self::CurvedPolygon(polygon) => Self::CurvedPolygon(grown_polygon(polygon, by, shortest)?),
            Self::ThroatCosine(_) => {
                return Err((
                    "a wall at a constant distance from a cosine is not a cosine".to_owned(),
                    "set `throat` and `width` in place of the etch offset",
                ));
            }
            Self::RandomPack(_) | Self::Array(_) => {
                return Err(("a generator cannot be etched".to_owned(), "name its discs"));
            }
        })
    }
}

/// A size that must be above 0.
fn left(size: f64, what: &str) -> Result<f64, Refused> {
    if size > 0.0 { Ok(size) } else { Err((format!("nothing is left of the {what}"), SMALLER)) }
}

fn grown_rectangle(rectangle: &Rectangle, by: f64, shortest: f64) -> Result<ShapeSpec, Refused> {
    if by < 0.0 {
        let [width, height] = rectangle.size;
        let size = [left(width + 2.0 * by, "rectangle")?, left(height + 2.0 * by, "rectangle")?];
        return Ok(ShapeSpec::Rectangle(Rectangle { size, ..rectangle.clone() }));
    }
    Ok(ShapeSpec::CurvedPolygon(grown_polygon(&rectangle.curved(), by, shortest)?))
}

fn grown_polygon(polygon: &CurvedPolygon, by: f64, shortest: f64) -> Result<CurvedPolygon, Refused> {
    let ring = |ring: &Vec<[f64; 3]>| grown_ring(&bulged_ring(ring).collect::<Vec<_>>(), by, shortest);
    let holes = polygon.holes.iter().map(ring).collect::<Result<_, _>>()?;
    Ok(CurvedPolygon { outer: ring(&polygon.outer)?, holes, ..polygon.clone() })
}

/// A curve displaced along its normal, out of the solid.
fn moved(curve: &Curve, by: f64) -> Result<Curve, Refused> {
    match *curve {
        Curve::Segment { a, b } => {
            let normal = curve.normal(0.0) * by;
            Ok(Curve::Segment { a: a + normal, b: b + normal })
        }
        Curve::Arc { center, radius, start, sweep } => {
            let radius = radius + by * sweep.signum();
            if !(radius > 0.0) {
                let message = format!(
                    "the arc of {:e} m about ({:e}, {:e}) m has no radius left",
                    curve.length(),
                    center.x,
                    center.y
                );
                return Err((message, SMALLER));
            }
            Ok(Curve::Arc { center, radius, start, sweep })
        }
    }
}

/// Joint of two neighboring curves of a displaced ring.
enum Joint {
    /// They join smoothly, or are cut at their intersection.
    Cut(Vec2),
    /// By an arc of this bulge from the end of the first to the start of the second one.
    Arc(f64),
}

/// The ring of these curves displaced out of the solid, as vertices with bulges.
fn grown_ring(ring: &[Curve], by: f64, shortest: f64) -> Result<Vec<[f64; 3]>, Refused> {
    let parts = ring.iter().map(|curve| moved(curve, by)).collect::<Result<Vec<_>, _>>()?;
    let count = parts.len();
    let joint = |first: usize| {
        let second = (first + 1) % count;
        let (from, to) = (ring[first].tangent(1.0), ring[second].tangent(0.0));
        let turn = cross(from, to).atan2(from.dot(&to));
        if turn.abs() < SMOOTH || (turn * by).abs() < shortest {
            Ok(Joint::Cut(0.5 * (parts[first].point(1.0) + parts[second].point(0.0))))
        } else if turn * by > 0.0 {
            Ok(Joint::Arc((0.25 * turn).tan()))
        } else {
            let corner = ring[second].point(0.0);
            let point = meeting(&parts[first], &parts[second], corner);
            let vanished =
                || (format!("an edge at the corner ({:e}, {:e}) m would vanish", corner.x, corner.y), SMALLER);
            point.map(Joint::Cut).ok_or_else(vanished)
        }
    };
    let joints = (0..count).map(joint).collect::<Result<Vec<_>, _>>()?;
    let mut vertices = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        let begin = match joints[(index + count - 1) % count] {
            Joint::Cut(point) => point,
            Joint::Arc(_) => part.point(0.0),
        };
        let end = match joints[index] {
            Joint::Cut(point) => point,
            Joint::Arc(_) => part.point(1.0),
        };
        let bulge = bulge_between(part, begin, end).ok_or_else(|| {
            let middle = ring[index].point(0.5);
            (format!("the edge about ({:e}, {:e}) m would vanish", middle.x, middle.y), SMALLER)
        })?;
        vertices.push([begin.x, begin.y, bulge]);
        if let Joint::Arc(bulge) = joints[index] {
            vertices.push([end.x, end.y, bulge]);
        }
    }
    Ok(vertices)
}

/// The intersection of two curves nearest to their common corner; `None` if there is none.
fn meeting(first: &Curve, second: &Curve, corner: Vec2) -> Option<Vec2> {
    let points = crossings(first, second);
    points.into_iter().min_by(|a, b| (a - corner).norm().total_cmp(&(b - corner).norm()))
}

/// The bulge of the part of a curve between two of its points; `None` if that is empty.
fn bulge_between(part: &Curve, begin: Vec2, end: Vec2) -> Option<f64> {
    match *part {
        Curve::Segment { .. } => ((end - begin).dot(&part.tangent(0.0)) > 0.0).then_some(0.0),
        Curve::Arc { center, sweep, .. } => {
            let (a, b) = (begin - center, end - center);
            let angle = cross(a, b).atan2(a.dot(&b));
            // The angle in the direction of the arc, from 0 to a full turn.
            let along = if angle * sweep < 0.0 { angle + TAU * sweep.signum() } else { angle };
            // An end beyond the other one makes the arc longer than before.
            (along != 0.0 && along.abs() <= sweep.abs() * (1.0 + SMOOTH)).then(|| (0.25 * along).tan())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Geometry;

    /// A domain of 10 by 10 with these shapes.
    fn spec(solid: &str, shapes: &str) -> GeometrySpec {
        toml::from_str(&format!("min = [0.0, 0.0]\nmax = [10.0, 10.0]\nsolid = '{solid}'\nshapes = [{shapes}]"))
            .unwrap()
    }

    /// All kinds of corners: convex and concave, straight and round.
    const SHAPES: [&str; 6] = [
        "{ disc = { center = [5.0, 5.0], radius = 2.0 } }",
        "{ capsule = { ends = [[3.0, 4.0], [6.0, 5.0]], radius = 1.5 } }",
        "{ rectangle = { center = [5.0, 5.0], size = [4.0, 3.0], rotation-deg = 20.0 } }",
        "{ polygon = { outer = [[2.0, 2.0], [8.0, 2.0], [8.0, 8.0], [5.0, 4.5], [2.0, 8.0]] } }",
        "{ polygon = { outer = [[-3, -3], [3, -3], [3, 3], [-3, 3]], holes = [[[-1, -1], [-1, 1], [1, 1], [1, -1]]], position = [5, 5], \
         rotation-deg = 30.0 } }",
        "{ curved-polygon = { outer = [[3.0, 3.0, 0.0], [7.0, 3.0, 0.4], [7.0, 7.0, -0.5], [3.0, 7.0, 0.0]] } }",
    ];

    #[test]
    fn distances_change_by_the_offset() {
        for (shapes, offset) in SHAPES.iter().flat_map(|shapes| [(*shapes, 0.3), (*shapes, -0.3)]) {
            let before = spec("inside", shapes);
            let after = before.etched(offset).unwrap_or_else(|problem| panic!("{shapes}: {problem}"));
            let [before, after] = [&before, &after].map(|spec| Geometry::new(spec).unwrap());
            let mut count = 0;
            for (i, j) in (0..40).flat_map(|i| (0..40).map(move |j| (i, j))) {
                let x = Vec2::new(0.25 * f64::from(i) + 0.1, 0.25 * f64::from(j) + 0.1);
                let expected = before.signed_distance(x) - offset;
                // At a sharp corner the nearest point of the old wall to a point of the new wall is not its origin.
                if expected * offset > 0.0 {
                    count += 1;
                    let found = after.signed_distance(x);
                    assert!(
                        (found - expected).abs() < 1e-9,
                        "{shapes} by {offset} at {x:?}: {found}, expected {expected}"
                    );
                }
            }
            assert!(count > 20, "{count} points");
        }
    }

    #[test]
    fn pores_shrink_where_shapes_are_pores() {
        let after = spec("outside", "{ disc = { center = [5.0, 5.0], radius = 2.0 } }").etched(0.5).unwrap();
        assert_eq!(after.shapes, spec("outside", "{ disc = { center = [5.0, 5.0], radius = 1.5 } }").shapes);
        let channel = spec("inside", "{ channel = { center = [5.0, 5.0], width = 2.0 } }").etched(0.25).unwrap();
        assert_eq!(channel.shapes, spec("inside", "{ channel = { center = [5.0, 5.0], width = 1.5 } }").shapes);
    }

    #[test]
    fn what_cannot_be_moved_is_told() {
        let two = "{ disc = { center = [4.0, 5.0], radius = 1.0 } }, { disc = { center = [5.5, 5.0], radius = 1.0 } }";
        let comb = "{ polygon = { outer = [[2, 2], [8, 2], [8, 8], [5.1, 8], [5.1, 4], [4.9, 4], [4.9, 8], [2, 8]] } }";
        for (shapes, offset, message) in [
            (SHAPES[0], -2.0, "nothing is left of the disc"),
            (two, -0.1, "shapes[0] and shapes[1] overlap"),
            (comb, 0.2, "the edge"),
            ("{ throat-cosine = { center = [5, 5], width = 4, throat = 2, length = 5 } }", 0.1, "a wall at a constant"),
            ("{ disc = { center = [5.0, 5.0], radius = 6.0 } }", 3.0, "the domain is wholly solid"),
        ] {
            let problem = spec("inside", shapes).etched(offset).expect_err(shapes);
            assert!(problem.message.starts_with(message) && !problem.help.is_empty(), "{problem}");
        }
        assert!(spec("inside", two).etched(0.1).is_ok());
    }
}
