//! The interface as points, and stencils: the points around one place, and where they would lie for a fit of one circle.
//!
//! The level 1/2 of the smoothed color is drawn towards the center of curvature by h²κ/7 (`LINE_MOMENT`). A gradient of the curvature
//! bends the interface away from its circle by the deflection w with w'' = ∇κ·x along it, w = ∇κ·d |d|²/6 at the distance d.

use crate::interface::weighted_circle::{WeightedCircle, WeightedPoint};
use crate::math::{LINE_MOMENT, Vec2};
use crate::sph::cells::Cells;
use crate::sph::domain::Domain;
use crate::sph::surface_force::points::{InterfacePoint, Resolution};

/// Radius r of the stencil of a fit over h.
pub(crate) const STENCIL_RADIUS: f64 = 3.0;

/// A point at the distance d has the weight (1 − d²/r²) to this power. Two sees waves of two to three spacings upside down.
pub(crate) const SMOOTHNESS: i32 = 6;

/// A stencil is moved to the closest point of its particle so many times: by the circle around the nearest point, and by that around the
/// closest point found.
const CLOSEST_POINT_PASSES: usize = 2;

/// Squared distances that differ by less than this share are equal.
const TIE: f64 = 1e-9;

/// Points whose normal turns away more than this (cosine) belong to another piece of interface.
const SAME_PIECE: f64 = 0.3;

/// Largest curvature over 1/h: smaller drops are not resolved.
const LARGEST_CURVATURE: f64 = 0.75;

/// Signed distance in m and normal of the wall at a point.
pub(crate) type Wall<'a> = dyn Fn(Vec2) -> (f64, Vec2) + Sync + 'a;

/// The interface as points, with what fits to them need to know.
pub(crate) struct Interface<'a> {
    pub(super) points: &'a [InterfacePoint],
    pub(super) cells: Cells,
    pub(super) h: f64,
    pub(super) spacing: f64,
    /// ∇κ in 1/m² of an interface at rest.
    pub(super) gradient: Vec2,
    /// Length of the coming step in s, about.
    pub(super) step: f64,
    pub(super) wall: &'a Wall<'a>,
    pub(super) domain: &'a Domain,
}

impl<'a> Interface<'a> {
    /// Sorts the points.
    pub(crate) fn new(
        points: &'a [InterfacePoint],
        domain: &'a Domain,
        Resolution { spacing, h }: Resolution,
        wall: &'a Wall<'a>,
    ) -> Self {
        let places: Vec<Vec2> = points.iter().map(|p| p.x).collect();
        let cells = Cells::build(&places, domain, STENCIL_RADIUS * h);
        Self { points, cells, h, spacing, gradient: Vec2::zeros(), step: 0.0, wall, domain }
    }

    /// The same interface under gravity, with the gradient (1/m²) of its curvature at rest.
    pub(crate) fn under(self, gradient: Vec2) -> Self {
        Self { gradient, ..self }
    }

    /// Index of the nearest point and x − x_p; all of those that are equally near, so that a mirrored flow stays mirrored.
    pub(super) fn nearest(&self, x: Vec2) -> Vec<(usize, Vec2)> {
        let mut least = (STENCIL_RADIUS * self.h).powi(2);
        let mut nearest = Vec::new();
        self.cells.visit_near(x, |i, r| {
            if r.norm_squared() <= least * (1.0 + TIE) {
                least = least.min(r.norm_squared());
                nearest.push((i as usize, r));
            }
        });
        nearest.retain(|(_, r)| r.norm_squared() <= least * (1.0 + TIE));
        nearest
    }

    /// The closest point of `x` (m) on the interface near the point `nearest` of it, and the stencil there.
    ///
    /// The closest point moves as x does. The nearest point does not: particles inside see the dents of a rough interface and those outside its
    /// bumps, so that the curvatures on both sides of one place differ. Near a wall the interface ends, and a closest point may lie behind the
    /// wall or at the other line of a small base: there the stencil stays around the nearest point.
    pub(super) fn stencil_at_closest_point(
        &self,
        nearest: InterfacePoint,
        x: Vec2,
    ) -> (InterfacePoint, Vec<WeightedPoint>) {
        let mut point = nearest;
        let mut near = self.stencil(point.normal, point.x);
        if nearest.wall_distance.is_finite() {
            return (point, near);
        }
        for _ in 0..CLOSEST_POINT_PASSES {
            let circle = self.circle(&near, point.normal);
            let Some((closest, normal)) = circle.and_then(|circle| circle.closest_point(x - point.x)) else { break };
            point.x += closest * (self.h / closest.norm()).min(1.0);
            point.normal = normal;
            near = self.stencil(point.normal, point.x);
        }
        (point, near)
    }

    /// The points of the piece with about the unit `normal` within the stencil around `x_p` (m).
    pub(super) fn stencil(&self, normal: Vec2, x_p: Vec2) -> Vec<WeightedPoint> {
        let reach2 = (STENCIL_RADIUS * self.h).powi(2);
        let mut near = Vec::new();
        self.cells.visit_near(x_p, |i, r| {
            let index = i as usize;
            let d2 = r.norm_squared();
            if d2 < reach2 && self.points[index].normal.dot(&normal) > SAME_PIECE {
                near.push(WeightedPoint {
                    index,
                    x: -r,
                    weight: self.points[index].weight * (1.0 - d2 / reach2).powi(SMOOTHNESS),
                });
            }
        });
        near
    }

    /// The circle through a stencil with about the unit `normal`, free of walls.
    pub(super) fn circle(&self, near: &[WeightedPoint], normal: Vec2) -> Option<WeightedCircle> {
        WeightedCircle::through(&self.of_one_curvature(near, Vec2::zeros()), normal)
    }

    /// The points of a stencil moved from the level 1/2 of the smoothed color to the interface, which has the curvature `kappa` (1/m)
    /// in the middle of the stencil.
    pub(super) fn on_interface(&self, near: &[WeightedPoint], kappa: f64) -> Vec<WeightedPoint> {
        let limit = self.limit();
        let drawn = |x: Vec2| LINE_MOMENT * self.h * self.h * (kappa + self.gradient.dot(&x)).clamp(-limit, limit);
        near.iter().map(|q| WeightedPoint { x: q.x - drawn(q.x) * self.points[q.index].normal, ..*q }).collect()
    }

    /// The points of a stencil where the interface carries them by the end of the step.
    pub(super) fn at_end_of_step(&self, near: &[WeightedPoint]) -> Vec<WeightedPoint> {
        let moved = |q: &WeightedPoint| {
            let point = &self.points[q.index];
            WeightedPoint { x: q.x + self.step * point.velocity.dot(&point.normal) * point.normal, ..*q }
        };
        near.iter().map(moved).collect()
    }

    /// The points of a stencil as they would lie if the interface had everywhere the curvature that it has at `origin`.
    pub(super) fn of_one_curvature(&self, near: &[WeightedPoint], origin: Vec2) -> Vec<WeightedPoint> {
        near.iter()
            .map(|q| {
                let d = q.x - origin;
                let deflection = self.gradient.dot(&d) * d.norm_squared() / 6.0;
                WeightedPoint { x: q.x - deflection * self.points[q.index].normal, ..*q }
            })
            .collect()
    }

    /// Largest curvature in 1/m.
    pub(super) fn limit(&self) -> f64 {
        LARGEST_CURVATURE / self.h
    }
}
