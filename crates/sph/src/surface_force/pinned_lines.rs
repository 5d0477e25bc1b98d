//! Contact lines at edges and tight bends of walls.
//!
//! An edge is the limit of a rounded one. Its normals form a fan, and a line can be at rest there at any angle between the contact angles
//! on both faces, as one normal of the fan makes the contact angle with the interface (Gibbs; Oliver, Huh and Mason 1977). Separate circle
//! fits would find sometimes one face and sometimes the other. So for each line near a bend the position on the wall and the normal at which
//! the interface has its contact angle are determined once, from all of its points; the fits around it use that tangent.

use crate::surface_force::contact_points::angle_pulled;
use crate::surface_force::detected_lines::InterfaceLine;
use crate::wetting::lines::DetectedLine;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::interface::weighted_circle::{WallFrame, fit_from_contact};

/// A wall bends at a line if the normals at this distance on both sides of it, over h, differ by more than `BENT`.
const NEIGHBORHOOD: f64 = 1.0;

/// Cosine of 45 degrees.
const BENT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Maximum number of steps of the search for the position of a line.
const STEPS: usize = 16;

/// Tolerance of the position, over h.
const SAME_POSITION: f64 = 1e-6;

/// Positions are interpolated at this height above the wall, over dx, where those around an edge differ.
const LIFT: f64 = 0.5;

/// A contact line at a bend of its wall.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PinnedLine {
    /// A point in m on the tangent of the wall where the interface meets it.
    pub(super) position: Vec2,
    /// The wall normal of the tangent.
    pub(super) normal: Vec2,
    /// 1 if ν_ns points to the left of the normal, else -1.
    pub(super) side: f64,
}

/// A candidate for the end of the interface on the wall, relative to the line.
#[derive(Clone, Copy)]
struct End {
    contact: Vec2,
    normal: Vec2,
}

impl InterfaceLine<'_> {
    /// The pinned line where the interface meets the wall at the `angle` (rad), `None` if the wall does not bend there \[Oliver1977\].
    pub(crate) fn pinned(&self, angle: f64) -> Option<PinnedLine> {
        let (interface, position) = (self.interface, self.position);
        let normal_at = |s: f64| (interface.wall)(position + s * interface.h * self.outward()).1;
        if normal_at(NEIGHBORHOOD).dot(&normal_at(-NEIGHBORHOOD)) > BENT {
            return None;
        }
        let near = interface.at_end_of_step(&self.near);
        let mut end = End { contact: Vec2::zeros(), normal: self.normal };
        // Bracket: the closest positions from which the line would move outwards and inwards, with the distances.
        let mut between: [Option<(End, f64)>; 2] = [None; 2];
        for _ in 0..STEPS {
            let wall = WallFrame { outward: self.side * perpendicular(end.normal), normal: end.normal };
            let pulled = angle_pulled(self.into_wetting, wall, angle);
            let (_, shift) = fit_from_contact(&near, end.contact, wall, pulled)?;
            if shift.abs() < SAME_POSITION * interface.h {
                break;
            }
            between[usize::from(shift < 0.0)] = Some((end, shift.abs()));
            let next = match between {
                [Some((inner, out)), Some((outer, back))] => {
                    let t = (out / (out + back)).clamp(0.1, 0.9);
                    (1.0 - t) * self.above(&inner) + t * self.above(&outer)
                }
                _ => end.contact + shift.clamp(-interface.h, interface.h) * wall.outward,
            };
            let (distance, normal) = (interface.wall)(position + next);
            end = End { contact: next - distance * normal, normal };
        }
        let position = interface.domain.wrapped(position + end.contact);
        Some(PinnedLine { position, normal: end.normal, side: self.side })
    }

    /// A point above an end, from which the wall query returns the same normal.
    fn above(&self, end: &End) -> Vec2 {
        end.contact + LIFT * self.interface.spacing * end.normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface_force::fit::InterfaceFit;
    use crate::surface_force::points::InterfacePoint;
    use crate::surface_force::stencils::fixture::{H, at_rest, directions, interface};
    use meniscus_core::math::LINE_MOMENT;

    /// A quarter of the plane is solid, its edge at the origin.
    fn wall(x: Vec2) -> (f64, Vec2) {
        match (x.x > 0.0, x.y > 0.0) {
            (true, true) => (x.norm(), x.normalize()),
            (true, false) => (x.x, Vec2::x()),
            (false, true) => (x.y, Vec2::y()),
            (false, false) if x.x > x.y => (x.x, Vec2::x()),
            (false, false) => (x.y, Vec2::y()),
        }
    }

    /// Points of the level 1/2 of a drop of radius 1 on the horizontal face that ends at the edge with an angle (rad) to that face.
    fn drop(angle: f64) -> Vec<InterfacePoint> {
        let (center, up) = (Vec2::new(-angle.sin(), -angle.cos()), Vec2::new(-angle.cos(), angle.sin()));
        let circle = directions(0.0).map(|n| (center + (1.0 - LINE_MOMENT * H * H) * n, -n));
        // The rest of the circle is in the solid or beyond the edge.
        at_rest(circle.filter(|(x, _)| x.dot(&up) > 0.0), &wall)
    }

    /// [Oliver1977]
    #[test]
    fn a_drop_that_ends_at_an_edge_has_one_curvature_at_any_angle_between_those_of_both_faces() {
        let law = |_, _| 60_f64.to_radians();
        for degrees in [62.0_f64, 80.0, 112.0, 130.0, 148.0] {
            let points = drop(degrees.to_radians());
            let interface = interface(&points, &wall);
            let pinned_lines: Vec<PinnedLine> =
                interface.lines().iter().filter_map(|line| line.pinned(60_f64.to_radians())).collect();
            let fit = InterfaceFit { interface: &interface, angle: Some(&law), pinned_lines: &pinned_lines };
            for point in points.iter().filter(|p| p.x.norm() < 0.4) {
                let (kappa, from) = (fit.curvature(point.x).unwrap(), point.x.norm());
                assert!((kappa - 1.0).abs() < 3e-3, "at {degrees} degrees, {from:.3} from the edge: {kappa}");
            }
        }
    }
}
