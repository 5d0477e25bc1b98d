//! Periodic sides with a given flow rate: fluid that leaves through the opposite side re-enters, and can change its phase there.
//!
//! A mean pressure gradient maintains the rate (`crates/sph/src/projection/given_flow.rs`); it is part of the state here.

use serde::{Deserialize, Serialize};

use crate::domain::Domain;
use crate::open::boundary_fluxes::BoundaryFluxes;
use crate::open::profile::Shape;
use crate::open::side::{Drive, OpenSide};
use crate::particles::Phase;
use meniscus_core::math::Vec2;

/// State of the given flow through a periodic side.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GivenFlow {
    /// The mean pressure gradient that drives it, in Pa/m along the inward direction.
    pub gradient: f64,
    /// The area in m² that came in since time zero, from the displacements of all particles.
    pub passed: f64,
    /// The rate of the last step in m²/s.
    pub rate: f64,
    /// The largest relative error of the rate of a step.
    pub largest_error: f64,
}

/// Displacement of all particles in a step.
pub(crate) struct Moved<'a> {
    /// Positions before, in m.
    pub(crate) from: &'a [Vec2],
    /// Positions after, in m.
    pub(crate) to: &'a [Vec2],
    /// The area of each particle in m².
    pub(crate) volume: f64,
    /// Duration in s.
    pub(crate) dt: f64,
}

impl OpenSide {
    /// The unit vector inwards.
    pub(crate) fn inward(&self) -> Vec2 {
        self.velocity(1.0)
    }

    /// The velocity in m/s at `x` (m) of the given parabolic profile, `None` without one.
    pub(crate) fn parabola(&self, x: Vec2) -> Option<Vec2> {
        let y = x[1 - self.axis()];
        match &self.drive {
            Drive::Velocity(profile) if profile.shape != Shape::Plug => {
                let opening = self.openings.iter().find(|opening| opening.distance(y) == 0.0);
                Some(self.velocity(opening.map_or(0.0, |opening| profile.at(opening, y))))
            }
            _ => None,
        }
    }
}

impl GivenFlow {
    /// Counts what comes in through `side` as particles move, and changes the phase of particles that enter through it.
    pub(crate) fn pass(
        &mut self,
        side: &OpenSide,
        domain: &Domain,
        moved: &Moved,
        phase: &mut [Phase],
        fluxes: &mut BoundaryFluxes,
    ) {
        let (inward, period) = (side.inward(), domain.bounds.size()[side.axis()]);
        let mut displacement = 0.0;
        for (a, (&from, &to)) in moved.from.iter().zip(moved.to).enumerate() {
            displacement += domain.separation(to, from).dot(&inward);
            let crossing = side.overshoot(to) - side.overshoot(from);
            if crossing.abs() > 0.5 * period {
                let inwards = crossing > 0.0;
                fluxes.count_outflow(if inwards { side.number ^ 1 } else { side.number }, phase[a]);
                if let (true, Some(enters)) = (inwards, side.inflow_phase) {
                    phase[a] = enters;
                }
                fluxes.count_inflow(if inwards { side.number } else { side.number ^ 1 }, phase[a]);
            }
        }
        let passed = moved.volume * displacement / period;
        let requested = side.flow_rate();
        self.passed += passed;
        self.rate = passed / moved.dt;
        self.largest_error = self.largest_error.max((self.rate / requested - 1.0).abs());
    }
}
