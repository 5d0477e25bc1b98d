//! The subdomain of a touch or an overlap: a whole pore of three bodies, and the invading phase up to the menisci before the event.
//!
//! For a touch the bodies are both walls of the throat and the wall ahead; for an overlap the wall between both menisci and the outer ones.
//! The x axis is the flow direction of the invading phase past the upper and the lower body, which are extended as straight pillars to the
//! sides of the box and separate both phases there; the third body is free between them. The invading phase enters on the left and the
//! defending one leaves on the right, both at given pressures. Bodies are completed to discs; pores with other walls have no such subdomain.

use std::f64::consts::FRAC_PI_8;

use super::subdomain::{Impossible, polygon};
use super::wall_path::Frame;
use crate::geometry::curve::Curve;
use crate::geometry::spec::{CurvedPolygon, Disc, GeometrySpec, ShapeSpec, SolidSide};
use crate::interface::menisci::{Meniscus, Passage, WallPart};
use crate::math::{Bounds, Vec2, perpendicular};
use crate::network::displacement::{EventKind, Scene, Site};

/// Clearance between the third body and the sides of the box, in widths: no narrower than the throat.
const ROOM: f64 = 1.0;
/// Clearance between bodies and the inlet or outlet, in widths.
const ROOM_AT_ENDS: f64 = 1.5;
/// Position, in radii, where the inlet or outlet may cut the outer bodies: otherwise it lies outside them.
const CUT: f64 = 0.5;
/// Clearance ahead of menisci and behind them, in widths.
const ROOM_ALONG: f64 = 2.0;
/// Distance below the event at which menisci are compared with box and walls, as curvature times width.
const BELOW: f64 = 0.1;
/// Least gap between two bodies, in widths: it determines the spacing, and the number of particles scales with its inverse square.
const NARROWEST: f64 = 0.5;
/// Rounding error of lengths, in widths.
const ROUNDING: f64 = 1e-9;
/// The same for a touch, which is a double root.
const TOUCHING: f64 = 1e-5;
/// Points of a meniscus at which it is compared with the walls.
const POINTS: usize = 201;

/// An isolated pore, in a frame whose x axis is the flow direction of the invading phase.
#[derive(Debug, Clone)]
pub struct WholePore {
    /// Kind of the event.
    pub kind: EventKind,
    /// Its frame in the network.
    pub frame: Frame,
    /// Width in m of the narrowest throat with a meniscus.
    pub width: f64,
    /// The narrowest gap between two of the bodies in m.
    pub narrowest: f64,
    /// Contact angle through the defending phase in rad.
    pub angle: f64,
    /// Curvature of the menisci at the event in 1/m.
    pub curvature: f64,
    /// Curvature in 1/m below which they recede from their throats.
    pub lowest: f64,
    /// Area in m² that the event fills with the invading phase.
    pub area: f64,
    /// The box and the bodies.
    pub geometry: GeometrySpec,
    /// Number of other bodies that reach into the box and are left out.
    pub left_out: usize,
    bodies: Bodies,
    /// From the upper body to the lower one.
    passages: Vec<Passage>,
}

/// The bodies in the frame of the subdomain, lengths in m.
#[derive(Debug, Clone, PartialEq)]
struct Bodies {
    upper: Disc,
    lower: Disc,
    third: Disc,
}

impl WholePore {
    /// The subdomain of an event at a curvature (1/m) that fills an area (m²); `angles` are those of all walls in rad.
    pub(crate) fn new(
        kind: EventKind,
        scene: &Scene,
        curvature: f64,
        filled_area: f64,
        angles: &[f64],
    ) -> Result<Self, Impossible> {
        let angle = *angles.first().ok_or(Impossible::NoMeniscus)?;
        if angles.iter().any(|other| (other - angle).abs() > ROUNDING) {
            return Err(Impossible::Angles);
        }
        if scene.has_waited {
            return Err(Impossible::Waited);
        }
        let (found, throats) = bodies(kind, scene, curvature)?;
        let frame = frame(&found);
        let bodies = found.within(&frame);
        let passages: Vec<Passage> = scene.sites.iter().map(|site| site.passage.clone()).collect();
        let width = throats.into_iter().fold(f64::INFINITY, f64::min);
        let lowest = passages.iter().filter_map(Passage::lowest).map(|it| it.curvature).fold(f64::MIN, f64::max);
        if !(width > 0.0) || lowest >= curvature {
            return Err(Impossible::AtOnce);
        }
        bodies.check(width)?;
        let low = lowest.max(curvature - BELOW / width);
        let arcs = [low, curvature].map(|k| arcs(&passages, &frame, k));
        let [Some(before), Some(at_event)] = arcs else { return Err(Impossible::NoMeniscus) };
        let arcs: Vec<Curve> = before.into_iter().chain(at_event).collect();
        bodies.hold(&arcs, width)?;
        let geometry = bodies.geometry(kind, &arcs, width);
        let swept = |passage: &Passage| passage.at(curvature).map_or(0.0, |meniscus| passage.swept_area(&meniscus));
        let left = filled_area - passages.iter().map(swept).sum::<f64>();
        let area = if left > 0.0 { left } else { filled_area };
        let left_out = bodies.count(&scene.sites, &frame, &geometry, width);
        let narrowest = bodies.narrowest();
        Ok(Self { kind, frame, width, narrowest, angle, curvature, lowest, area, geometry, left_out, bodies, passages })
    }

    /// Shape of the invading phase at a curvature (1/m) of its menisci before the event; it extends past the box. `None` if there are no
    /// menisci of this curvature.
    pub fn invading_shape(&self, curvature: f64) -> Option<CurvedPolygon> {
        let arcs = arcs(&self.passages, &self.frame, curvature)?;
        let Bodies { upper, lower, .. } = &self.bodies;
        let room = ROOM * self.width;
        let (left, bottom) = (self.geometry.min[0] - room, self.geometry.min[1] - room);
        let top = self.geometry.max[1] + room;
        let (high, low) = (Vec2::from(upper.center), Vec2::from(lower.center));
        // Between the menisci the boundary runs through the bodies.
        let corners = [Vec2::new(left, top), Vec2::new(left, bottom), Vec2::new(low.x, bottom), low];
        let mut ring: Vec<Curve> = corners.windows(2).map(|pair| Curve::Segment { a: pair[0], b: pair[1] }).collect();
        let mut at = low;
        for arc in arcs.iter().rev().map(Curve::reversed) {
            ring.extend([Curve::Segment { a: at, b: arc.point(0.0) }, arc]);
            at = arc.point(1.0);
        }
        let corners = [at, high, Vec2::new(high.x, top), Vec2::new(left, top)];
        ring.extend(corners.windows(2).map(|pair| Curve::Segment { a: pair[0], b: pair[1] }));
        Some(polygon(&ring, self.width))
    }
}

/// The menisci of a curvature in the frame, from the upper body to the lower one.
fn arcs(passages: &[Passage], frame: &Frame, curvature: f64) -> Option<Vec<Curve>> {
    let arc = |passage: &Passage| passage.at(curvature).map(|meniscus: Meniscus| frame.curve(&meniscus.curve()));
    passages.iter().map(arc).collect()
}

/// The bodies of an event in the frame of the network, and the widths in m of the throats with menisci.
fn bodies(kind: EventKind, scene: &Scene, curvature: f64) -> Result<(Bodies, Vec<f64>), Impossible> {
    match (kind, &scene.sites[..]) {
        (EventKind::Touch, [site]) => {
            let upper = disc_of(&site.passage.left().parts)?;
            let lower = disc_of(&site.passage.right().parts)?;
            let meniscus = site.passage.at(curvature).ok_or(Impossible::NoMeniscus)?;
            let throats = vec![gap(&upper, &lower)];
            let third = touched(&meniscus, &site.ahead, throats[0])?;
            Ok((Bodies { upper, lower, third }, throats))
        }
        (EventKind::Overlap, [left, right]) => {
            let upper = disc_of(&left.passage.left().parts)?;
            let third = disc_of(&left.passage.right().parts)?;
            let lower = disc_of(&right.passage.right().parts)?;
            let throats = vec![gap(&upper, &third), gap(&third, &lower)];
            Ok((Bodies { upper, lower, third }, throats))
        }
        _ => Err(Impossible::Burst),
    }
}

/// The disc whose boundary contains a wall.
fn disc_of(parts: &[WallPart]) -> Result<Disc, Impossible> {
    let mut found: Option<Disc> = None;
    for part in parts {
        let disc = disc_around(&part.curve).ok_or(Impossible::NoDisc)?;
        let near = 1e3 * ROUNDING * disc.radius;
        let is_same = |one: &Disc| {
            (Vec2::from(one.center) - Vec2::from(disc.center)).norm() <= near
                && (one.radius - disc.radius).abs() <= near
        };
        if !found.as_ref().is_none_or(is_same) {
            return Err(Impossible::NoDisc);
        }
        found = found.or(Some(disc));
    }
    found.ok_or(Impossible::NoDisc)
}

fn disc_around(curve: &Curve) -> Option<Disc> {
    match *curve {
        Curve::Arc { center, radius, sweep, .. } if sweep > 0.0 => Some(Disc { center: center.into(), radius }),
        _ => None,
    }
}

/// The disc that a meniscus touches.
fn touched(meniscus: &Meniscus, ahead: &[Curve], width: f64) -> Result<Disc, Impossible> {
    let points = meniscus.points(POINTS);
    let distance =
        |curve: &&Curve| points.iter().map(|&x| (curve.project(x).point - x).norm()).fold(f64::INFINITY, f64::min);
    let nearest = ahead.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).ok_or(Impossible::NoMeniscus)?;
    let disc = disc_around(nearest).ok_or(Impossible::NoDisc)?;
    // Both circles meet under the angle zero.
    let center = Vec2::from(disc.center);
    let from_points = points.iter().map(|x| (x - center).norm() - disc.radius).fold(f64::INFINITY, f64::min);
    // Near the point of touch, points of the arc are off the disc by less than their distance squared over twice its radius.
    let step = meniscus.curve().length() / (POINTS - 1) as f64;
    let slack = TOUCHING * width + step * step / disc.radius.min(width);
    if from_points.abs() <= slack { Ok(disc) } else { Err(Impossible::Contact) }
}

/// Gap between two bodies in m.
fn gap(one: &Disc, other: &Disc) -> f64 {
    (Vec2::from(one.center) - Vec2::from(other.center)).norm() - one.radius - other.radius
}

/// The frame of bodies: its y axis points from the lower to the upper one, its origin is the midpoint between them.
fn frame(bodies: &Bodies) -> Frame {
    let (upper, lower) = (Vec2::from(bodies.upper.center), Vec2::from(bodies.lower.center));
    let up = (upper - lower).normalize();
    let along = -perpendicular(up);
    let middle = 0.5 * (upper - up * bodies.upper.radius + lower + up * bodies.lower.radius);
    Frame { middle, angle: along.y.atan2(along.x) }
}

impl Bodies {
    fn within(&self, frame: &Frame) -> Self {
        let moved = |disc: &Disc| Disc { center: frame.point(Vec2::from(disc.center)).into(), radius: disc.radius };
        // Both lie on the y axis, up to rounding.
        let on_axis = |disc: &Disc| Disc { center: [0.0, moved(disc).center[1]], radius: disc.radius };
        Self { upper: on_axis(&self.upper), lower: on_axis(&self.lower), third: moved(&self.third) }
    }

    fn all(&self) -> [&Disc; 3] {
        [&self.upper, &self.lower, &self.third]
    }

    /// The narrowest gap between two of them in m.
    fn narrowest(&self) -> f64 {
        let Self { upper, lower, third } = self;
        gap(upper, third).min(gap(third, lower)).min(gap(upper, lower))
    }

    /// Whether both phases can enter and leave.
    fn check(&self, width: f64) -> Result<(), Impossible> {
        let height = self.third.center[1];
        if height > self.upper.center[1] || height < self.lower.center[1] {
            return Err(Impossible::Beside);
        }
        if self.narrowest() < NARROWEST * width { Err(Impossible::Narrow) } else { Ok(()) }
    }

    /// Whether menisci are clear of the bodies, with contacts on their round parts.
    fn hold(&self, arcs: &[Curve], width: f64) -> Result<(), Impossible> {
        let Self { upper, lower, .. } = self;
        for arc in arcs {
            let ends = [arc.point(0.0), arc.point(1.0)];
            let is_round = |x: &Vec2| x.y <= upper.center[1] && x.y >= lower.center[1];
            if !ends.iter().all(is_round) {
                return Err(Impossible::Contact);
            }
            let is_clear = |k: usize| {
                let x = arc.point(k as f64 / (POINTS - 1) as f64);
                self.all().iter().all(|disc| (x - Vec2::from(disc.center)).norm() > disc.radius - TOUCHING * width)
            };
            if !(0..POINTS).all(is_clear) {
                return Err(Impossible::Crossed);
            }
        }
        Ok(())
    }

    /// The box with the bodies; `arcs` are the menisci before and at the event.
    fn geometry(&self, kind: EventKind, arcs: &[Curve], width: f64) -> GeometrySpec {
        let Self { upper, lower, third } = self;
        let reached =
            arcs.iter().map(Curve::bounds).reduce(|a, b| Bounds { min: a.min.inf(&b.min), max: a.max.sup(&b.max) });
        let (behind, ahead) = reached.map_or((0.0, 0.0), |it| (it.min.x.min(0.0), it.max.x.max(0.0)));
        let around = third.radius + ROOM_AT_ENDS * width;
        let clear = |reach: f64| {
            let beyond = upper.radius.max(lower.radius) + ROOM_AT_ENDS * width;
            if reach <= CUT * upper.radius.min(lower.radius) { reach } else { reach.max(beyond) }
        };
        let (mut left, mut right) = (-clear(ROOM_ALONG * width - behind), clear(ahead + ROOM_ALONG * width));
        if kind == EventKind::Touch {
            right = right.max(third.center[0] + around);
        } else {
            left = left.min(third.center[0] - around);
        }
        let beside = third.radius + ROOM * width;
        let top = upper.center[1].max(third.center[1] + beside);
        let bottom = lower.center[1].min(third.center[1] - beside);
        let room = ROOM * width;
        let shapes = vec![
            ShapeSpec::CurvedPolygon(pillar(upper, top + room)),
            ShapeSpec::CurvedPolygon(pillar(lower, bottom - room)),
            ShapeSpec::Disc(third.clone()),
        ];
        GeometrySpec { min: [left, bottom], max: [right, top], solid: SolidSide::Inside, shapes }
    }

    /// Number of other walls that reach into the box.
    fn count(&self, sites: &[Site], frame: &Frame, geometry: &GeometrySpec, width: f64) -> usize {
        let is_in = |x: Vec2| (0..2).all(|i| x[i] > geometry.min[i] && x[i] < geometry.max[i]);
        let near = 1e3 * ROUNDING * width;
        let is_own = |x: Vec2| self.all().iter().any(|disc| (x - Vec2::from(disc.center)).norm() <= disc.radius + near);
        let reaches = |curve: &&Curve| {
            let curve = frame.curve(curve);
            (0..POINTS).map(|k| curve.point(k as f64 / (POINTS - 1) as f64)).any(|x| is_in(x) && !is_own(x))
        };
        sites.iter().flat_map(|site| &site.ahead).filter(reaches).count()
    }
}

/// A disc extended straight from its widest point to a height in m.
fn pillar(disc: &Disc, height: f64) -> CurvedPolygon {
    let ([x, y], radius) = (disc.center, disc.radius);
    // Counter-clockwise on either side.
    let side = if height > y { radius } else { -radius };
    let quarter = (FRAC_PI_8).tan();
    let outer = vec![
        [x - side, height, 0.0],
        [x - side, y, quarter],
        [x, y - side, quarter],
        [x + side, y, 0.0],
        [x + side, height, 0.0],
    ];
    CurvedPolygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 }
}
