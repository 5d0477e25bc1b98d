//! What is given to a flow: the method, the box, its walls and its sides.

use crate::math::{Vec2, perpendicular};
use crate::sph::domain::{Domain, WallQuery};
use crate::sph::method::{Method, PressureGradient};
use crate::sph::open::Open;
use crate::sph::wetting::wall::WallField;

/// The curvature of a wall is the turn of its normal this far to both sides, over dx.
const TURN_OVER: f64 = 0.25;

/// Walls with more curvature than this, over 1/h, count as edges.
const TIGHTEST: f64 = 0.5;

/// What is given. It changes with the time of the case alone: body forces that take turns, pressures that rise.
pub struct Configuration {
    /// Constants.
    pub method: Method,
    /// Box and sides.
    pub domain: Domain,
    /// Wall distance and normal.
    pub wall: WallQuery,
    /// Wetting models and velocities of the walls.
    pub wall_properties: WallField,
    /// Open sides, and periodic ones with a given flow rate.
    pub open: Open,
    /// Time in s in which the slowest viscous motion decays, infinite with surface tension and without walls.
    pub viscous_time: f64,
    /// Time in s since when the present forces act.
    pub since: f64,
}

impl Configuration {
    /// The part of gravity in m/s² that the pressure can balance: not along periods, where it drives the flow.
    ///
    /// The forms of the gradient with the sum of pressures do not have it: their sums differ from those of the pressure equation.
    pub(crate) fn balanced_gravity(&self) -> Vec2 {
        if self.method.pressure_gradient() != PressureGradient::Difference {
            return Vec2::zeros();
        }
        let [x, y] = self.domain.periodic.map(|periodic| if periodic { 0.0 } else { 1.0 });
        self.method.gravity.component_mul(&Vec2::new(x, y))
    }

    /// The turn of the normal along the wall nearest to `x` (m) over its length, in 1/m; positive where the solid is convex, 0 at edges.
    pub(crate) fn curvature_of_wall(&self, x: Vec2) -> f64 {
        let (distance, normal) = (self.wall)(x);
        let (inside, along) = (x - distance * normal, perpendicular(normal));
        let normal_at = |way: f64| (self.wall)(inside + way * along).1;
        let step = TURN_OVER * self.method.spacing;
        let curvature = (normal_at(step) - normal_at(-step)).dot(&along) / (2.0 * step);
        if curvature.abs() * self.method.kernel.h < TIGHTEST { curvature } else { 0.0 }
    }

    /// Whether the pressure of a long step becomes that of its end. Not with surface tension, which keeps steps so short that the pressure
    /// follows, and not with inlets and outlets, where this is unstable: their buffers have no viscous forces.
    pub(crate) fn has_viscous_pressure(&self) -> bool {
        self.method.tension == 0.0 && self.open.sides.is_empty()
    }

    /// Whether the divergence at the place `x` (m) counts: deep beyond an open side the sums see no fluid, and no neighbors at its end.
    pub(crate) fn sees_the_fluid(&self, x: Vec2) -> bool {
        let support = self.method.kernel.support();
        self.open.sides.iter().all(|side| side.beyond(x) < support)
    }
}
