//! The velocity of wall particles in the viscous term, extrapolated by the distance to the wall (Morris et al. 1997, section 3.4), as in
//! the paper; with a slip length, to the plane behind the wall where the velocity of the fluid would vanish \[Navier1823\]. Near contact
//! lines walls have a separate slip length: a line on a wall without slip cannot move \[Huh1971\], and the numerical slip of the
//! particles is too small for a strongly driven line, which then overruns the particles next to the wall.

use meniscus_core::math::Vec2;

/// Lower bound of the distance of a fluid particle to a wall, in units of dx: below it the shear rate would diverge.
const CLOSEST: f64 = 0.25;

/// Distances from a contact line over dx: up to the first the wall has the slip length of contact lines, beyond the second that of walls.
const NEAR_LINE: [f64; 2] = [3.0, 6.0];

/// No-slip or Navier slip condition in the velocity differences between fluid and wall particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoSlip {
    /// Initial particle spacing dx in m.
    pub spacing: f64,
    /// Largest stretch β. Measured slip length in plane Poiseuille flow: .25 dx at 1.5, .05 dx at 10.
    pub largest_stretch: f64,
    /// Navier's slip length b in m: along the wall, u = b ∂u/∂n on its surface. 0: no slip.
    pub slip_length: f64,
    /// Slip length in m near contact lines.
    pub line_slip_length: f64,
}

/// Position of a wall particle relative to the surface of the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WallDepth {
    /// Depth in the wall in m.
    pub(crate) depth: f64,
    /// Curvature of the wall in 1/m, positive where the solid is convex.
    pub(crate) curvature: f64,
}

impl NoSlip {
    /// β = min(β_max, 1 + c d_b/d_a), by which the difference v_a − v_wall is stretched so that the velocity vanishes on
    /// the surface between them [Morris1997, Eq. 28]. `distance` d_a of the fluid particle and depth d_b in m.
    ///
    /// Along a wall with the curvature κ (1/m, positive where it is convex) the velocity is y − κy²/2 and not y: c = 1 + κ (d_a + d_b)/2.
    pub(crate) fn stretch(&self, distance: f64, wall: WallDepth) -> f64 {
        self.stretch_to(distance, wall, 0.0)
    }

    /// [`Self::stretch`] for a velocity that vanishes at the depth `b` in m.
    fn stretch_to(&self, distance: f64, wall: WallDepth, b: f64) -> f64 {
        let (d_a, d_b) = (distance.max(CLOSEST * self.spacing), wall.depth.max(0.0));
        let c = 1.0 + 0.5 * wall.curvature * (d_a + d_b);
        (1.0 + c * (d_b - b) / (d_a + b)).min(self.largest_stretch)
    }

    /// The slip length b in m of a wall at the distance `line_distance` (m) from the nearest contact line, which may be infinite \[Huh1971\].
    pub(crate) fn slip_length_at(&self, line_distance: f64) -> f64 {
        let [near, far] = NEAR_LINE.map(|n| n * self.spacing);
        let weight = ((far - line_distance) / (far - near)).clamp(0.0, 1.0);
        self.slip_length + weight * (self.line_slip_length - self.slip_length)
    }

    /// Stretches of the velocity difference along the wall and across it, for the slip length `b` (m).
    ///
    /// Never below zero: along a curved wall with a large slip length the first-order formula could accelerate the fluid instead of retarding it.
    pub(crate) fn stretches(&self, distance: f64, wall: WallDepth, b: f64) -> [f64; 2] {
        let across = self.stretch(distance, wall);
        [if b == 0.0 { across } else { self.stretch_to(distance, wall, b).max(0.0) }, across]
    }

    /// The stretched difference of the velocity `v_ab` = v_a − v_wall \[Navier1823\]. With a slip length b (m), the part along the wall is stretched by
    /// min(β_max, 1 + c (d_b − b)/(d_a + b)), so that it vanishes at the depth b. `distance` (m) from and `normal` of the wall.
    pub(crate) fn difference(&self, v_ab: Vec2, distance: f64, normal: Vec2, wall: WallDepth, b: f64) -> Vec2 {
        let [along, beta] = self.stretches(distance, wall, b);
        if b == 0.0 {
            return beta * v_ab;
        }
        let across = v_ab.dot(&normal) * normal;
        beta * across + along * (v_ab - across)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Navier1823]
    #[test]
    fn a_velocity_that_vanishes_behind_the_wall_is_extrapolated_to_its_particles() {
        let wall = NoSlip { spacing: 1.0, largest_stretch: 10.0, slip_length: 2.0, line_slip_length: 2.0 };
        // u = y + b over the wall y = 0: at the depth d it is b − d. The normal component 3 vanishes on the wall: its difference is 3 (1 + d/y).
        for (y, depth) in [(0.5, 0.5), (1.5, 2.5), (0.7, 1.5)] {
            let flat = WallDepth { depth, curvature: 0.0 };
            let v_ab = wall.difference(Vec2::new(y + 2.0, 3.0), y, Vec2::y(), flat, 2.0);
            assert!((v_ab - Vec2::new(y + depth, 3.0 * (1.0 + depth / y))).norm() < 1e-14, "{v_ab:?}");
        }
    }

    /// [Morris1997, Eq. 28]
    #[test]
    fn without_slip_length_the_whole_difference_is_stretched() {
        let wall = NoSlip { spacing: 1.0, largest_stretch: 1.5, slip_length: 0.0, line_slip_length: 0.0 };
        let flat = WallDepth { depth: 0.5, curvature: 0.0 };
        assert_eq!(wall.difference(Vec2::new(2.0, 4.0), 0.5, Vec2::y(), flat, 0.0), Vec2::new(3.0, 6.0));
    }

    /// [Morris1997, Eq. 28]
    #[test]
    fn a_vortex_around_a_cylinder_is_extrapolated_into_it() {
        // u = r − R²/r around a cylinder at rest, as in Couette flow between cylinders: 2 (y − y²/2R) to second order.
        const RADIUS: f64 = 20.0;
        let wall = NoSlip { spacing: 1.0, largest_stretch: 100.0, slip_length: 0.0, line_slip_length: 0.0 };
        let u = |y: f64| RADIUS + y - RADIUS * RADIUS / (RADIUS + y);
        for (y, depth) in [(0.5, 0.5), (1.5, 1.5), (0.7, 2.5)] {
            let exact = 1.0 - u(-depth) / u(y);
            let error = |curvature: f64| (wall.stretch(y, WallDepth { depth, curvature }) / exact - 1.0).abs();
            let (bent, straight) = (error(1.0 / RADIUS), error(0.0));
            assert!(bent < 8e-3 && bent < 0.2 * straight, "{bent}, without the curvature {straight}");
        }
    }

    /// [Huh1971]
    #[test]
    fn the_slip_length_of_lines_fades_into_that_of_walls() {
        let wall = NoSlip { spacing: 0.1, largest_stretch: 10.0, slip_length: 0.02, line_slip_length: 0.1 };
        let near = [0.0, 0.3, 0.45, 0.6, f64::INFINITY].map(|r| wall.slip_length_at(r));
        for (found, exact) in near.into_iter().zip([0.1, 0.1, 0.06, 0.02, 0.02]) {
            assert!((found - exact).abs() < 1e-15, "{near:?}");
        }
    }
}
