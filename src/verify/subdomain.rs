//! The subdomain of a throat: a box around both of its walls, and the invading phase up to the meniscus of largest curvature.
//!
//! The box is aligned with the throat. Its lateral sides cut the bodies on both sides where these are widest or have receded by `OPENING`
//! widths from the throat, and beyond all contacts of the meniscus. A wall that ends sooner is continued straight. The equilibrium of the
//! meniscus depends only on the two walls that it meets: other bodies are left out, and counted if they reach into the box.

use super::wall_path::{Followed, Frame, UpperWall, follow, mirrored};
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::Geometry;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::menisci::{Hand, Meniscus, Passage, Wall};
use meniscus_geometry::spec::{CurvedPolygon, Disc, GeometrySpec, HalfPlane, ShapeSpec, SolidSide};

/// Recession of a wall from the throat at which the box cuts it, in widths: the passage is then four widths wide, and its resistance per
/// length 1/64 of that in the throat.
const OPENING: f64 = 1.5;
/// Clearance beside contacts, behind truncated walls, and beyond the sides of the box, in widths.
const ROOM: f64 = 0.5;
/// Clearance between the bodies and the ends of the box, in widths.
const ROOM_AT_ENDS: f64 = 1.5;
/// Clearance ahead of the meniscus and behind it, in widths.
const ROOM_ALONG: f64 = 2.0;
/// Distance past the meniscus up to which walls that do not recede are followed, in widths.
const REACH: f64 = 4.0;
/// Rounding error of lengths, in widths.
const ROUNDING: f64 = 1e-9;
/// Points of the meniscus at which it is compared with the walls.
const POINTS: usize = 41;

/// Why there is no subdomain.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Impossible {
    /// No meniscus passes.
    #[error("no meniscus passes the throat")]
    NoMeniscus,
    /// Different contact angles.
    #[error("its walls have different contact angles")]
    Angles,
    /// A contact outside the walls of the subdomain.
    #[error("a contact of the meniscus of largest curvature is not on the walls of the throat")]
    Contact,
    /// A meniscus through a wall.
    #[error("the meniscus of largest curvature would pass through a wall")]
    Crossed,
    /// Walls that cross.
    #[error("its walls would cross each other where they are continued straight")]
    Shapes,
    /// An invalid case.
    #[error("its case is refused: {0}")]
    Case(String),
    /// Corner films of another angle.
    #[error("its walls have a contact angle other than that of the corner films of the network")]
    Films,
    /// Another throat.
    #[error("the subdomain has a throat of {0} m instead of this one")]
    Throat(String),
}

/// An isolated throat, in a frame whose x axis is the direction of advance.
#[derive(Debug, Clone, PartialEq)]
pub struct Subdomain {
    /// Its frame in the network.
    pub frame: Frame,
    /// Width of the throat in m.
    pub width: f64,
    /// Contact angle through the defending phase in rad.
    pub angle: f64,
    /// The meniscus of largest curvature, in the frame of the network.
    pub meniscus: Meniscus,
    /// The box and the bodies.
    pub geometry: GeometrySpec,
    /// Shape of the invading phase up to the meniscus; it extends past the box.
    pub behind: CurvedPolygon,
    /// Number of other bodies that reach into the box and are left out.
    pub left_out: usize,
}

impl Subdomain {
    /// The subdomain of a passage; `obstacles` are the other walls ahead.
    pub(crate) fn new(passage: &Passage, obstacles: &[Curve]) -> Result<Self, Impossible> {
        let meniscus = passage.burst().ok_or(Impossible::NoMeniscus)?;
        let angle = one_angle(passage)?;
        let ends = [chord_end(passage.left(), Hand::Left), chord_end(passage.right(), Hand::Right)];
        let [Some(upper), Some(lower)] = ends else { return Err(Impossible::NoMeniscus) };
        let along = -perpendicular(upper - lower);
        let frame = Frame { middle: 0.5 * (upper + lower), angle: along.y.atan2(along.x) };
        let width = along.norm();
        let arc = frame.curve(&meniscus.curve());
        let plan = Plan::new(passage, &frame, &arc, width)?;
        let geometry = plan.geometry();
        let behind = plan.invading_shape(&arc);
        let subdomain =
            Self { frame, width, angle, meniscus, left_out: plan.count(obstacles, &frame), geometry, behind };
        subdomain.check(&arc)?;
        Ok(subdomain)
    }

    /// The domain of the simulation: closed, or periodic along the throat.
    pub fn solids(&self, is_joined: bool) -> Result<Geometry, Impossible> {
        let geometry = Geometry::new(&self.geometry).map_err(|_| Impossible::Shapes)?;
        Ok(geometry.with_sides([is_joined, false], [!is_joined, !is_joined, true, true]))
    }

    /// Checks that throat and meniscus are those of the network.
    fn check(&self, arc: &Curve) -> Result<(), Impossible> {
        let geometry = self.solids(false)?;
        let within = |k: usize| arc.point(k as f64 / (POINTS - 1) as f64);
        if (0..POINTS).any(|k| geometry.signed_distance(within(k)) < -1e3 * ROUNDING * self.width) {
            return Err(Impossible::Crossed);
        }
        let narrowest = geometry.narrowest_throat().map(|throat| throat.width);
        match narrowest {
            Some(width) if (width - self.width).abs() > ROUNDING * self.width => {
                Err(Impossible::Throat(format!("{width:e}")))
            }
            _ => Ok(()),
        }
    }
}

fn one_angle(passage: &Passage) -> Result<f64, Impossible> {
    let mut angles = passage.left().parts.iter().chain(&passage.right().parts).map(|part| part.angle);
    let first = angles.next().ok_or(Impossible::NoMeniscus)?;
    if angles.all(|angle| (angle - first).abs() <= ROUNDING) { Ok(first) } else { Err(Impossible::Angles) }
}

/// The end of the chord on a wall.
fn chord_end(wall: &Wall, hand: Hand) -> Option<Vec2> {
    let begin = if hand == Hand::Left { 0.0 } else { 1.0 };
    let ahead = wall.parts.get(wall.behind).map(|part| part.curve.point(begin));
    ahead.or_else(|| wall.parts.last().map(|part| part.curve.point(1.0 - begin)))
}

/// One wall cut by the box, in the orientation of the upper one.
struct Body {
    wall: UpperWall,
    /// Behind the chord and ahead of it.
    sides: [Followed; 2],
    /// Height of the side of the box in m.
    level: f64,
    /// Whether all of it is straight and parallel to the axis.
    is_flat: bool,
    hand: Hand,
}

/// The box with its contents.
struct Plan {
    bodies: [Body; 2],
    /// Ends of the box behind and ahead, in m, both above 0.
    ends: [f64; 2],
    width: f64,
}

impl Plan {
    fn new(passage: &Passage, frame: &Frame, arc: &Curve, width: f64) -> Result<Self, Impossible> {
        let bounds = arc.bounds();
        let needed = [(-bounds.min.x).max(0.0), bounds.max.x.max(0.0)];
        let body = |wall: &Wall, hand: Hand, contact: Vec2| {
            let wall = UpperWall::of(wall, hand, frame);
            let start = Vec2::new(0.0, 0.5 * width);
            let met = wall.height_to(contact, ROUNDING * width).ok_or(Impossible::Contact)?;
            let ([behind, ahead], highest) = (wall.widest(), wall.highest());
            let opening = (0.5 + OPENING) * width;
            let mut level = opening.min(behind.max(ahead)).max(0.5 * width);
            // The box must cut the body, however far around it the contact lies.
            let top = highest[0].min(highest[1]);
            let room = if top > met { (0.5 * (top - met)).min(ROOM * width) } else { ROOM * width };
            if met > level - room && met > (0.5 + ROUNDING) * width {
                level = met + room;
            }
            let is_flat = highest[0].max(highest[1]).max(level) <= (0.5 + ROUNDING) * width;
            if is_flat {
                level += ROOM * width;
            }
            let sides = [0, 1].map(|side| {
                let above = highest[side] - level;
                let lid = level + if above > 0.0 { (0.5 * above).min(ROOM * width) } else { ROOM * width };
                follow(&wall.sides[side], start, lid, needed[side] + REACH * width)
            });
            let is_kept = |side: usize, contact: Vec2| sides[side].contains(contact, ROUNDING * width);
            if !is_flat && !is_kept(0, Vec2::new(-contact.x, contact.y)) && !is_kept(1, contact) {
                return Err(Impossible::Contact);
            }
            Ok(Body { wall, sides, level, is_flat, hand })
        };
        let [left, right] = [arc.point(0.0), arc.point(1.0)];
        let bodies = [
            body(passage.left(), Hand::Left, left)?,
            body(passage.right(), Hand::Right, Vec2::new(right.x, -right.y))?,
        ];
        let ends = [0, 1].map(|side| {
            let reached = bodies.iter().map(|body| body.sides[side].farthest()).fold(0.0, f64::max);
            // More than a width: the gap between a body and the end of the box must not be a narrower throat.
            (reached + ROOM_AT_ENDS * width).max(needed[side] + ROOM_ALONG * width)
        });
        Ok(Self { bodies, ends, width })
    }

    /// The curves of a body from outside the box behind to outside it ahead, in the frame of the subdomain, along the advance.
    fn path(&self, body: &Body) -> Vec<Curve> {
        let side = |k: usize| {
            let mut curves = body.sides[k].curves.clone();
            let tail = self.tail(body, k);
            let points = [&[body.sides[k].end], &tail[..]].concat();
            curves.extend(points.windows(2).map(|pair| Curve::Segment { a: pair[0], b: pair[1] }));
            curves
        };
        let behind = side(0).into_iter().rev().map(|curve| mirrored(&curve.reversed(), 0));
        let curves = behind.chain(side(1));
        match body.hand {
            Hand::Left => curves.collect(),
            Hand::Right => curves.map(|curve| mirrored(&curve, 1)).collect(),
        }
    }

    /// The points from the end of one side of a wall to outside the box.
    fn tail(&self, body: &Body, side: usize) -> Vec<Vec2> {
        let Followed { end, is_risen, .. } = body.sides[side];
        let lid = body.level + ROOM * self.width;
        if is_risen {
            vec![]
        } else if end.y >= body.level - ROUNDING * self.width {
            vec![Vec2::new(end.x, lid)]
        } else {
            let step = self.ends[side] - ROOM * self.width;
            vec![Vec2::new(step, end.y), Vec2::new(step, lid)]
        }
    }

    fn geometry(&self) -> GeometrySpec {
        let [upper, lower] = &self.bodies;
        GeometrySpec {
            min: [-self.ends[0], -lower.level],
            max: [self.ends[1], upper.level],
            solid: SolidSide::Inside,
            shapes: self.bodies.iter().map(|body| self.shape(body)).collect(),
        }
    }

    /// A body as a shape.
    fn shape(&self, body: &Body) -> ShapeSpec {
        if body.is_flat {
            let (sign, rotation_deg) = if body.hand == Hand::Left { (1.0, 180.0) } else { (-1.0, 0.0) };
            return ShapeSpec::HalfPlane(HalfPlane { point: [0.0, sign * 0.5 * self.width], rotation_deg });
        }
        if let Some(disc) = self.disc(body) {
            return ShapeSpec::Disc(disc);
        }
        let mut path = self.path(body);
        if body.hand == Hand::Right {
            path = path.iter().rev().map(Curve::reversed).collect();
        }
        if let (Some(first), Some(last)) = (path.first(), path.last()) {
            path.push(Curve::Segment { a: last.point(1.0), b: first.point(0.0) });
        }
        ShapeSpec::CurvedPolygon(polygon(&path, self.width))
    }

    /// The body as a disc, if more than half of it lies in the box.
    fn disc(&self, body: &Body) -> Option<Disc> {
        let same = |curve: &Curve| match (body.sides[1].curves.first(), curve) {
            (Some(&Curve::Arc { center, radius, .. }), &Curve::Arc { center: other, radius: r, sweep, .. }) => {
                // The side behind the throat is mirrored.
                let other = Vec2::new(other.x.abs(), other.y);
                let near = ROUNDING * self.width;
                (Vec2::new(center.x.abs(), center.y) - other).norm() <= near
                    && (radius - r).abs() <= near
                    && sweep > 0.0
            }
            _ => false,
        };
        let Some(&Curve::Arc { center, radius, .. }) = body.sides[1].curves.first() else { return None };
        let is_whole = body.sides.iter().all(|side| side.is_risen && side.curves.iter().all(same));
        let sign = if body.hand == Hand::Left { 1.0 } else { -1.0 };
        (is_whole && body.level >= center.y - ROUNDING * self.width)
            .then(|| Disc { center: [center.x, sign * center.y], radius })
    }

    /// The region behind the meniscus: a polygon whose other edges lie on the walls and outside the sides of the box.
    fn invading_shape(&self, arc: &Curve) -> CurvedPolygon {
        let [upper, lower] = self.bodies.each_ref().map(|body| self.path(body));
        let [left, right] = [arc.point(0.0), arc.point(1.0)];
        let mut ring = vec![arc.reversed()];
        ring.extend(until(&upper, left).iter().rev().map(Curve::reversed));
        let far = -self.ends[0] - ROOM * self.width;
        let start = |path: &[Curve], at: Vec2| path.first().map_or(at, |curve| curve.point(0.0));
        let (top, bottom) = (start(&upper, left), start(&lower, right));
        let beyond = self.bodies.each_ref().map(|body| body.level + ROOM * self.width);
        let (high, low) = (top.y.max(beyond[0]), bottom.y.min(-beyond[1]));
        let corners =
            [top, Vec2::new(top.x, high), Vec2::new(far, high), Vec2::new(far, low), Vec2::new(bottom.x, low), bottom];
        ring.extend(corners.windows(2).map(|pair| Curve::Segment { a: pair[0], b: pair[1] }));
        ring.extend(until(&lower, right));
        polygon(&ring, self.width)
    }

    /// Number of other walls that reach into the box.
    fn count(&self, obstacles: &[Curve], frame: &Frame) -> usize {
        let [upper, lower] = &self.bodies;
        let reaches = |curve: &&Curve| {
            let curve = frame.curve(curve);
            let is_in = |x: Vec2| x.x > -self.ends[0] && x.x < self.ends[1] && x.y > -lower.level && x.y < upper.level;
            let own = |x: Vec2| {
                let mirrored = Vec2::new(-x.x, x.y);
                let near = |side: &[Curve], x: Vec2| {
                    side.iter().any(|curve| (curve.project(x).point - x).norm() < 1e3 * ROUNDING * self.width)
                };
                [(upper, x, mirrored), (lower, Vec2::new(x.x, -x.y), Vec2::new(-x.x, -x.y))].iter().any(
                    |(body, ahead, behind)| near(&body.wall.sides[1], *ahead) || near(&body.wall.sides[0], *behind),
                )
            };
            (0..POINTS).map(|k| curve.point(k as f64 / (POINTS - 1) as f64)).any(|x| is_in(x) && !own(x))
        };
        obstacles.iter().filter(reaches).count()
    }
}

/// A path truncated at a point on it.
fn until(path: &[Curve], point: Vec2) -> Vec<Curve> {
    let distance = |curve: &Curve| (curve.project(point).point - point).norm();
    let nearest = (0..path.len()).min_by(|&a, &b| distance(&path[a]).total_cmp(&distance(&path[b])));
    let Some(nearest) = nearest else { return Vec::new() };
    let mut found = path[..nearest].to_vec();
    found.push(path[nearest].part(0.0, path[nearest].project(point).u));
    found
}

/// Longest arc of one edge in rad, so that bulges stay below 1.
const LONGEST_ARC: f64 = 2.5;

/// A closed path as a polygon; curves of zero length are left out, and coordinates within rounding of an axis are set on it.
fn polygon(path: &[Curve], width: f64) -> CurvedPolygon {
    let tidy = |x: f64| if x.abs() < ROUNDING * ROUNDING * width { 0.0 } else { x };
    let mut outer = Vec::new();
    for curve in path.iter().filter(|curve| curve.length() > ROUNDING * width) {
        let sweep = match curve {
            Curve::Segment { .. } => 0.0,
            Curve::Arc { sweep, .. } => *sweep,
        };
        let parts = (sweep.abs() / LONGEST_ARC).ceil().max(1.0);
        for k in 0..parts as usize {
            let point = curve.point(k as f64 / parts);
            outer.push([tidy(point.x), tidy(point.y), (0.25 * sweep / parts).tan()]);
        }
    }
    CurvedPolygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 }
}
