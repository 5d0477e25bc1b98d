//! Curvature of the interface from local circle fits, free in the bulk and constrained to the contact angle at walls.
//!
//! Under gravity the curvature of an interface at rest varies by ∇κ = (ρ_w − ρ_n) g/σ (Young and Laplace). A fit to a stencil that ends at a wall would assign
//! the curvature of its middle to its end. So the deflection by the known gradient is subtracted from the points before a circle is fitted (`stencils`).
//!
//! At a pinned contact line the fit responds stiffly to the position of the interface, and not as the gradient of an energy: evaluated at the
//! start of a step, it amplifies the waves of a liquid of low viscosity. There the points at the end of the step are used.
//!
//! At the arc length s from the wall, a fit constrained to the contact angle returns the mean curvature κ̄ of \[0, s\], because its tangent at the
//! wall is given: the tangent of the interface rotates by s κ̄(s), and the local curvature is d(s κ̄)/ds = κ̄ + s dκ̄/ds. At rest both agree. Where
//! viscous stress bends the interface, the integral of κ̄ exceeds this rotation and would exert a net pull on a moving line.
//!
//! The points lie on the level 1/2 of the smoothed color, which is displaced towards the center of curvature by h²κ/7. So a stencil is
//! fitted more than once: for the curvature by which its points are moved to the interface, and there.

use crate::surface_force::contact_points::{ContactPoint, angle_pulled};
use crate::surface_force::pinned_lines::PinnedLine;
use crate::surface_force::points::InterfacePoint;
use crate::surface_force::stencils::Interface;
use crate::wetting::lines::LINE_REACH;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::interface::weighted_circle::{FEWEST_FROM_CONTACT, WallFrame, WeightedPoint, fit_from_contact};

/// Number of times the points of a stencil are moved from the level to the interface. At a wall the circle through the level does not meet
/// the wall at the contact angle; each iteration gains more than a digit.
const MOVES: usize = 3;

/// Arc length along the interface to the wall, over h, below which the fit is constrained to the contact angle; the weight grows over 2h.
const REACH: f64 = 3.0;

/// Maximum number of projections of the contact point onto a curved wall; each gains more than a digit.
const PROJECTIONS: usize = 4;

/// Walls whose normals differ by less than this angle in rad count as straight.
const SAME_NORMAL: f64 = 1e-4;

/// The contact angle in rad imposed at a point of the wall (m), given ν_ns there.
pub(crate) type AngleAt<'a> = dyn Fn(Vec2, Vec2) -> f64 + Sync + 'a;

/// Result of a fit constrained to the contact angle, for the interface between the wall and a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WallFit {
    /// Mean curvature in 1/m from the contact line to the point.
    pub(crate) mean: f64,
    /// Arc length along the interface from its contact line in m.
    pub(crate) arc_length: f64,
    /// Weight of the constrained fit in the curvature.
    pub(crate) share: f64,
    /// 1 if ν_ns points to the left of the wall normal, else -1.
    pub(crate) side: f64,
    /// Position of the contact line in m.
    pub(crate) line: Vec2,
}

/// Curvature of the interface at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fitted {
    /// Curvature of the fits in 1/m.
    pub(crate) curvature: f64,
    /// Result of the constrained fit, if there is one.
    pub(crate) constrained: Option<WallFit>,
}

/// The fits for the curvature of an interface.
#[derive(Clone, Copy)]
pub(crate) struct InterfaceFit<'a> {
    pub(super) interface: &'a Interface<'a>,
    /// The angle imposed at walls, `None` for free fits: the interface meets walls at any angle.
    pub(super) angle: Option<&'a AngleAt<'a>>,
    /// The contact lines at edges and tight bends of the walls.
    pub(super) pinned_lines: &'a [PinnedLine],
}

impl InterfaceFit<'_> {
    /// Curvature of the interface nearest to `x` (m), with the result of the constrained fit.
    pub(crate) fn at(&self, x: Vec2) -> Option<Fitted> {
        let nearest = self.interface.nearest(x).into_iter();
        let found: Vec<Fitted> = nearest.filter_map(|(p, from_p)| self.fitted_at(p, from_p, x)).collect();
        let curvature = found.iter().map(|fitted| fitted.curvature).sum::<f64>() / found.len() as f64;
        match found[..] {
            [] => None,
            [one] => Some(one),
            // Equidistant points, on an axis of symmetry, may belong to different contact lines.
            _ => Some(Fitted { curvature, constrained: None }),
        }
    }

    /// The curvature at `x` from the stencil near the point `p`, with `from_p` = x − x_p.
    fn fitted_at(&self, p: usize, from_p: Vec2, x: Vec2) -> Option<Fitted> {
        let nearest = InterfacePoint { x: x - from_p, ..self.interface.points[p] };
        let (point, level) = self.interface.stencil_at_closest_point(nearest, x);
        let mut at = self.fitted(&point, &level)?;
        for _ in 0..MOVES {
            at = self.fitted(&point, &self.interface.on_interface(&level, at.curvature))?;
        }
        // At rest the curvature extrapolated off the interface in this way balances gravity between any two particles.
        let off = self.interface.gradient.dot(&(x - point.x));
        let (kappa, limit) = (at.curvature + off, self.interface.limit());
        let constrained = at.constrained.map(|constrained| WallFit { mean: constrained.mean + off, ..constrained });
        kappa.is_finite().then(|| Fitted { curvature: kappa.clamp(-limit, limit), constrained })
    }

    /// Curvature of the stencil `near` at `point`: constrained to the angle at a wall, free far from one.
    fn fitted(&self, point: &InterfacePoint, near: &[WeightedPoint]) -> Option<Fitted> {
        let free = self.interface.circle(near, point.normal).and_then(|circle| circle.curvature());
        let constrained = self.constrained_fit(point, near);
        let curvature = match (constrained, free) {
            (Some(WallFit { mean, share, .. }), Some(free)) => share * mean + (1.0 - share) * free,
            (Some(WallFit { mean, .. }), None) => mean,
            (None, free) => free?,
        };
        Some(Fitted { curvature, constrained })
    }

    /// The fit constrained to the contact angle, if the interface meets a wall near `point`.
    fn constrained_fit(&self, point: &InterfacePoint, near: &[WeightedPoint]) -> Option<WallFit> {
        let touches = near.iter().any(|q| self.interface.points[q.index].touches);
        if self.angle.is_none() || !touches || near.len() < FEWEST_FROM_CONTACT {
            return None;
        }
        let ContactPoint { mut contact, mut normal, side, arc_length } = self.interface.contact_point(point)?;
        let share = ((REACH * self.interface.h - arc_length) / (2.0 * self.interface.h)).clamp(0.0, 1.0);
        if share == 0.0 {
            return None;
        }
        // `end` is the contact line, in m from the point.
        let constrained = |mean: f64, end: Vec2| {
            let arc_length = arc(end.norm(), mean);
            WallFit { mean, arc_length, share, side, line: point.x + end }
        };
        if let Some(line) = self.pinned_line_at(point.x + contact, side) {
            let contact = self.interface.domain.separation(line.position, point.x);
            let wall = WallFrame { outward: side * perpendicular(line.normal), normal: line.normal };
            let near = self.interface.at_end_of_step(near);
            let (mean, delta) = self.fit_at(point, &near, contact, wall)?;
            return Some(constrained(mean, contact + delta * wall.outward));
        }
        let near = self.interface.weighted_for_wall(near);
        let mut found = None;
        for _ in 0..PROJECTIONS {
            let wall = WallFrame { outward: side * perpendicular(normal), normal };
            let (mean, delta) = self.fit_at(point, &near, contact, wall)?;
            found = Some(constrained(mean, contact + delta * wall.outward));
            // The contact point is on the tangent of the wall; a curved wall is evaluated again there.
            let on_tangent = point.x + contact + delta.clamp(-self.interface.h, self.interface.h) * wall.outward;
            let (distance, there) = (self.interface.wall)(on_tangent);
            if (there - normal).norm() < SAME_NORMAL {
                break;
            }
            (contact, normal) = (on_tangent - distance * there - point.x, there);
        }
        found
    }

    /// Curvature in 1/m at `point` of the circle that meets the straight `wall` through `contact` (m from `point`) at the
    /// contact angle, and the distance in m along ν from `contact` to the intersection.
    fn fit_at(
        &self,
        point: &InterfacePoint,
        near: &[WeightedPoint],
        contact: Vec2,
        wall: WallFrame,
    ) -> Option<(f64, f64)> {
        let angle = angle_pulled(point.normal, wall, (self.angle?)(point.x + contact, wall.outward));
        let at_contact = self.interface.of_one_curvature(near, contact);
        let (kappa, delta) = fit_from_contact(&at_contact, contact, wall, angle)?;
        Some((kappa - self.interface.gradient.dot(&(contact + delta * wall.outward)), delta))
    }

    /// The pinned line of an interface that meets the wall near `x` (m), on the given side.
    fn pinned_line_at(&self, x: Vec2, side: f64) -> Option<&PinnedLine> {
        let distance = |line: &&PinnedLine| self.interface.domain.separation(line.position, x).norm();
        let pinned_lines =
            self.pinned_lines.iter().filter(|line| line.side == side && distance(line) < LINE_REACH * self.interface.h);
        pinned_lines.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }
}

/// Length in m of the arc with the curvature `kappa` (1/m) over a chord (m), at most half a circle.
fn arc(chord: f64, kappa: f64) -> f64 {
    let half = (0.5 * kappa.abs() * chord).min(1.0);
    if half > 1e-6 { chord * half.asin() / half } else { chord }
}

#[cfg(test)]
impl InterfaceFit<'_> {
    /// Curvature in 1/m of the interface nearest to `x`, `None` without interface within the stencil.
    pub(crate) fn curvature(&self, x: Vec2) -> Option<f64> {
        self.at(x).map(|fitted| fitted.curvature)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface_force::stencils::fixture::{H, at_rest, directions, floor, interface};
    use meniscus_core::math::LINE_MOMENT;

    /// Radius of the level 1/2 of the smoothed color of a disc of radius 1.
    fn level() -> f64 {
        1.0 - LINE_MOMENT * H * H
    }

    /// Points of the level of a disc of radius 1 about (0, `height`) above the floor y = 0.
    fn circle(height: f64) -> Vec<InterfacePoint> {
        at_rest(directions(0.0).map(|n| (level() * n + Vec2::new(0.0, height), -n)), &floor)
    }

    fn free<'a>(interface: &'a Interface<'a>) -> InterfaceFit<'a> {
        InterfaceFit { interface, angle: None, pinned_lines: &[] }
    }

    /// [Pratt1987]
    #[test]
    fn the_curvature_of_a_circle_is_one_over_its_radius() {
        let points = circle(2.0);
        let interface = interface(&points, &floor);
        let fit = free(&interface);
        for t in [0.0_f64, 0.7, 2.0, 4.0] {
            let x = Vec2::new(0.0, 2.0) + 1.1 * Vec2::new(t.cos(), t.sin());
            let kappa = fit.curvature(x).unwrap();
            assert!((kappa - 1.0).abs() < 1e-9, "{kappa}");
        }
        assert_eq!(fit.curvature(Vec2::new(0.0, 2.0)), None);
    }

    /// [Pratt1987]
    #[test]
    fn a_rough_interface_has_the_same_curvature_on_both_sides() {
        // Bumps of a tenth of a spacing, 2.3 spacings apart, as from single particles on the wrong side of the interface.
        const WAVES: f64 = 27.0;
        const HEIGHT: f64 = 0.01;
        let bump = |n: &Vec2| (WAVES * n.y.atan2(n.x)).cos();
        let rough = directions(0.0).map(|n| ((level() + HEIGHT * bump(&n)) * n, -n));
        let points = at_rest(rough, &|_| (f64::INFINITY, Vec2::zeros()));
        let interface = interface(&points, &floor);
        let fit = free(&interface);
        // The curvature of the bumps, seven times that of the circle, is multiplied by the transform of the weights: a bump does not appear as a dent.
        let left = HEIGHT * WAVES * WAVES * (-0.25 * (WAVES * H).powi(2)).exp();
        for n in directions(0.0).take(30) {
            let [inside, outside] = [0.75, 1.25].map(|r| fit.curvature(r * n).unwrap());
            assert!((inside - outside).abs() < 1e-2, "{inside} inside, {outside} outside");
            assert!((inside - 1.0 - left * bump(&n)).abs() < 1e-2, "{inside} at {}", bump(&n));
        }
    }

    #[test]
    fn a_cap_at_its_contact_angle_has_one_curvature_up_to_the_wall() {
        for degrees in [30.0_f64, 60.0, 90.0, 120.0, 150.0] {
            let angle = degrees.to_radians();
            let points = circle(-angle.cos());
            let law = |_, _| angle;
            let interface = interface(&points, &floor);
            let fit = InterfaceFit { angle: Some(&law), ..free(&interface) };
            // At 30 degrees and heights of .1 or more the tangent is so far from the contact point that the iteration ends 1e-3 off.
            let tolerance = if degrees == 30.0 { 2e-3 } else { 1e-5 };
            // Only points below the top of the cap.
            for height in [0.02, 0.1, 0.3].into_iter().filter(|height| height + angle.cos() < 1.0) {
                let x = Vec2::new((1.0 - (height + angle.cos()).powi(2)).sqrt(), height);
                let kappa = fit.curvature(x).unwrap();
                assert!((kappa - 1.0).abs() < tolerance, "at {degrees} degrees, height {height}: {kappa}");
            }
        }
    }

    #[test]
    fn a_drop_on_a_disc_at_its_contact_angle_has_one_curvature_up_to_the_wall() {
        // A drop of radius 1 about the origin on a solid disc of radius 1.5: distance of centers c² = 1 + R² − 2R cos θ.
        const DISC: f64 = 1.5;
        for degrees in [40.0_f64, 90.0, 120.0] {
            let angle = degrees.to_radians();
            let below = (1.0 + DISC * DISC - 2.0 * DISC * angle.cos()).sqrt();
            let wall = move |x: Vec2| {
                let from = x + Vec2::new(0.0, below);
                (from.norm() - DISC, from.normalize())
            };
            let points = at_rest(directions(0.0).map(|n| (level() * n, -n)), &wall);
            let law = |_, _| angle;
            let interface = interface(&points, &wall);
            let fit = InterfaceFit { angle: Some(&law), ..free(&interface) };
            for point in points.iter().filter(|p| p.x.x > 0.0 && p.wall_distance < 0.3) {
                let kappa = fit.curvature(point.x).unwrap();
                // The error is that of the tangents by which interface and wall are extrapolated.
                assert!(
                    (kappa - 1.0).abs() < 2e-3,
                    "at {degrees} degrees, {:.3} off the wall: {kappa}",
                    point.wall_distance
                );
            }
        }
    }

    #[test]
    fn a_puddle_has_the_curvature_of_young_and_laplace_up_to_the_wall() {
        // From the apex down: dx/ds = cos φ, dz/ds = sin φ, dφ/ds = κ = (1/2 + z)/lc, z in units of the capillary length lc.
        const LENGTH: f64 = 0.6;
        const STEP: f64 = 1e-3;
        for degrees in [60.0_f64, 90.0, 120.0] {
            let angle = degrees.to_radians();
            let (mut x, mut depth, mut phi, mut profile) = (0.0_f64, 0.0_f64, 0.0_f64, Vec::new());
            while phi < angle {
                let kappa = 0.5 / LENGTH + depth / (LENGTH * LENGTH);
                profile.push((x, depth, phi, kappa));
                let middle = phi + 0.5 * STEP * kappa;
                (x, depth, phi) = (x + STEP * middle.cos(), depth + STEP * middle.sin(), phi + STEP * kappa);
            }
            let sides = profile
                .iter()
                .step_by(10)
                .flat_map(|(x, z, phi, kappa)| [(-x, *z, -phi, *kappa), (*x, *z, *phi, *kappa)]);
            let points = at_rest(
                sides.map(|(x, z, phi, kappa)| {
                    let normal = Vec2::new(-phi.sin(), -phi.cos());
                    (Vec2::new(x, depth - z) + LINE_MOMENT * H * H * kappa * normal, normal)
                }),
                &floor,
            );
            let law = |_, _| angle;
            let at = |gradient: f64| {
                let interface = Interface { gradient: Vec2::new(0.0, gradient), ..interface(&points, &floor) };
                let fit = InterfaceFit { angle: Some(&law), ..free(&interface) };
                let near_wall = profile.iter().filter(|(_, z, ..)| depth - z < 0.3);
                let error = |x: f64, z: f64, exact: f64| fit.curvature(Vec2::new(x, depth - z)).unwrap() - exact;
                let largest = near_wall.map(|(x, z, _, exact)| error(*x, *z, *exact).abs()).fold(0.0, f64::max);
                largest / profile[profile.len() - 1].3
            };
            // Six spacings per capillary length: third-order error with the gradient, first-order without.
            let (known, unknown) = (at(-1.0 / (LENGTH * LENGTH)), at(0.0));
            assert!(known < 0.02 && unknown > 0.05, "at {degrees} degrees: {known}, without gradient {unknown}");
        }
    }

    #[test]
    fn a_cap_that_is_too_steep_bends_outwards_at_the_wall() {
        let points = circle(0.0);
        let interface = interface(&points, &floor);
        let fit = |angle: f64| {
            InterfaceFit { angle: Some(&|_, _| angle), ..free(&interface) }.curvature(Vec2::new(1.0, 0.02)).unwrap()
        };
        assert!(fit(60_f64.to_radians()) < fit(90_f64.to_radians()));
        assert!(fit(120_f64.to_radians()) > fit(90_f64.to_radians()));
    }
}
