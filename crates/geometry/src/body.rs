//! Closed solid bodies: each specified shape becomes one or two, with oriented surface curves and an inside test.
//!
//! The inside test is parry's for the shapes that parry has (ball, cuboid, capsule, half-space, oriented polyline); for the cosine wall it uses the wall's
//! own curves. Parry's vectors (glam) appear in this file and in `boundary` only.

use parry2d_f64::math::{Pose, Rotation, Vector};
use parry2d_f64::shape::{Polyline, PolylineFlags, SharedShape};

use crate::cosine;
use crate::curve::{Curve, unit};
use crate::curve_set::CurveSet;
use crate::spec::{Capsule, CurvedPolygon, HalfPlane, Polygon, Rectangle, ShapeSpec, ThroatCosine, ThroatDiscs};
use crate::winding::Winding;
use meniscus_core::math::{Bounds, Vec2, perpendicular};

/// Infinite straight walls are built this many box diagonals long: far beyond any query, with small rounding errors.
const REACH: f64 = 64.0;

/// Inside test of a body.
#[derive(Clone)]
enum Inside {
    /// A shape of parry with its position and rotation.
    Parry(Pose, SharedShape),
    /// The side of the nearest of these surface curves; valid for smooth chains only.
    Chain(CurveSet),
    /// Points of nonzero winding number with respect to closed rings.
    Wound(Winding),
    /// The part of another body within a box.
    Within(Box<Inside>, Bounds),
}

/// A closed solid.
#[derive(Clone)]
pub struct Body {
    /// Index of the specified shape.
    pub(crate) shape: u32,
    /// Its surface, solid on the left.
    pub curves: CurveSet,
    /// A box around the surface, for culling; infinite for an unbounded body.
    pub bounds: Bounds,
    inside: Inside,
}

/// Location of a point relative to a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Location {
    /// Inside, deeper than the tolerance.
    In,
    /// Outside, farther than the tolerance.
    Out,
    /// On the surface, with its outward normal.
    On(Vec2),
}

fn glam(x: Vec2) -> Vector {
    Vector::new(x.x, x.y)
}

fn pose(angle: f64, by: Vec2) -> Pose {
    Pose::from_parts(glam(by), Rotation::new(angle))
}

fn everywhere() -> Bounds {
    Bounds { min: Vec2::repeat(f64::NEG_INFINITY), max: Vec2::repeat(f64::INFINITY) }
}

impl Body {
    fn finite(shape: u32, curves: Vec<Curve>, pose: Pose, parry: SharedShape) -> Self {
        let curves = CurveSet::from(curves);
        Self { shape, bounds: curves.bounds(), curves, inside: Inside::Parry(pose, parry) }
    }

    /// The bodies of the specified shape number `shape`. The box determines the length of infinite walls.
    pub fn of(spec: &ShapeSpec, shape: u32, domain: Bounds) -> Vec<Self> {
        match spec {
            ShapeSpec::HalfPlane(HalfPlane { point, rotation_deg }) => {
                vec![Self::half_plane(shape, Vec2::from(*point), rotation_deg.to_radians(), domain)]
            }
            ShapeSpec::Disc(disc) => vec![Self::disc(shape, Vec2::from(disc.center), disc.radius)],
            ShapeSpec::Rectangle(rectangle) => vec![Self::rectangle(shape, rectangle)],
            ShapeSpec::Capsule(capsule) => vec![Self::capsule(shape, capsule)],
            ShapeSpec::Polygon(polygon) => vec![Self::polygon(shape, polygon)],
            ShapeSpec::CurvedPolygon(polygon) => vec![Self::curved_polygon(shape, polygon)],
            ShapeSpec::Channel(channel) => {
                let angle = channel.rotation_deg.to_radians();
                let up = perpendicular(unit(angle)) * (0.5 * channel.width);
                let center = Vec2::from(channel.center);
                vec![
                    Self::half_plane(shape, center - up, angle, domain),
                    Self::half_plane(shape, center + up, angle + std::f64::consts::PI, domain),
                ]
            }
            ShapeSpec::ThroatDiscs(throat) => Self::throat_discs(shape, throat),
            ShapeSpec::ThroatCosine(throat) => Self::throat_cosine(shape, throat, domain),
            // Files are read with generators expanded; errors in a generator are reported by its check.
            ShapeSpec::RandomPack(_) | ShapeSpec::Array(_) => {
                let plain = spec.expanded().unwrap_or_default();
                plain.iter().flat_map(|spec| Self::of(spec, shape, domain)).collect()
            }
        }
    }

    /// The half-plane below the line through `point`, rotated by `angle` in rad.
    pub(crate) fn half_plane(shape: u32, point: Vec2, angle: f64, domain: Bounds) -> Self {
        let along = unit(angle);
        let middle = point + along * along.dot(&(domain.center() - point));
        let reach = along * (REACH * domain.size().norm());
        let curves = vec![Curve::Segment { a: middle + reach, b: middle - reach }];
        let inside = Inside::Parry(pose(0.0, point), SharedShape::halfspace(glam(perpendicular(along))));
        Self { shape, curves: curves.into(), bounds: everywhere(), inside }
    }

    fn disc(shape: u32, center: Vec2, radius: f64) -> Self {
        Self::finite(shape, vec![Curve::circle(center, radius)], pose(0.0, center), SharedShape::ball(radius))
    }

    fn rectangle(shape: u32, rectangle: &Rectangle) -> Self {
        let half = 0.5 * Vec2::from(rectangle.size);
        let (angle, center) = (rectangle.rotation_deg.to_radians(), Vec2::from(rectangle.center));
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, y)| center + nalgebra::Rotation2::new(angle) * Vec2::new(x * half.x, y * half.y));
        Self::finite(shape, ring(&corners), pose(angle, center), SharedShape::cuboid(half.x, half.y))
    }

    /// A rectangular body.
    pub(crate) fn of_box(shape: u32, bounds: Bounds) -> Self {
        let rectangle = Rectangle { center: bounds.center().into(), size: bounds.size().into(), rotation_deg: 0.0 };
        Self::rectangle(shape, &rectangle)
    }

    fn capsule(shape: u32, capsule: &Capsule) -> Self {
        let [a, b] = capsule.ends.map(Vec2::from);
        let radius = capsule.radius;
        let Some(t) = (b - a).try_normalize(0.0) else { return Self::disc(shape, a, radius) };
        let side = perpendicular(t) * radius;
        let half_turn = std::f64::consts::PI;
        let angle = side.y.atan2(side.x);
        let curves = vec![
            Curve::Segment { a: a - side, b: b - side },
            Curve::Arc { center: b, radius, start: angle - half_turn, sweep: half_turn },
            Curve::Segment { a: b + side, b: a + side },
            Curve::Arc { center: a, radius, start: angle, sweep: half_turn },
        ];
        Self::finite(shape, curves, Pose::IDENTITY, SharedShape::capsule(glam(a), glam(b), radius))
    }

    fn polygon(shape: u32, polygon: &Polygon) -> Self {
        let turn = nalgebra::Rotation2::new(polygon.rotation_deg.to_radians());
        let (mut curves, mut vertices, mut edges) = (Vec::new(), Vec::new(), Vec::new());
        for points in std::iter::once(&polygon.outer).chain(&polygon.holes) {
            let points: Vec<Vec2> =
                points.iter().map(|&p| turn * Vec2::from(p) + Vec2::from(polygon.position)).collect();
            curves.extend(ring(&points));
            let (first, count) = (vertices.len() as u32, points.len() as u32);
            edges.extend((0..count).map(|k| [first + k, first + (k + 1) % count]));
            vertices.extend(points.into_iter().map(glam));
        }
        let polyline = Polyline::with_flags(vertices, Some(edges), PolylineFlags::ORIENTED);
        Self::finite(shape, curves, Pose::IDENTITY, SharedShape::new(polyline))
    }

    fn curved_polygon(shape: u32, polygon: &CurvedPolygon) -> Self {
        let (angle, by) = (polygon.rotation_deg.to_radians(), Vec2::from(polygon.position));
        let rings = std::iter::once(&polygon.outer).chain(&polygon.holes);
        let rings: Vec<Vec<Curve>> =
            rings.map(|ring| bulged_ring(ring).map(|curve| curve.placed(angle, by)).collect()).collect();
        let curves = CurveSet::from(rings.concat());
        Self { shape, bounds: curves.bounds(), curves, inside: Inside::Wound(Winding::of(rings)) }
    }

    fn throat_discs(shape: u32, throat: &ThroatDiscs) -> Vec<Self> {
        let up = perpendicular(unit(throat.rotation_deg.to_radians()));
        let center = Vec2::from(throat.center);
        [(-1.0, throat.radii[0]), (1.0, throat.radii[1])]
            .into_iter()
            .map(|(side, radius)| Self::disc(shape, center + up * (side * (0.5 * throat.gap + radius)), radius))
            .collect()
    }

    fn throat_cosine(shape: u32, throat: &ThroatCosine, domain: Bounds) -> Vec<Self> {
        let center = Vec2::from(throat.center);
        let reach = REACH * domain.size().norm() + (center - domain.center()).norm();
        let wall = cosine::upper_wall(throat, reach);
        let angle = throat.rotation_deg.to_radians();
        [angle, angle + std::f64::consts::PI]
            .into_iter()
            .map(|angle| {
                let curves: Vec<Curve> = wall.iter().map(|piece| piece.placed(angle, center)).collect();
                let curves = CurveSet::from(curves);
                Self { shape, inside: Inside::Chain(curves.clone()), curves, bounds: everywhere() }
            })
            .collect()
    }

    /// Whether the body is unbounded (half-planes, channel and cosine walls).
    pub fn is_endless(&self) -> bool {
        !self.bounds.min.x.is_finite()
    }

    /// The body shifted by `by` in m.
    pub(crate) fn shifted(&self, by: Vec2) -> Self {
        Self {
            shape: self.shape,
            curves: self.curves.shifted(by),
            bounds: shift(self.bounds, by),
            inside: self.inside.shifted(by),
        }
    }

    /// The part of the body within a box, given the curves around that part.
    pub(crate) fn within(&self, bounds: Bounds, curves: Vec<Curve>) -> Self {
        let curves = CurveSet::from(curves);
        Self { shape: self.shape, curves, bounds, inside: Inside::Within(Box::new(self.inside.clone()), bounds) }
    }

    /// Signed distance from the surface in m, below 0 in the body; near corners of clipped bodies only its sign is exact.
    pub fn signed_distance(&self, x: Vec2) -> f64 {
        self.inside.signed_distance(&self.curves, x)
    }

    /// Location of `x` within a tolerance in m.
    pub(crate) fn locate(&self, x: Vec2, tolerance: f64) -> Location {
        if !self.bounds.grown(tolerance).contains(x) {
            return Location::Out;
        }
        let distance = self.signed_distance(x);
        if distance > tolerance {
            Location::Out
        } else if distance < -tolerance {
            Location::In
        } else {
            match self.curves.nearest(x) {
                Some((curve, closest)) => Location::On(curve.normal(closest.u)),
                None => Location::Out,
            }
        }
    }
}

impl Inside {
    fn shifted(&self, by: Vec2) -> Self {
        match self {
            Self::Parry(pose, shape) => {
                let mut pose = *pose;
                pose.translation += glam(by);
                Self::Parry(pose, shape.clone())
            }
            Self::Chain(curves) => Self::Chain(curves.shifted(by)),
            Self::Wound(winding) => Self::Wound(winding.shifted(by)),
            Self::Within(inner, bounds) => Self::Within(Box::new(inner.shifted(by)), shift(*bounds, by)),
        }
    }

    fn signed_distance(&self, curves: &CurveSet, x: Vec2) -> f64 {
        match self {
            Self::Parry(pose, shape) => {
                let found = shape.project_point(pose, glam(x), false);
                let distance = (found.point - glam(x)).length();
                let sign = if found.is_inside { -1.0 } else { 1.0 };
                // Parry divides by zero at the center of a ball.
                if distance.is_nan() { sign * curves.distance(x) } else { sign * distance }
            }
            Self::Chain(chain) => chain
                .nearest(x)
                .map_or(f64::INFINITY, |(curve, closest)| (x - closest.point).dot(&curve.normal(closest.u))),
            Self::Wound(winding) => {
                let sign = if winding.turns(x) > 0.5 { -1.0 } else { 1.0 };
                sign * curves.distance(x)
            }
            Self::Within(inner, bounds) => {
                let out = (bounds.min - x).sup(&(x - bounds.max)).max();
                inner.signed_distance(curves, x).max(out)
            }
        }
    }
}

fn shift(bounds: Bounds, by: Vec2) -> Bounds {
    Bounds { min: bounds.min + by, max: bounds.max + by }
}

/// The segments and arcs of a closed ring of vertices with bulges.
pub fn bulged_ring(ring: &[[f64; 3]]) -> impl Iterator<Item = Curve> {
    (0..ring.len()).map(|i| {
        let ([x, y, bulge], [u, v, _]) = (ring[i], ring[(i + 1) % ring.len()]);
        Curve::from_bulge(Vec2::new(x, y), Vec2::new(u, v), bulge)
    })
}

/// The segments of a closed ring.
fn ring(points: &[Vec2]) -> Vec<Curve> {
    (0..points.len()).map(|i| Curve::Segment { a: points[i], b: points[(i + 1) % points.len()] }).collect()
}
