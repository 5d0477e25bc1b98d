//! Curvature of the interface from local fits of circles (`circles`), free in the bulk and held to the contact angle at walls.

use crate::math::{Vec2, perpendicular};
use crate::sph::cells::Cells;
use crate::sph::domain::Domain;
use crate::sph::surface_force::circles::{Near, fit_from_contact, free_fit};
use crate::sph::surface_force::points::InterfacePoint;

/// Radius of the window of a fit over h.
pub const WINDOW: f64 = 2.5;

/// Squared distances that differ by less than this share are equal.
const TIE: f64 = 1e-9;

/// Points whose normal turns away more than this (cosine) belong to another piece of interface.
const SAME_PIECE: f64 = 0.3;

/// Fewest points of a fit from the wall: two unknowns and some redundancy. A line that moves fast parts the particles at its
/// tip, and few pairs span the interface there.
pub(super) const FEWEST_HELD: usize = 3;

/// Largest curvature over 1/h: smaller drops are not resolved.
const LARGEST_CURVATURE: f64 = 0.75;

/// Share of the normal along the wall below which the interface runs parallel to it and has no contact line.
const SMALLEST_TANGENT: f64 = 0.1;

/// Way along the interface to the wall, over h, below which the fit is held to the contact angle; fades in over 2h.
const REACH: f64 = 3.0;

/// Largest difference of the angle used from the present one, so that far starts move and do not tear: 45 degrees.
const LARGEST_PULL: f64 = std::f64::consts::FRAC_PI_4;

/// The contact point is projected on a curved wall at most so many times; each gains more than a digit.
const PROJECTIONS: usize = 4;

/// Walls whose normals differ by less than this are the same straight wall, in rad.
const SAME_NORMAL: f64 = 1e-4;

/// Signed distance in m and normal of the wall at a point.
pub type Wall<'a> = dyn Fn(Vec2) -> (f64, Vec2) + Sync + 'a;

/// The angle in rad at which the interface is to meet the wall at a point of it (m), with ν_ns there.
pub type AngleAt<'a> = dyn Fn(Vec2, Vec2) -> f64 + Sync + 'a;

/// The interface, ready for fits.
pub struct InterfaceFit<'a> {
    pub(super) points: &'a [InterfacePoint],
    pub(super) cells: Cells,
    pub(super) h: f64,
    pub(super) spacing: f64,
    /// Angle of the wetting law, where there is one.
    angle: Option<&'a AngleAt<'a>>,
    pub(super) wall: &'a Wall<'a>,
}

/// Where the straight continuation of the interface meets the wall.
pub(super) struct Foot {
    /// From the point of the interface to the wall, in m.
    pub(super) contact: Vec2,
    /// Wall normal there.
    pub(super) normal: Vec2,
    /// ν_ns there.
    pub(super) outwards: Vec2,
    /// Way along the interface to the wall in m.
    pub(super) way: f64,
}

impl<'a> InterfaceFit<'a> {
    /// Sorts the points; the interface meets walls at any angle.
    #[must_use]
    pub fn new(points: &'a [InterfacePoint], domain: &Domain, (spacing, h): (f64, f64), wall: &'a Wall<'a>) -> Self {
        let places: Vec<Vec2> = points.iter().map(|p| p.x).collect();
        let cells = Cells::build(&places, domain, WINDOW * h);
        Self { points, cells, h, spacing, angle: None, wall }
    }

    /// The same interface, which is to meet walls at the given angle.
    #[must_use]
    pub fn held_to(self, angle: &'a AngleAt<'a>) -> Self {
        Self { angle: Some(angle), ..self }
    }

    /// Curvature in 1/m of the interface nearest to `x`, none where there is no interface within the window.
    #[must_use]
    pub fn curvature(&self, x: Vec2) -> Option<f64> {
        let (sum, count) = self
            .nearest(x)
            .into_iter()
            .filter_map(|(p, from_p)| self.curvature_at(p, x - from_p))
            .fold((0.0, 0), |(sum, count), kappa| (sum + kappa, count + 1));
        (count > 0).then(|| sum / f64::from(count))
    }

    /// The curvature from the window around the point `p`, which lies at `x_p` next to the particle asked for.
    fn curvature_at(&self, p: usize, x_p: Vec2) -> Option<f64> {
        let point = &self.points[p];
        let near = self.window(point.normal, x_p);
        let free = free_fit(&near, point.normal);
        let limit = LARGEST_CURVATURE / self.h;
        let held = self.held_fit(point, &near);
        let kappa = match (held, free) {
            (Some((held, share)), Some(free)) => share * held + (1.0 - share) * free,
            (Some((held, _)), None) => held,
            (None, free) => free?,
        };
        kappa.is_finite().then(|| kappa.clamp(-limit, limit))
    }

    /// Index of the nearest point and x − x_p; all of those that are equally near, so that a mirrored flow stays mirrored.
    fn nearest(&self, x: Vec2) -> Vec<(usize, Vec2)> {
        let mut least = (WINDOW * self.h).powi(2);
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

    /// The points of the piece with about the unit `normal` within the window around `x_p` (m).
    pub(super) fn window(&self, normal: Vec2, x_p: Vec2) -> Vec<Near> {
        let reach2 = (WINDOW * self.h).powi(2);
        let mut near = Vec::new();
        self.cells.visit_near(x_p, |i, r| {
            let index = i as usize;
            let d2 = r.norm_squared();
            if d2 < reach2 && self.points[index].normal.dot(&normal) > SAME_PIECE {
                near.push(Near { index, x: -r, weight: (1.0 - d2 / reach2).powi(2) });
            }
        });
        near
    }

    /// The straight way from `point` to a wall in reach, none where the interface runs along the wall.
    pub(super) fn foot(&self, point: &InterfacePoint) -> Option<Foot> {
        if !point.wall_distance.is_finite() {
            return None;
        }
        let slope = along(point.normal, point.wall_normal).norm();
        if slope < SMALLEST_TANGENT {
            return None;
        }
        let way = point.wall_distance.max(0.0) / slope.max(2.0 * SMALLEST_TANGENT);
        // Down along the interface to the wall, then onto it.
        let mut down = perpendicular(point.normal);
        if down.dot(&point.wall_normal) > 0.0 {
            down = -down;
        }
        let foot = point.x + way * down;
        let (distance, normal) = (self.wall)(foot);
        let contact = foot - distance * normal - point.x;
        let outwards = outwards_of(point.normal, normal)?;
        Some(Foot { contact, normal, outwards, way })
    }

    /// The curvature held to the contact angle, and its share, where the interface meets a wall near `point`.
    fn held_fit(&self, point: &InterfacePoint, near: &[Near]) -> Option<(f64, f64)> {
        let angle_at = self.angle?;
        let touches = near.iter().any(|q| self.points[q.index].touches);
        if !touches || near.len() < FEWEST_HELD {
            return None;
        }
        let Foot { mut contact, mut normal, mut outwards, way } = self.foot(point)?;
        let share = ((REACH * self.h - way) / (2.0 * self.h)).clamp(0.0, 1.0);
        if share == 0.0 {
            return None;
        }
        let mut kappa = None;
        for _ in 0..PROJECTIONS {
            let present = (-point.normal.dot(&normal)).clamp(-1.0, 1.0).acos();
            let angle = angle_at(point.x + contact, outwards).clamp(present - LARGEST_PULL, present + LARGEST_PULL);
            let (found, delta) = fit_from_contact(near, contact, (outwards, normal), angle)?;
            kappa = Some(found);
            // The contact point found lies on the tangent of the wall; a curved wall is looked at again there.
            let place = point.x + contact + delta.clamp(-self.h, self.h) * outwards;
            let (distance, there) = (self.wall)(place);
            if (there - normal).norm() < SAME_NORMAL {
                break;
            }
            (contact, normal) = (place - distance * there - point.x, there);
            outwards = outwards_of(point.normal, normal)?;
        }
        kappa.map(|kappa| (kappa, share))
    }
}

/// The part of `n` along the wall with the normal `e`.
fn along(n: Vec2, e: Vec2) -> Vec2 {
    n - n.dot(&e) * e
}

/// ν_ns: the unit vector along the wall towards the non-wetting phase, none where the interface runs along the wall.
fn outwards_of(normal: Vec2, wall_normal: Vec2) -> Option<Vec2> {
    (-along(normal, wall_normal)).try_normalize(0.5 * SMALLEST_TANGENT)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Bounds;

    const H: f64 = 0.15;

    fn domain() -> Domain {
        Domain::new(Bounds { min: Vec2::repeat(-3.0), max: Vec2::repeat(3.0) }, [false; 2], vec![])
    }

    /// Points of a circle of radius 1 about (0, `height`) above the floor y = 0.
    fn circle(height: f64) -> Vec<InterfacePoint> {
        (0..400)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 400.0)
            .map(|t| Vec2::new(t.cos(), t.sin()))
            .map(|n| (n + Vec2::new(0.0, height), -n))
            .filter(|(x, _)| x.y > 0.0)
            .map(|(x, normal)| InterfacePoint {
                x,
                normal,
                velocity: Vec2::zeros(),
                wall_distance: x.y,
                wall_normal: Vec2::y(),
                touches: true,
            })
            .collect()
    }

    fn floor(x: Vec2) -> (f64, Vec2) {
        (x.y, Vec2::y())
    }

    #[test]
    fn the_curvature_of_a_circle_is_one_over_its_radius() {
        let points = circle(2.0);
        let fit = InterfaceFit::new(&points, &domain(), (0.1, H), &floor);
        for t in [0.0_f64, 0.7, 2.0, 4.0] {
            let x = Vec2::new(0.0, 2.0) + 1.1 * Vec2::new(t.cos(), t.sin());
            let kappa = fit.curvature(x).unwrap();
            assert!((kappa - 1.0).abs() < 1e-9, "{kappa}");
        }
        assert_eq!(fit.curvature(Vec2::new(0.0, 2.0)), None);
    }

    #[test]
    fn a_cap_at_its_contact_angle_has_one_curvature_up_to_the_wall() {
        for degrees in [30.0_f64, 60.0, 90.0, 120.0, 150.0] {
            let angle = degrees.to_radians();
            let points = circle(-angle.cos());
            let law = |_, _| angle;
            let fit = InterfaceFit::new(&points, &domain(), (0.1, H), &floor).held_to(&law);
            // From .1 up at 30 degrees the tangent misses the contact point by so much that the steps end 1e-3 off.
            let tolerance = if degrees == 30.0 { 2e-3 } else { 1e-5 };
            // Points below the top of the cap only.
            for height in [0.02, 0.1, 0.3].into_iter().filter(|height| height + angle.cos() < 1.0) {
                let x = Vec2::new((1.0 - (height + angle.cos()).powi(2)).sqrt(), height);
                let kappa = fit.curvature(x).unwrap();
                assert!((kappa - 1.0).abs() < tolerance, "at {degrees} degrees, height {height}: {kappa}");
            }
        }
    }

    #[test]
    fn a_drop_on_a_disc_at_its_contact_angle_has_one_curvature_up_to_the_wall() {
        // A drop of radius 1 about the origin on a solid disc of radius 1.5: centers at c² = 1 + R² − 2R cos θ.
        const DISC: f64 = 1.5;
        for degrees in [40.0_f64, 90.0, 120.0] {
            let angle = degrees.to_radians();
            let below = (1.0 + DISC * DISC - 2.0 * DISC * angle.cos()).sqrt();
            let wall = move |x: Vec2| {
                let from = x + Vec2::new(0.0, below);
                (from.norm() - DISC, from.normalize())
            };
            let points: Vec<InterfacePoint> = (0..400)
                .map(|i| std::f64::consts::TAU * f64::from(i) / 400.0)
                .map(|t| Vec2::new(t.cos(), t.sin()))
                .filter(|x| wall(*x).0 > 0.0)
                .map(|x| InterfacePoint {
                    x,
                    normal: -x,
                    velocity: Vec2::zeros(),
                    wall_distance: wall(x).0,
                    wall_normal: wall(x).1,
                    touches: true,
                })
                .collect();
            let law = |_, _| angle;
            let fit = InterfaceFit::new(&points, &domain(), (0.1, H), &wall).held_to(&law);
            for point in points.iter().filter(|p| p.x.x > 0.0 && p.wall_distance < 0.3) {
                let kappa = fit.curvature(point.x).unwrap();
                // The interface is followed down to the wall along its tangent, and the wall along its own.
                assert!(
                    (kappa - 1.0).abs() < 2e-3,
                    "at {degrees} degrees, {:.3} off the wall: {kappa}",
                    point.wall_distance
                );
            }
        }
    }

    #[test]
    fn a_cap_that_is_too_steep_bends_outwards_at_the_wall() {
        let points = circle(0.0);
        let fit = |angle: f64| {
            InterfaceFit::new(&points, &domain(), (0.1, H), &floor)
                .held_to(&|_, _| angle)
                .curvature(Vec2::new(1.0, 0.02))
                .unwrap()
        };
        assert!(fit(60_f64.to_radians()) < fit(90_f64.to_radians()));
        assert!(fit(120_f64.to_radians()) > fit(90_f64.to_radians()));
    }
}
