//! The interface as points, and stencils: the points around a position, corrected for the fit of a circle.
//!
//! The level 1/2 of the smoothed color is displaced towards the center of curvature by h²κ/7 (`LINE_MOMENT`). A gradient of the curvature
//! deflects the interface from its circle by w with w'' = ∇κ·x along it, w = ∇κ·d |d|²/6 at the distance d.

use crate::cells::Cells;
use crate::domain::Domain;
use crate::surface_force::points::InterfacePoint;
use meniscus_core::math::{LINE_MOMENT, Vec2};
use meniscus_geometry::interface::weighted_circle::{WeightedCircle, WeightedPoint};

/// Radius r of the stencil of a fit over h.
pub(crate) const STENCIL_RADIUS: f64 = 3.0;

/// Number of times a stencil is moved to the closest point of its particle: by the circle around the nearest point, then by that around the
/// closest point found.
const CLOSEST_POINT_PASSES: usize = 2;

/// Squared distances with a smaller relative difference count as equal.
const TIE: f64 = 1e-9;

/// Cosine between normals below which a point belongs to another part of the interface.
const SAME_PIECE: f64 = 0.3;

/// Largest curvature over 1/h: smaller drops are not resolved.
const LARGEST_CURVATURE: f64 = 0.75;

/// Weight of a point at the squared distance `d2`, over h², from the middle of a stencil: a Gaussian, less its value at the end of the stencil.
///
/// A fit multiplies the curvature of a wave by the transform of the function whose second derivative is the weight times a quadratic polynomial. For a
/// Gaussian this is a Gaussian, positive for all waves. With (1 − d²/r²)^6 it is negative for waves of 1.7 to 2.2 spacings, so that a zigzag of the
/// particles grows in a liquid of low viscosity.
fn weight(d2: f64) -> f64 {
    (-d2).exp() - (-STENCIL_RADIUS * STENCIL_RADIUS).exp()
}

/// Weight of a point in a fit that is constrained to the contact angle: (1 − d²/r²)^6, wider in the middle and zero at the end of the stencil with all of five
/// derivatives, so that points far from the line, where a moving interface bends, count less.
fn weight_at_wall(d2: f64) -> f64 {
    (1.0 - d2 / (STENCIL_RADIUS * STENCIL_RADIUS)).max(0.0).powi(6)
}

/// Signed distance in m and normal of the wall at a point.
pub(crate) type Wall<'a> = dyn Fn(Vec2) -> (f64, Vec2) + Sync + 'a;

/// The interface as points, with the data for fits.
pub(crate) struct Interface<'a> {
    pub(super) points: &'a [InterfacePoint],
    pub(super) cells: Cells,
    pub(super) h: f64,
    pub(super) spacing: f64,
    /// ∇κ in 1/m² of an interface at rest.
    pub(super) gradient: Vec2,
    /// Approximate length of the next step in s.
    pub(super) step: f64,
    pub(super) wall: &'a Wall<'a>,
    pub(super) domain: &'a Domain,
}

impl<'a> Interface<'a> {
    /// The interface through `points`, sorted into cells, without gravity and motion; `spacing` of the particles and smoothing length `h` in m.
    pub(crate) fn new(
        points: &'a [InterfacePoint],
        domain: &'a Domain,
        spacing: f64,
        h: f64,
        wall: &'a Wall<'a>,
    ) -> Self {
        let positions: Vec<Vec2> = points.iter().map(|p| p.x).collect();
        let cells = Cells::build(&positions, domain, STENCIL_RADIUS * h);
        Self { points, cells, h, spacing, gradient: Vec2::zeros(), step: 0.0, wall, domain }
    }

    /// Index of the nearest point and x − x_p; all equidistant ones, so that a symmetric flow remains symmetric.
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
    /// The closest point moves continuously with x. The nearest point does not: on a rough interface it is in the dents for particles inside and on
    /// the bumps for those outside, so that the curvatures on the two sides differ. Near a wall the interface ends, and a closest point may lie
    /// behind the wall or at the other line of a small base: there the stencil remains around the nearest point.
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

    /// The points of the part of the interface with about the unit `normal` within the stencil around `x_p` (m).
    pub(super) fn stencil(&self, normal: Vec2, x_p: Vec2) -> Vec<WeightedPoint> {
        let reach2 = (STENCIL_RADIUS * self.h).powi(2);
        let mut near = Vec::new();
        self.cells.visit_near(x_p, |i, r| {
            let index = i as usize;
            let d2 = r.norm_squared();
            if d2 < reach2 && self.points[index].normal.dot(&normal) > SAME_PIECE {
                let weight = self.points[index].weight * weight(d2 / (self.h * self.h));
                near.push(WeightedPoint { index, x: -r, weight });
            }
        });
        near
    }

    /// The points of a stencil with the weights of a fit that is constrained to the contact angle.
    pub(super) fn weighted_for_wall(&self, near: &[WeightedPoint]) -> Vec<WeightedPoint> {
        let weighted = |q: &WeightedPoint| {
            let weight = self.points[q.index].weight * weight_at_wall(q.x.norm_squared() / (self.h * self.h));
            WeightedPoint { weight, ..*q }
        };
        near.iter().map(weighted).collect()
    }

    /// The unconstrained circle through a stencil with about the unit `normal`.
    pub(super) fn circle(&self, near: &[WeightedPoint], normal: Vec2) -> Option<WeightedCircle> {
        WeightedCircle::through(&self.of_one_curvature(near, Vec2::zeros()), normal)
    }

    /// The points of a stencil moved from the level 1/2 of the smoothed color to the interface, which has the curvature `kappa` (1/m)
    /// in the middle of the stencil.
    pub(super) fn on_interface(&self, near: &[WeightedPoint], kappa: f64) -> Vec<WeightedPoint> {
        let limit = self.limit();
        let offset = |x: Vec2| LINE_MOMENT * self.h * self.h * (kappa + self.gradient.dot(&x)).clamp(-limit, limit);
        near.iter().map(|q| WeightedPoint { x: q.x - offset(q.x) * self.points[q.index].normal, ..*q }).collect()
    }

    /// The points of a stencil advected with the interface to the end of the step.
    pub(super) fn at_end_of_step(&self, near: &[WeightedPoint]) -> Vec<WeightedPoint> {
        let moved = |q: &WeightedPoint| {
            let point = &self.points[q.index];
            WeightedPoint { x: q.x + self.step * point.velocity.dot(&point.normal) * point.normal, ..*q }
        };
        near.iter().map(moved).collect()
    }

    /// The points of a stencil corrected to an interface with the uniform curvature that it has at `origin`.
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

#[cfg(test)]
pub(super) mod fixture {
    //! Interfaces for tests.

    use std::f64::consts::TAU;
    use std::sync::LazyLock;

    use super::*;
    use meniscus_core::math::Bounds;

    pub(crate) const H: f64 = 0.15;

    static DOMAIN: LazyLock<Domain> =
        LazyLock::new(|| Domain::new(Bounds { min: Vec2::repeat(-3.0), max: Vec2::repeat(3.0) }, [false; 2], vec![]));

    pub(crate) fn interface<'a>(points: &'a [InterfacePoint], wall: &'a Wall<'a>) -> Interface<'a> {
        Interface::new(points, &DOMAIN, 0.1, H, wall)
    }

    pub(crate) fn floor(x: Vec2) -> (f64, Vec2) {
        (x.y, Vec2::y())
    }

    /// Unit vectors in all directions, the first one turned by this share of their distance.
    pub(crate) fn directions(turned: f64) -> impl Iterator<Item = Vec2> {
        (0..400).map(move |i| TAU * (f64::from(i) + turned) / 400.0).map(|t| Vec2::new(t.cos(), t.sin()))
    }

    /// An interface at rest through those of the points, given with their normals, that are outside the wall.
    pub(crate) fn at_rest(points: impl Iterator<Item = (Vec2, Vec2)>, wall: &Wall) -> Vec<InterfacePoint> {
        points
            .map(|(x, normal)| (x, normal, wall(x)))
            .filter(|(.., (wall_distance, _))| *wall_distance > 0.0)
            .map(|(x, normal, (wall_distance, wall_normal))| {
                let velocity = Vec2::zeros();
                InterfacePoint { x, normal, velocity, wall_distance, wall_normal, touches: true, weight: 1.0 }
            })
            .collect()
    }
}
