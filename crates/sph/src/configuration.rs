//! Configuration of a flow: method, box, walls and open sides.

use crate::domain::{Domain, WallQuery};
use crate::method::{Method, PressureGradient};
use crate::open::{Open, OpenSide};
use crate::wetting::wall;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_wetting::Wetting;

/// Step of the central difference of the wall normal for the curvature of a wall, over dx.
const CURVATURE_STEP: f64 = 0.25;

/// Walls with more curvature than this, over 1/h, count as edges.
const TIGHTEST: f64 = 0.5;

/// Configuration of a flow. It changes with time only as the case prescribes: body forces of successive stages, pressures that rise in steps.
pub struct Configuration {
    /// Constants of the run.
    pub method: Method,
    /// Box and sides.
    pub domain: Domain,
    /// Wall distance and normal.
    pub wall: WallQuery,
    /// Wetting models and velocities of the walls; without it all are alike and at rest.
    pub(crate) wall_properties: Option<wall::WallQuery>,
    /// Open sides, and periodic ones with a given flow rate.
    pub open: Open,
    /// Decay time of the slowest viscous mode in s, infinite with surface tension and without walls.
    pub viscous_time: f64,
    /// Time in s at which the present forces were applied.
    pub since: f64,
}

impl Configuration {
    /// The part of gravity in m/s² that the pressure can balance: not along periodic directions, where it drives the flow.
    ///
    /// Zero for the forms of the gradient with the sum of pressures: their sums differ from those of the pressure equation.
    pub(crate) fn balanced_gravity(&self) -> Vec2 {
        if self.method.pressure_gradient() != PressureGradient::Difference {
            return Vec2::zeros();
        }
        let [x, y] = self.domain.periodic.map(|periodic| if periodic { 0.0 } else { 1.0 });
        self.method.gravity.component_mul(&Vec2::new(x, y))
    }

    /// Curvature in 1/m of the wall nearest to `x` (m), for no slip [Morris1997, Eq. 28], by its normals. Positive where the solid is convex, 0 at edges.
    pub(crate) fn curvature_of_wall(&self, x: Vec2) -> f64 {
        let (distance, normal) = (self.wall)(x);
        let (inside, along) = (x - distance * normal, perpendicular(normal));
        let normal_at = |s: f64| (self.wall)(inside + s * along).1;
        let step = CURVATURE_STEP * self.method.spacing;
        let curvature = (normal_at(step) - normal_at(-step)).dot(&along) / (2.0 * step);
        if curvature.abs() * self.method.kernel.h < TIGHTEST { curvature } else { 0.0 }
    }

    /// The wetting model of the wall nearest to `x` (m); `None` if the flow has none.
    pub(crate) fn wetting_at(&self, x: Vec2) -> Option<Wetting> {
        let patch = self.wall_properties.as_ref().and_then(|query| query(x).patch);
        patch.and_then(|patch| self.method.patches.get(patch).copied()).or(self.method.wetting)
    }

    /// Velocity in m/s of the wall nearest to `x` (m).
    pub fn wall_velocity(&self, x: Vec2) -> Vec2 {
        self.wall_properties.as_ref().map_or(Vec2::zeros(), |query| query(x).velocity)
    }

    /// Whether the pressure of a long step is advanced to the end of the step. Not with surface tension, whose time steps are short enough for
    /// the pressure to follow, and not with inlets and outlets, where this is unstable: their buffers have no viscous forces.
    pub(crate) fn has_viscous_pressure(&self) -> bool {
        self.method.tension == 0.0 && self.open.sides.is_empty()
    }

    /// Whether the divergence at `x` (m) counts: deep in a buffer the sums reach no fluid, and at its far end they lack neighbors.
    pub(crate) fn is_near_fluid(&self, x: Vec2) -> bool {
        let support = self.method.kernel.support();
        self.open.sides.iter().all(|side| side.overshoot(x) < support)
    }

    /// Weight of shifting and density-error correction for a fluid particle at `x` (m): 0 at a side with a given velocity, since buffers have neither, and 1 from
    /// the distance h on. A row that enters would otherwise receive both at once, as an impulse. Without surface tension the density error is corrected by
    /// displacements, which give no impulse.
    pub(crate) fn weight_of_corrections(&self, x: Vec2) -> f64 {
        if self.method.tension == 0.0 {
            return 1.0;
        }
        let sides = self.open.sides.iter().filter(|side| side.given_pressure().is_none());
        let weight = |side: &OpenSide| (-side.overshoot(x) / self.method.kernel.h).clamp(0.0, 1.0);
        sides.map(weight).fold(1.0, f64::min)
    }
}
