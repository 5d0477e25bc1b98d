//! Contact lines of a sharp interface, detected from its points near walls.
//!
//! Points closer to the wall than 2 dx, where both phases touch it, whose continuations meet the wall at about the same position form one line. Its
//! speed and angle follow from the points within the stencil of a fit around that position. Lines with too few points for a fit are left out.

use crate::bulk::BulkFields;
use crate::configuration::Configuration;
use crate::domain::Domain;
use crate::surface_force::contact_points::ContactPoint;
use crate::surface_force::stencils::Interface;
use crate::view::View;
use crate::wetting::lines::{ContactLineTracker, DetectedLine, TrackedLine};
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::interface::weighted_circle::{
    FEWEST_FROM_CONTACT, WallFrame, WeightedPoint, angle_through, fit_from_contact,
};

/// Points closer to the wall than this, over dx, determine the position of a line: those between the first two layers of particles, or
/// those above if a moving line has separated these layers.
const NEAR_WALL: f64 = 2.0;

/// Points whose continuations meet the wall closer to each other than this, over h, belong to one line.
const ONE_LINE: f64 = 2.0;

/// A contact line detected from the points of the interface.
pub(crate) struct InterfaceLine<'a> {
    pub(super) interface: &'a Interface<'a>,
    /// Approximate position on the wall in m.
    pub(super) position: Vec2,
    /// Wall normal.
    pub(super) normal: Vec2,
    /// 1 if ν_ns points to the left of the wall normal, else -1.
    pub(super) side: f64,
    /// Mean unit normal of the interface.
    pub(super) into_wetting: Vec2,
    /// The points around it, relative to `position`.
    pub(super) near: Vec<WeightedPoint>,
}

impl View<'_, BulkFields> {
    /// The present contact lines, from those of the previous step and the `detected_lines`.
    pub(super) fn followed(&self, detected_lines: &[impl DetectedLine]) -> Vec<TrackedLine> {
        let Configuration { method, domain, .. } = self.config;
        let Some(base) = method.wetting else { return Vec::new() };
        let h = method.kernel.h;
        // The response time of an interface of size h.
        let mean_over = h / method.capillary_speed() + method.largest_viscosity() * h / method.tension;
        let tracker = ContactLineTracker {
            domain,
            model: &|x| self.config.wetting_at(x).unwrap_or(base),
            wall_velocity: &|x| self.config.wall_velocity(x),
            tension: method.tension,
            viscosity: method.wetting_fluid.viscosity,
            other_viscosity: method.other_fluid.viscosity,
            slip_length: method.no_slip.line_slip_length,
            h,
            mean_over,
        };
        tracker.track(&self.state.lines, detected_lines, self.state.last_dt)
    }
}

impl Interface<'_> {
    /// The contact lines in the order of their first points.
    pub(crate) fn lines(&self) -> Vec<InterfaceLine<'_>> {
        const NONE: usize = usize::MAX;
        let ends: Vec<(usize, ContactPoint)> = (0..self.points.len())
            .filter(|&i| self.points[i].touches && self.points[i].wall_distance < NEAR_WALL * self.spacing)
            .filter(|&i| is_inside(self.domain, self.points[i].x))
            .filter_map(|i| Some((i, self.contact_point(&self.points[i])?)))
            .collect();
        let mut end_of = vec![NONE; self.points.len()];
        for (k, (i, _)) in ends.iter().enumerate() {
            end_of[*i] = k;
        }
        let mut taken = vec![false; ends.len()];
        let mut lines = Vec::new();
        for first in 0..ends.len() {
            if std::mem::replace(&mut taken[first], true) {
                continue;
            }
            let (mut group, mut next) = (vec![first], 0);
            while let Some(&k) = group.get(next) {
                next += 1;
                let (i, end) = &ends[k];
                self.cells.visit_near(self.points[*i].x, |j, r| {
                    let other = end_of[j as usize];
                    if other == NONE || taken[other] {
                        return;
                    }
                    let (_, there) = &ends[other];
                    // From the contact point of k to the other; r = x_k − x_j.
                    let apart = (there.contact - r - end.contact).norm();
                    // Across a narrow throat or a small drop, ν points to the other side of the normal.
                    if there.side == end.side && apart < ONE_LINE * self.h {
                        taken[other] = true;
                        group.push(other);
                    }
                });
            }
            lines.extend(self.line(&ends, &group));
        }
        lines
    }

    /// The line at the mean of the contact points of a group.
    fn line(&self, ends: &[(usize, ContactPoint)], group: &[usize]) -> Option<InterfaceLine<'_>> {
        let from = self.points[ends[group[0]].0].x;
        let weight = |k: &usize| self.points[ends[*k].0].weight;
        let contact = |k: &usize| self.domain.separation(self.points[ends[*k].0].x, from) + ends[*k].1.contact;
        let sum: f64 = group.iter().map(weight).sum();
        if sum <= 0.0 {
            return None;
        }
        let mean = from + group.iter().map(|k| weight(k) * contact(k)).sum::<Vec2>() / sum;
        let (distance, normal) = (self.wall)(mean);
        let position = mean - distance * normal;
        let into_wetting: Vec2 = group.iter().map(|k| weight(k) * self.points[ends[*k].0].normal).sum();
        let into_wetting = into_wetting.try_normalize(f64::EPSILON)?;
        let side = ends[group[0]].1.side;
        let level = self.stencil(into_wetting, position);
        let kappa = self.circle(&level, into_wetting).and_then(|circle| circle.curvature()).unwrap_or(0.0);
        let near = self.of_one_curvature(&self.on_interface(&level, kappa), Vec2::zeros());
        (near.len() >= FEWEST_FROM_CONTACT).then_some(InterfaceLine {
            interface: self,
            position,
            normal,
            side,
            into_wetting,
            near,
        })
    }
}

/// Whether a point is not an image behind a mirror.
fn is_inside(domain: &Domain, x: Vec2) -> bool {
    domain.mirrors.iter().all(|m| domain.bounds.min[m.axis] <= x[m.axis] && x[m.axis] <= domain.bounds.max[m.axis])
}

impl DetectedLine for InterfaceLine<'_> {
    fn position(&self) -> Vec2 {
        self.interface.domain.wrapped(self.position)
    }

    fn outward(&self) -> Vec2 {
        self.side * perpendicular(self.normal)
    }

    /// Σ w v·n/Σ w ν·n: an interface that moves along the wall with the speed U has v·n = U ν·n.
    fn speed(&self) -> f64 {
        let outward = self.outward();
        let (moved, along) = self.near.iter().fold((0.0, 0.0), |(moved, along), q| {
            let p = &self.interface.points[q.index];
            (moved + q.weight * p.velocity.dot(&p.normal), along + q.weight * outward.dot(&p.normal))
        });
        // ν·n is −sin of the angle; where its mean vanishes the interface is parallel to the wall and its speed undetermined.
        if along < 0.0 { moved / along } else { 0.0 }
    }

    fn present(&self, anchor: Option<Vec2>) -> f64 {
        let anchor = anchor.map_or(Vec2::zeros(), |anchor| self.interface.domain.separation(anchor, self.position));
        let straight = (-self.into_wetting.dot(&self.normal)).clamp(-1.0, 1.0).acos();
        angle_through(&self.near, anchor, self.into_wetting, self.normal).unwrap_or(straight)
    }

    fn intersection(&self, angle: f64) -> Vec2 {
        let wall = WallFrame { outward: self.outward(), normal: self.normal };
        let shift = fit_from_contact(&self.near, Vec2::zeros(), wall, angle);
        // A fit that is far off along the wall is no better than the straight continuation.
        let shift =
            shift.map(|(_, shift)| shift).filter(|shift| shift.abs() < ONE_LINE * self.interface.h).unwrap_or(0.0);
        let x = self.position + shift * wall.outward;
        let (distance, normal) = (self.interface.wall)(x);
        x - distance * normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface_force::points::InterfacePoint;
    use crate::surface_force::stencils::fixture::{H, at_rest, directions, floor, interface};
    use meniscus_core::math::LINE_MOMENT;

    /// The level 1/2 of the smoothed color of a drop of radius 1 on the floor that moves with (`speed`, 0) and rotates about its
    /// center, which does not move the interface.
    fn drop(degrees: f64, speed: f64) -> Vec<InterfacePoint> {
        let level = f64::midpoint(1.0, (1.0 - 4.0 * LINE_MOMENT * H * H).sqrt());
        let center = Vec2::new(0.0, -degrees.to_radians().cos());
        let mut points = at_rest(directions(0.3).map(|n| (level * n + center, -n)), &floor);
        points.iter_mut().for_each(|p| p.velocity = Vec2::new(speed, 0.0) - 5.0 * perpendicular(p.normal));
        points
    }

    #[test]
    fn a_drop_has_two_lines_with_their_place_angle_and_speed() {
        for degrees in [40.0_f64, 60.0, 90.0, 120.0, 140.0] {
            let points = drop(degrees, 0.3);
            let interface = interface(&points, &floor);
            let lines = interface.lines();
            assert_eq!(lines.len(), 2, "{degrees}");
            for line in lines {
                let side = line.outward().x;
                let exact = Vec2::new(side * degrees.to_radians().sin(), 0.0);
                assert!(side.abs() == 1.0 && (line.speed() - 0.3 * side).abs() < 1e-9, "{degrees}: {}", line.speed());
                let meets = line.intersection(degrees.to_radians());
                // At small angles the iteration for the contact point gains about one digit per step.
                assert!((meets - exact).norm() < 1e-3, "{degrees}: {meets:?}");
                let present = line.present(Some(exact)).to_degrees();
                assert!((present - degrees).abs() < 1e-6, "{degrees}: {present}");
            }
        }
    }

    #[test]
    fn an_interface_that_stands_out_over_its_anchor_looks_steeper() {
        let points = drop(90.0, 0.0);
        let interface = interface(&points, &floor);
        for line in interface.lines() {
            let inside = line.present(Some(Vec2::new(0.97 * line.outward().x, 0.0))).to_degrees();
            let outside = line.present(Some(Vec2::new(1.03 * line.outward().x, 0.0))).to_degrees();
            assert!(inside > 92.0 && outside < 88.0, "{inside} {outside}");
        }
    }
}
