//! Validation of specified shapes: sizes, rings, and positions in the domain. All problems are reported, not only the first.
//!
//! Individual points of rings are checked here; intersections and containment of rings in `rings`.

use crate::body::{Body, Location, bulged_ring};
use crate::boundary::split;
use crate::curve::{Curve, cross};
use crate::extent::{self, Numbers};
use crate::pack::PackError;
use crate::rings::{RingFault, faults};
use crate::solid::{Geometry, GeometryError};
use crate::spec::{CurvedPolygon, GeometrySpec, Polygon, ShapeSpec, SolidSide};
use meniscus_core::input::problem::Problem;
use meniscus_core::math::{Bounds, Vec2};
use rayon::prelude::*;

/// An arc of a larger bulge is a full circle minus a few millionths: its center is lost to rounding.
const LARGEST_BULGE: f64 = 1e6;

/// A pore area below this fraction of the domain is rounding.
const NO_PORE: f64 = 1e-9;

impl GeometrySpec {
    /// All problems of the domain and the shapes; paths as in a shape file, such as `shapes[2].disc.radius`.
    pub fn problems(&self) -> Vec<Problem> {
        match Geometry::new(self) {
            Ok(_) => Vec::new(),
            Err(GeometryError::Invalid(problems)) => problems,
        }
    }

    /// The problems of the domain and of each shape, before the solids are united.
    pub(crate) fn problems_of_parts(&self) -> Vec<Problem> {
        let mut problems = self.domain_problems();
        let of_shape = |(i, shape): (usize, &ShapeSpec)| shape.problems_in(self, &format!("shapes[{i}]"));
        problems.par_extend(self.shapes.par_iter().enumerate().flat_map_iter(of_shape));
        if problems.is_empty() {
            problems.extend(self.position_problems());
        }
        problems
    }

    /// The problem of a geometry without a pore.
    pub(crate) fn problem_of_pore(&self, geometry: &Geometry) -> Option<Problem> {
        if !(geometry.porosity().value < NO_PORE) {
            return None;
        }
        let help = match self.solid {
            SolidSide::Inside => {
                "shrink or remove shapes; if the shapes are the pore, set `solid = \"outside\"`, or `invert` for a drawing"
            }
            SolidSide::Outside => "with `solid = \"outside\"` the shapes are the pore: add one that fluid can fill",
        };
        Some(Problem::new("shapes", "the domain is wholly solid: there is no pore left", help))
    }

    fn domain_problems(&self) -> Vec<Problem> {
        let mut found = Vec::new();
        for (i, axis) in ["x", "y"].into_iter().enumerate() {
            let (min, max) = (self.min[i], self.max[i]);
            if !(min.is_finite() && max.is_finite()) {
                let path = if min.is_finite() { "max" } else { "min" };
                found.push(Problem::new(path, format!("{axis} is not a finite number"), "give both corners in m"));
            } else if min >= max {
                found.push(Problem::new(
                    "max",
                    format!("{axis} of max is {max:e} m, which is not above {axis} of min, {min:e} m"),
                    "`min` is the lower left corner of the domain and `max` the upper right one, in m",
                ));
            }
        }
        if found.is_empty() {
            found.extend(extent::domain_problems(self));
        }
        found
    }

    fn position_problems(&self) -> Vec<Problem> {
        let domain = Bounds { min: Vec2::from(self.min), max: Vec2::from(self.max) };
        let of_shape = |(i, shape): (usize, &ShapeSpec)| {
            let is_within = Body::of(shape, i as u32, domain).iter().any(|body| reaches(body, domain));
            (!is_within).then(|| {
                Problem::new(
                    format!("shapes[{i}].{}", shape.key()),
                    format!(
                        "the shape lies wholly outside of the domain, which spans ({:e}, {:e}) to ({:e}, {:e}) m",
                        domain.min.x, domain.min.y, domain.max.x, domain.max.y
                    ),
                    "move the shape, enlarge the domain by `min` and `max`, or remove the shape; are all lengths in m?",
                )
            })
        };
        self.shapes.par_iter().enumerate().filter_map(of_shape).collect()
    }
}

/// Whether a body and the domain have more than a point in common.
fn reaches(body: &Body, domain: Bounds) -> bool {
    let tolerance = 1e-9 * domain.size().max();
    let frame = Body::of_box(0, domain);
    // The middle of a part may lie on the other outline, as that of a circle nearly on a side does.
    let is_in = |body: &Body, part: &Curve| {
        [0.25, 0.5, 0.75].into_iter().any(|at| body.locate(part.point(at), tolerance) == Location::In)
    };
    let inner = frame.curves.iter().any(|side| {
        let parts = split(side, body.curves.near(side.bounds().grown(tolerance)), tolerance);
        parts.iter().any(|part| is_in(body, part))
    });
    // A domain that no surface crosses is covered completely or not at all.
    inner
        || body.locate(domain.center(), tolerance) == Location::In
        || body
            .curves
            .iter()
            .any(|curve| split(curve, frame.curves.iter(), tolerance).iter().any(|part| is_in(&frame, part)))
}

impl ShapeSpec {
    /// The table name of the shape.
    pub fn key(&self) -> &'static str {
        match self {
            Self::HalfPlane(_) => "half-plane",
            Self::Disc(_) => "disc",
            Self::Rectangle(_) => "rectangle",
            Self::Capsule(_) => "capsule",
            Self::Polygon(_) => "polygon",
            Self::CurvedPolygon(_) => "curved-polygon",
            Self::Channel(_) => "channel",
            Self::ThroatDiscs(_) => "throat-discs",
            Self::ThroatCosine(_) => "throat-cosine",
            Self::RandomPack(_) => "random-pack",
            Self::Array(_) => "array",
        }
    }

    /// All problems of the shape in the domain of a geometry; `at` is its path, such as `shapes[2]`.
    pub fn problems_in(&self, geometry: &GeometrySpec, at: &str) -> Vec<Problem> {
        let domain = Bounds { min: Vec2::from(geometry.min), max: Vec2::from(geometry.max) };
        let is_domain = geometry.domain_problems().is_empty();
        let extents = if is_domain { extent::shape_problems(domain, self, at) } else { Vec::new() };
        let own = self.problems(at);
        // An invalid size is reported once.
        if own.is_empty() { extents } else { own }
    }

    /// All problems of the shape by itself; `at` is its path, such as `shapes[2]`.
    pub fn problems(&self, at: &str) -> Vec<Problem> {
        let mut check = Check { at: format!("{at}.{}", self.key()), found: Vec::new() };
        match self {
            Self::Polygon(s) => check.polygon(s),
            Self::CurvedPolygon(s) => check.curved_polygon(s),
            Self::RandomPack(_) | Self::Array(_) => {
                if let Err(PackError { key, message, help }) = self.expanded() {
                    check.add(key, message, help);
                }
            }
            _ => extent::numbers(self).into_iter().for_each(|numbers| match numbers {
                Numbers::Sizes(key, sizes) => check.positive(key, sizes),
                Numbers::Points(key, points) => check.finite(key, points.as_flattened()),
                Numbers::Turn(turn) => check.finite("rotation-deg", &[turn]),
            }),
        }
        if let Self::ThroatCosine(s) = self
            && s.throat > s.width
        {
            check.add(
                "throat",
                format!("the throat, {:e} m, is wider than the channel, {:e} m", s.throat, s.width),
                "make `throat` at most `width`",
            );
        }
        check.found
    }
}

/// Collects the problems of one shape.
struct Check {
    at: String,
    found: Vec<Problem>,
}

impl Check {
    fn add(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.found.push(Problem::new(format!("{}.{key}", self.at), message, help));
    }

    fn finite(&mut self, key: &str, values: &[f64]) {
        if let Some(bad) = values.iter().find(|v| !v.is_finite()) {
            self.add(key, format!("{bad} is not a finite number"), "give a finite number");
        }
    }

    fn positive(&mut self, key: &str, values: &[f64]) {
        if let Some(bad) = values.iter().find(|v| !(v.is_finite() && **v > 0.0)) {
            self.add(key, format!("{bad} m is not a size above 0"), "give a finite length above 0, in m");
        }
    }

    fn polygon(&mut self, polygon: &Polygon) {
        self.finite("position", &polygon.position);
        self.finite("rotation-deg", &[polygon.rotation_deg]);
        let curved = polygon.curved();
        let rings: Vec<Vec<[f64; 3]>> = std::iter::once(curved.outer).chain(curved.holes).collect();
        // At least three points, so that straight edges enclose an area.
        self.rings(&rings, 3);
    }

    fn curved_polygon(&mut self, polygon: &CurvedPolygon) {
        self.finite("position", &polygon.position);
        self.finite("rotation-deg", &[polygon.rotation_deg]);
        let rings: Vec<Vec<[f64; 3]>> = std::iter::once(&polygon.outer).chain(&polygon.holes).cloned().collect();
        self.rings(&rings, 2);
    }

    /// Checks the outer ring and the holes, with at least `least` points each.
    fn rings(&mut self, rings: &[Vec<[f64; 3]>], least: usize) {
        let before = self.found.len();
        for (k, ring) in rings.iter().enumerate() {
            self.ring(&key_of(k), ring, least);
        }
        if self.found.len() > before {
            return;
        }
        let curves: Vec<Vec<Curve>> = rings.iter().map(|ring| bulged_ring(ring).collect()).collect();
        let faults = faults(&curves);
        // A self-intersecting ring has both orientations, and may enclose no area.
        let crosses =
            |k: usize| faults.iter().any(|f| matches!(f, RingFault::SelfIntersection { ring, .. } if *ring == k));
        for k in (0..rings.len()).filter(|k| !crosses(*k)) {
            self.direction(&key_of(k), &curves[k], k == 0);
        }
        if self.found.len() == before {
            faults.iter().for_each(|fault| self.fault(fault));
        } else {
            let own = faults.iter().filter(|fault| matches!(fault, RingFault::SelfIntersection { .. }));
            own.for_each(|fault| self.fault(fault));
        }
    }

    /// Checks that the outer ring runs counter-clockwise and a hole clockwise.
    fn direction(&mut self, key: &str, ring: &[Curve], is_outer: bool) {
        let area: f64 = ring.iter().map(|edge| edge.area_about(ring[0].point(0.0))).sum();
        let (direction, wanted) = if area > 0.0 {
            ("counter-clockwise", "a hole runs clockwise: reverse its points")
        } else {
            ("clockwise", "the outer ring runs counter-clockwise: reverse its points")
        };
        if area == 0.0 {
            self.add(key, "the ring encloses no area", "its points must not lie on one line");
        } else if (area > 0.0) != is_outer {
            self.add(key, format!("the ring runs {direction}"), wanted);
        }
    }

    fn ring(&mut self, key: &str, points: &[[f64; 3]], least: usize) {
        let count = points.len();
        if count < least {
            let word = if least == 2 { "two" } else { "three" };
            self.add(key, format!("the ring has {count} point(s)"), format!("a ring needs at least {word} points"));
            return;
        }
        if points.iter().flatten().any(|v| !v.is_finite()) {
            self.finite(key, points.as_flattened());
            return;
        }
        let point = |i: usize| [points[i][0], points[i][1]];
        if point(0) == point(count - 1) {
            self.add(key, "the last point repeats the first", "remove the last point: rings close by themselves");
            return;
        }
        if let Some(i) = (1..count).find(|&i| point(i) == point(i - 1)) {
            let [x, y] = point(i);
            self.add(key, format!("points {} and {i} are both ({x:e}, {y:e})", i - 1), "remove one of them");
            return;
        }
        if let Some(i) = (0..count).find(|&i| points[i][2].abs() > LARGEST_BULGE) {
            self.add(
                key,
                format!("the bulge {:e} at point {i} makes an arc that is a full circle up to rounding", points[i][2]),
                "a bulge is the tangent of a quarter of the arc's angle: 1 is a half circle; write a circle as two half circles",
            );
        }
    }

    fn fault(&mut self, fault: &RingFault) {
        let (key, help) = match fault {
            RingFault::NotContained { .. } => ("holes".to_owned(), "each hole must lie wholly within the outer ring"),
            RingFault::OnALine { .. } | RingFault::OnAnArea { .. } => {
                ("holes".to_owned(), "rings of a polygon must not overlap: join overlapping holes into one")
            }
            RingFault::SelfIntersection { ring, .. } => {
                (key_of(*ring), "a ring must not cross or touch itself: move or remove the points of the loop")
            }
        };
        self.add(&key, fault.to_string(), help);
    }
}

/// The key of the outer ring and of the holes.
fn key_of(ring: usize) -> String {
    ring.checked_sub(1).map_or_else(|| "outer".to_owned(), |hole| format!("holes[{hole}]"))
}

/// Signed area of a ring in m², positive if counter-clockwise.
pub fn ring_area(points: &[[f64; 2]]) -> f64 {
    let Some(&first) = points.first() else { return 0.0 };
    let origin = Vec2::from(first);
    points.windows(2).map(|w| 0.5 * cross(Vec2::from(w[0]) - origin, Vec2::from(w[1]) - origin)).sum()
}
