//! The pore geometry: signed distance to the solid, its normal, and the domain.
//!
//! The surface of the solid is represented by exact segments and circular arcs (the cosine wall to 1e-8 of its length), so that distances are exact in the pore
//! and in the solid, overlaps included. Infinite shapes in a periodic domain are repeated as their part within the domain; all others are repeated as a whole.

use crate::body::Body;
use crate::boundary::{Boundary, Nearest, clip_body, complement, union};
use crate::curve::Curve;
use crate::spec::{GeometrySpec, ShapeSpec, SolidSide};
use crate::surface;
use crate::tree::Tree;
use crate::weld::welded;
use meniscus_core::input::problem::Problem;
use meniscus_core::math::{Bounds, FNV1A_BASIS, Vec2, fnv1a};
use rayon::prelude::*;

/// Lengths below this fraction of the domain's larger side count as zero at intersections.
const TOLERANCE: f64 = 1e-9;
/// Ends nearer than this many tolerances coincide: intersections are computed twice, once on each curve.
const ROUNDING: f64 = 10.0;

/// The wall nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Distance to the wall in m, above 0 in the pore; infinite without solid.
    pub distance: f64,
    /// Unit normal into the pore, the gradient of the distance; zero without solid.
    pub normal: Vec2,
    /// Index of the nearest shape; walls on the domain's sides follow the shapes of the file; `u32::MAX` for none.
    pub shape: u32,
}

/// Why a geometry is invalid.
#[derive(Debug, thiserror::Error)]
pub enum GeometryError {
    /// The specified shapes are invalid.
    #[error("the geometry has {} problem(s): {}", .0.len(), list(.0))]
    Invalid(Vec<Problem>),
}

impl GeometryError {
    /// The problems with their paths in a case file, where the shapes are those of its `[geometry]`.
    pub fn problems_of_case(&self) -> Vec<Problem> {
        let Self::Invalid(problems) = self;
        problems.iter().map(|one| Problem { path: format!("geometry.{}", one.path), ..one.clone() }).collect()
    }
}

fn list(problems: &[Problem]) -> String {
    problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}

/// Whether two normals agree: pieces that join at the nearest point have the same normal there, up to rounding.
fn is_same(a: &Vec2, b: &Vec2) -> bool {
    const SAME: f64 = 1e-6;
    (a - b).norm() <= SAME
}

/// The distinct normals.
fn different(mut normals: Vec<Vec2>) -> Vec<Vec2> {
    // Beyond this number each is compared with its neighbors in angle only: all edges of a circular ring are equally near to its center.
    const MANY: usize = 64;
    if normals.len() > MANY {
        normals.sort_by(|a, b| a.y.atan2(a.x).total_cmp(&b.y.atan2(b.x)));
        normals.dedup_by(|a, b| is_same(a, b));
        return normals;
    }
    let mut kept: Vec<Vec2> = Vec::new();
    for normal in normals {
        if !kept.iter().any(|known| is_same(known, &normal)) {
            kept.push(normal);
        }
    }
    kept
}

/// Domain and solids.
#[derive(Clone)]
pub struct Geometry {
    domain: Bounds,
    side: SolidSide,
    shapes: Vec<Body>,
    periodic: [bool; 2],
    wall_sides: [bool; 4],
    shape_count: u32,
    bodies: Vec<Body>,
    /// The tree over the boxes of `bodies`.
    tree: Tree,
    walls: Vec<Body>,
    pub(crate) boundary: Boundary,
}

impl std::fmt::Debug for Geometry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Geometry")
            .field("domain", &self.domain)
            .field("shapes", &self.shape_count)
            .field("pieces", &self.boundary.pieces.len())
            .finish_non_exhaustive()
    }
}

impl Geometry {
    /// The geometry of a shape file.
    ///
    /// # Errors
    /// [`GeometryError::Invalid`] with all problems found.
    pub fn new(spec: &GeometrySpec) -> Result<Self, GeometryError> {
        let problems = spec.problems_of_parts();
        if !problems.is_empty() {
            return Err(GeometryError::Invalid(problems));
        }
        let geometry = Self::unchecked(spec);
        match spec.problem_of_pore(&geometry) {
            Some(problem) => Err(GeometryError::Invalid(vec![problem])),
            None => Ok(geometry),
        }
    }

    /// The geometry of a specification whose sizes are known to be valid.
    pub fn unchecked(spec: &GeometrySpec) -> Self {
        let domain = Bounds { min: Vec2::from(spec.min), max: Vec2::from(spec.max) };
        let shapes = welded(&spec.shapes, domain);
        let bodies = |(i, shape): (usize, &ShapeSpec)| Body::of(shape, i as u32, domain);
        let shapes = shapes.par_iter().enumerate().flat_map_iter(bodies).collect();
        Self {
            domain,
            side: spec.solid,
            shapes,
            periodic: [false; 2],
            wall_sides: [false; 4],
            shape_count: spec.shapes.len() as u32,
            bodies: Vec::new(),
            tree: Tree::over([]),
            walls: Vec::new(),
            boundary: Boundary::new(Vec::new(), 0.0),
        }
        .rebuilt()
    }

    /// The solid with a given surface: `pieces` with the solid on their left, which end only at the sides of the domain. Repeated by whole periods if the
    /// domain is periodic along x or y; at other sides the surface continues straight outwards.
    ///
    /// Queries use the nearest piece only, so that they are valid in the domain and near it.
    pub fn of_surface(domain: Bounds, periodic: [bool; 2], pieces: &[Curve]) -> Self {
        let spec = GeometrySpec {
            min: domain.min.into(),
            max: domain.max.into(),
            solid: SolidSide::Inside,
            shapes: Vec::new(),
        };
        let mut empty = Self { periodic, ..Self::unchecked(&spec) };
        let tolerance = ROUNDING * empty.tolerance();
        empty.boundary = Boundary::new(surface::whole(domain, periodic, pieces, tolerance), tolerance);
        empty
    }

    /// A hash of the domain and of the specified shapes, bit by bit (FNV-1a); independent of the sides.
    pub fn hash(&self) -> u64 {
        let side = f64::from(self.side == SolidSide::Inside);
        let corners = [self.domain.min.x, self.domain.min.y, self.domain.max.x, self.domain.max.y, side];
        let curves = self.shapes.iter().flat_map(|body| body.curves.iter()).flat_map(|curve| curve.numbers());
        let bytes = corners.into_iter().chain(curves).flat_map(|value| value.to_bits().to_le_bytes());
        fnv1a(FNV1A_BASIS, bytes)
    }

    /// The domain.
    pub fn bounds(&self) -> Bounds {
        self.domain
    }

    /// Number of specified shapes; walls on the left, right, bottom and top side have the four following indices.
    pub fn shape_count(&self) -> u32 {
        self.shape_count
    }

    /// Whether the domain is periodic along x and y.
    pub fn periodic(&self) -> [bool; 2] {
        self.periodic
    }

    /// Whether there is solid outside the left, right, bottom and top side.
    pub fn wall_sides(&self) -> [bool; 4] {
        self.wall_sides
    }

    /// The same solids with both: periodic along x and y, and solid outside the chosen sides (left, right, bottom, top).
    pub fn with_sides(self, periodic: [bool; 2], wall_sides: [bool; 4]) -> Self {
        let is_same = self.periodic == periodic && self.wall_sides == wall_sides;
        if is_same { self } else { Self { periodic, wall_sides, ..self }.rebuilt() }
    }

    /// The same solids with the periodic images of the domain along x and y.
    pub fn with_periodic(self, periodic: [bool; 2]) -> Self {
        let wall_sides = self.wall_sides;
        self.with_sides(periodic, wall_sides)
    }

    /// The same solids with solid half-planes outside the chosen sides: left, right, bottom, top.
    pub fn with_wall_sides(self, wall_sides: [bool; 4]) -> Self {
        let periodic = self.periodic;
        self.with_sides(periodic, wall_sides)
    }

    /// Lengths in m below this count as zero.
    pub(crate) fn tolerance(&self) -> f64 {
        TOLERANCE * self.domain.size().max()
    }

    fn rebuilt(mut self) -> Self {
        let tolerance = self.tolerance();
        self.bodies = self.distinct().into_par_iter().flat_map_iter(|body| self.images(body)).collect();
        self.tree = Tree::over(self.bodies.iter().map(|body| body.bounds));
        self.walls = self.side_walls();
        let (bodies, walls): (Vec<&Body>, Vec<&Body>) = (self.bodies.iter().collect(), self.walls.iter().collect());
        let pieces = match self.side {
            SolidSide::Inside => union(&[bodies, walls].concat(), tolerance),
            SolidSide::Outside => complement(&bodies, &walls, tolerance),
        };
        self.boundary = Boundary::new(pieces, ROUNDING * tolerance);
        self
    }

    /// The shapes without copies of others by whole periods: drawings often have a grain that crosses a periodic side at both sides.
    fn distinct(&self) -> Vec<&Body> {
        if self.periodic == [false; 2] {
            return self.shapes.iter().collect();
        }
        let (size, tolerance) = (self.domain.size(), self.tolerance());
        let crosses = |body: &Body| {
            let sides = |i: usize| body.bounds.min[i] < self.domain.min[i] || body.bounds.max[i] > self.domain.max[i];
            !body.is_endless() && (0..2).any(|i| self.periodic[i] && sides(i))
        };
        let is_copy = |one: &Body, other: &Body| {
            let mut shift = other.bounds.min - one.bounds.min;
            for i in 0..2 {
                shift[i] = if self.periodic[i] { size[i] * (shift[i] / size[i]).round() } else { 0.0 };
            }
            let is_near = |a: Vec2, b: Vec2| (a + shift - b).norm() <= tolerance;
            let curves = || one.curves.iter().zip(other.curves.iter());
            is_near(one.bounds.min, other.bounds.min)
                && is_near(one.bounds.max, other.bounds.max)
                && one.curves.iter().count() == other.curves.iter().count()
                && curves().all(|(a, b)| [0.0, 0.5, 1.0].iter().all(|&u| is_near(a.point(u), b.point(u))))
        };
        let mut crossing: Vec<&Body> = Vec::new();
        let mut found = Vec::new();
        for body in &self.shapes {
            if crosses(body) {
                if crossing.iter().any(|one| is_copy(one, body)) {
                    continue;
                }
                crossing.push(body);
            }
            found.push(body);
        }
        found
    }

    /// The body and its periodic images that can be nearest to a point of the domain: those that reach into the domain grown by its own size (the nearest
    /// point of a periodic solid is at most half a period away along that axis).
    fn images(&self, body: &Body) -> Vec<Body> {
        if self.periodic == [false; 2] {
            return vec![body.clone()];
        }
        let size = self.domain.size();
        let mut body = body.clone();
        if body.is_endless() {
            // Far beyond all queries along the non-periodic axis.
            const FAR: f64 = 32.0;
            let mut strip = self.domain.grown(FAR * size.norm());
            for i in (0..2).filter(|&i| self.periodic[i]) {
                (strip.min[i], strip.max[i]) = (self.domain.min[i], self.domain.max[i]);
            }
            body = clip_body(&body, strip, self.tolerance());
        }
        let shifts = surface::shifts(self.domain, self.periodic, body.bounds, 1.0);
        shifts.into_iter().map(|by| body.shifted(by)).collect()
    }

    fn side_walls(&self) -> Vec<Body> {
        use std::f64::consts::{FRAC_PI_2, PI};
        let Bounds { min, max } = self.domain;
        // An unrotated half-plane is solid below its line.
        [(min, -FRAC_PI_2), (max, FRAC_PI_2), (min, 0.0), (max, PI)]
            .into_iter()
            .enumerate()
            .filter(|(side, _)| self.wall_sides[*side])
            .map(|(side, (point, turn))| Body::half_plane(self.shape_count + side as u32, point, turn, self.domain))
            .collect()
    }

    /// `x` wrapped into the domain along the periodic axes.
    pub fn wrapped(&self, x: Vec2) -> Vec2 {
        let (min, size) = (self.domain.min, self.domain.size());
        let mut y = x;
        for i in (0..2).filter(|&i| self.periodic[i]) {
            if !(min[i] <= x[i] && x[i] <= self.domain.max[i]) {
                y[i] = min[i] + (x[i] - min[i]).rem_euclid(size[i]);
            }
        }
        y
    }

    /// Whether `x` lies in the solid, by the inside tests of the shapes.
    pub fn is_solid(&self, x: Vec2) -> bool {
        let x = self.wrapped(x);
        let within = |body: &Body| body.bounds.contains(x) && body.signed_distance(x) < 0.0;
        let in_shapes = self.tree.near(Bounds { min: x, max: x }).any(|i| within(&self.bodies[i]));
        (in_shapes == (self.side == SolidSide::Inside)) || self.walls.iter().any(within)
    }

    /// Distance and normal of the nearest wall at `x`. Exact up to a box's size outside the domain.
    ///
    /// Where several walls are equally near, as on a corner or on the bisector of a reentrant one, the normal is the mean of theirs, so that no side is
    /// preferred; between opposite walls, where that mean vanishes, it is the normal of one of them.
    pub fn wall(&self, x: Vec2) -> Wall {
        let x = self.wrapped(x);
        let wall = self.nearest_wall(x);
        Wall { normal: self.mean_normal(x, &wall).unwrap_or(wall.normal), ..wall }
    }

    fn nearest_wall(&self, x: Vec2) -> Wall {
        match self.boundary.nearest(x) {
            Some(nearest) => self.wall_at(x, nearest),
            None if self.is_solid(x) => Wall { distance: f64::NEG_INFINITY, normal: Vec2::zeros(), shape: u32::MAX },
            None => Wall { distance: f64::INFINITY, normal: Vec2::zeros(), shape: u32::MAX },
        }
    }

    /// The mean of the distinct normals of all walls that are as near to `x` as `nearest`; `None` if there is only one, or if they cancel.
    fn mean_normal(&self, x: Vec2, nearest: &Wall) -> Option<Vec2> {
        // Opposite walls; below the value for any wedge accessible to particles.
        const CANCELED: f64 = 1e-3;
        if !nearest.distance.is_finite() {
            return None;
        }
        let near = self.boundary.within(x, nearest.distance.abs() + self.tolerance());
        let normals = near.map(|near| self.wall_at(x, near).normal);
        let others = different(normals.filter(|normal| !is_same(normal, &nearest.normal)).collect());
        let sum = nearest.normal + others.iter().sum::<Vec2>();
        if others.is_empty() { None } else { sum.try_normalize(CANCELED) }
    }

    pub(crate) fn wall_at(&self, x: Vec2, Nearest { piece, closest }: Nearest) -> Wall {
        let curve = &self.boundary.pieces[piece].curve;
        let shape = self.boundary.pieces[piece].shape;
        let offset = x - closest.point;
        let flat = curve.normal(closest.u);
        if curve.is_closed() || (closest.u > 0.0 && closest.u < 1.0) {
            return Wall { distance: offset.dot(&flat), normal: flat, shape };
        }
        let corner = self.boundary.corners[piece][usize::from(closest.u > 0.5)];
        let distance = offset.norm();
        // So near to the corner the direction is lost to rounding.
        const AT_CORNER: f64 = 1e-3;
        if distance <= AT_CORNER * self.tolerance() {
            return Wall { distance: 0.0, normal: flat, shape };
        }
        let in_pore = match corner {
            // Relative to the nearest corner, `x` lies in the cone of its two normals, or in the opposite cone.
            Some(mean) => offset.dot(&mean) > 0.0,
            None => !self.is_solid(x),
        };
        let sign = if in_pore { 1.0 } else { -1.0 };
        Wall { distance: sign * distance, normal: offset * (sign / distance), shape }
    }

    /// Distance to the wall at `x` in m, above 0 in the pore.
    pub fn signed_distance(&self, x: Vec2) -> f64 {
        self.nearest_wall(self.wrapped(x)).distance
    }
}
