//! The cut-out of a throat: a box around both of its walls, and the invading phase up to the meniscus of largest curvature.
//!
//! The box lies along the throat. Its lateral sides cut through the bodies on both sides, where these are widest or the passage has become
//! `OPENING` widths wide on either side, and beyond all that the meniscus meets. Where a wall ends sooner, it goes on straight. Which state a
//! meniscus rests in follows from the two walls that it meets: other bodies are left out, and counted where they reach into the box.

use super::wall_path::{Followed, Frame, UpperWall, follow, mirrored};
use crate::geometry::Geometry;
use crate::geometry::curve::Curve;
use crate::geometry::spec::{CurvedPolygon, Disc, GeometrySpec, HalfPlane, ShapeSpec, SolidSide};
use crate::interface::menisci::{Hand, Meniscus, Passage, Wall};
use crate::math::{Vec2, perpendicular};

/// How far a wall draws back from the throat before the box cuts it, in widths: there the passage is four widths wide, and its resistance
/// per length a sixty-fourth of that in the throat.
const OPENING: f64 = 1.5;
/// Room beside contacts, behind walls that have been left, and beyond the sides of the box, in widths.
const ROOM: f64 = 0.5;
/// Room between the bodies and the ends of the box, in widths.
const ROOM_AT_ENDS: f64 = 1.5;
/// Room ahead of the meniscus and behind it, in widths.
const ROOM_ALONG: f64 = 2.0;
/// How far beyond the meniscus walls are followed that do not draw back, in widths.
const REACH: f64 = 4.0;
/// Lengths below this share of the width are rounding.
const ROUNDING: f64 = 1e-9;
/// Points of the meniscus that are compared with the walls.
const POINTS: usize = 41;

/// Why there is no cut-out.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Impossible {
    /// No menisci.
    #[error("no meniscus passes the throat")]
    NoMeniscus,
    /// Two angles.
    #[error("its walls have different contact angles")]
    Angles,
    /// A contact that the walls of the cut-out do not have.
    #[error("a contact of the meniscus of largest curvature is not on the walls of the throat")]
    Contact,
    /// An arc through a wall.
    #[error("the meniscus of largest curvature would pass through a wall")]
    Crossed,
    /// Shapes that make no sense.
    #[error("its walls would cross each other where they go on straight")]
    Shapes,
    /// A case that is refused.
    #[error("its case is refused: {0}")]
    Case(String),
    /// Of a whole pore: walls of another form.
    #[error("its walls are not three discs")]
    NoDisc,
    /// Menisci that have met and wait.
    #[error("its menisci met at a lower pressure and waited as one")]
    Waited,
    /// No branch before the event.
    #[error("its menisci meet or touch as soon as they stand in their throats")]
    AtOnce,
    /// A third body beside another one.
    #[error("its third body stands beside one of the others, seen along the way")]
    Beside,
    /// A narrow gap.
    #[error("a gap between its bodies is narrower than half of the throat")]
    Narrow,
    /// Not an event of this kind.
    #[error("it is a burst, which is verified in its throat")]
    Burst,
    /// Films of another angle.
    #[error(
        "its walls have another contact angle than those of which the network takes the films in the corners of floor and lid"
    )]
    Films,
    /// Another throat.
    #[error("the cut-out has a throat of {0} m in place of this one")]
    Throat(String),
}

/// A throat on its own, in a frame whose x axis is the direction of advance.
#[derive(Debug, Clone, PartialEq)]
pub struct Subdomain {
    /// Where it stands in the network.
    pub frame: Frame,
    /// Width of the throat in m.
    pub width: f64,
    /// Contact angle through the defending phase in rad.
    pub angle: f64,
    /// The meniscus of largest curvature, in the frame of the network.
    pub meniscus: Meniscus,
    /// The box and the bodies.
    pub geometry: GeometrySpec,
    /// What the invading phase fills, up to the meniscus; it reaches out of the box.
    pub behind: CurvedPolygon,
    /// Other bodies that reach into the box and are left out.
    pub left_out: usize,
}

impl Subdomain {
    /// The cut-out of a passage; `obstacles` are the other walls ahead.
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
        let behind = plan.behind(&arc);
        let subdomain =
            Self { frame, width, angle, meniscus, left_out: plan.count(obstacles, &frame), geometry, behind };
        subdomain.check(&arc)?;
        Ok(subdomain)
    }

    /// The cut-out as its solver sees it: closed, or joined along the throat.
    pub fn solids(&self, is_joined: bool) -> Result<Geometry, Impossible> {
        let geometry = Geometry::new(&self.geometry).map_err(|_| Impossible::Shapes)?;
        Ok(geometry.with_sides([is_joined, false], [!is_joined, !is_joined, true, true]))
    }

    /// Whether throat and meniscus are those of the network.
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

/// Where the chord ends on a wall.
fn chord_end(wall: &Wall, hand: Hand) -> Option<Vec2> {
    let begin = if hand == Hand::Left { 0.0 } else { 1.0 };
    let ahead = wall.parts.get(wall.behind).map(|part| part.curve.point(begin));
    ahead.or_else(|| wall.parts.last().map(|part| part.curve.point(1.0 - begin)))
}

/// One wall as the box cuts it, seen as the upper one.
struct Body {
    wall: UpperWall,
    /// Behind the chord and ahead of it.
    sides: [Followed; 2],
    /// Height of the side of the box in m.
    level: f64,
    /// Whether it is straight along the way, all of it.
    is_flat: bool,
    hand: Hand,
}

/// The box with what goes into it.
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
            // The box must cut the body, however far around it the meniscus meets it.
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
            let is_kept = |side: usize, contact: Vec2| sides[side].holds(contact, ROUNDING * width);
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
            // More than a width: the way past a body to the end of the box is no narrower throat.
            (reached + ROOM_AT_ENDS * width).max(needed[side] + ROOM_ALONG * width)
        });
        Ok(Self { bodies, ends, width })
    }

    /// The curves of a body from beyond the box behind to beyond it ahead, in the frame of the cut-out, along the advance.
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

    /// The points that lead from the end of a side of a wall out of the box.
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

    /// The disc that a body is, where the box shows more than half of it.
    fn disc(&self, body: &Body) -> Option<Disc> {
        let same = |curve: &Curve| match (body.sides[1].curves.first(), curve) {
            (Some(&Curve::Arc { center, radius, .. }), &Curve::Arc { center: other, radius: r, sweep, .. }) => {
                // That behind the throat is mirrored.
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

    /// What lies behind the meniscus: a polygon whose other edges lie on the walls and beyond the sides of the box.
    fn behind(&self, arc: &Curve) -> CurvedPolygon {
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

    /// How many of the other walls reach into the box.
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

/// A path up to a point on it.
fn until(path: &[Curve], point: Vec2) -> Vec<Curve> {
    let distance = |curve: &Curve| (curve.project(point).point - point).norm();
    let nearest = (0..path.len()).min_by(|&a, &b| distance(&path[a]).total_cmp(&distance(&path[b])));
    let Some(nearest) = nearest else { return Vec::new() };
    let mut found = path[..nearest].to_vec();
    found.push(path[nearest].part(0.0, path[nearest].project(point).u));
    found
}

/// Longest arc of one edge in rad: bulges stay below 1.
const LONGEST_ARC: f64 = 2.5;

/// A closed path as a polygon; curves of no length are left out, and coordinates within rounding of an axis lie on it.
pub(super) fn polygon(path: &[Curve], width: f64) -> CurvedPolygon {
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
