//! Fluids, drive and depth of a dynamic displacement.

use meniscus_case::FluidPhase;
use meniscus_case::network::Drive;
use meniscus_geometry::interface::depth::Depth;

/// Fluids and drive of a dynamic displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Terms {
    /// Viscosities of the invading and the defending phase in Pa s.
    pub viscosity: [f64; 2],
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// Given flow rate or pressure drop.
    pub drive: Drive,
    /// Largest number of pore volumes injected in one step.
    pub largest_step: f64,
    /// Sides at which the invading phase enters: left, right, bottom, top.
    pub inlet: [bool; 4],
    /// Sides at which both phases leave.
    pub outlet: [bool; 4],
    /// The invading phase, and floor and lid with its contact angles; `None` in the plane.
    pub depth: Option<(FluidPhase, Depth)>,
}

impl Terms {
    /// Capillary pressure (invading less defending phase) over tension at a meniscus of a curvature in the plane; both in 1/m.
    pub(super) fn with_depth(&self, curvature: f64) -> f64 {
        self.depth.map_or(curvature, |(invading, depth)| {
            invading.towards_wetting(depth.curvature(invading.towards_wetting(curvature)))
        })
    }
}
