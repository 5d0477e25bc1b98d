//! No slip by extrapolated wall velocities (Morris et al. 1997, section 3.4), as the paper uses it.

/// Closest distance of a fluid particle to a wall that is used, in units of dx: nearer ones would meet an endless shear.
const CLOSEST: f64 = 0.25;

/// Velocity differences between fluid and wall particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoSlip {
    /// Initial particle spacing dx in m.
    pub spacing: f64,
    /// Largest stretch β. Measured slip length in plane Poiseuille flow: .25 dx at 1.5, .05 dx at 10.
    pub largest_stretch: f64,
}

impl NoSlip {
    /// β = min(β_max, 1 + d_b/d_a), by which the difference v_a − v_wall is stretched so that the velocity vanishes on
    /// the surface between them [Morris1997, Eq. 28]. `distance` d_a of the fluid particle and `depth` d_b in m.
    #[must_use]
    pub fn stretch(&self, distance: f64, depth: f64) -> f64 {
        let d_a = distance.max(CLOSEST * self.spacing);
        (1.0 + depth.max(0.0) / d_a).min(self.largest_stretch)
    }
}
