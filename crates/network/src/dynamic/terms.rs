//! Fluids, drive and depth of a dynamic displacement.

use crate::displacement::OpenDisc;
use crate::gravity::Gravity;
use meniscus_case::FluidPhase;
use meniscus_case::network::Drive;
use meniscus_core::math::Vec2;
use meniscus_geometry::interface::depth::Depth;
use meniscus_geometry::interface::head::Head;

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
    /// The disc through which it enters in place of a side.
    pub inlet_disc: Option<OpenDisc>,
    /// Sides at which both phases leave.
    pub outlet: [bool; 4],
    /// The invading phase, and floor and lid with its contact angles; `None` in the plane.
    pub depth: Option<(FluidPhase, Depth)>,
    /// Gravity; pressures are those in excess of the displaced phase at rest.
    pub gravity: Option<Gravity>,
}

impl Terms {
    /// The hydrostatic head at a point, for curvatures that are above 0 where the interface bulges into the defending phase.
    pub(super) fn head(&self, at: Vec2) -> Head {
        self.gravity.map_or_else(Head::default, |gravity| gravity.head(at))
    }

    /// Capillary pressure (invading less defending phase) over tension at a meniscus of a curvature in the plane; both in 1/m.
    pub(super) fn with_depth(&self, curvature: f64) -> f64 {
        self.depth.map_or(curvature, |(invading, depth)| {
            invading.towards_wetting(depth.curvature(invading.towards_wetting(curvature)))
        })
    }
}
