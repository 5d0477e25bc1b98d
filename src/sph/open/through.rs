//! Periodic sides with a given flow rate: what leaves through the opposite side comes back in, and can change its phase there.
//!
//! The rate is kept by a mean pressure gradient (`src/sph/projection/given_flow.rs`), which is part of the state here.

use serde::{Deserialize, Serialize};

use crate::math::Vec2;
use crate::sph::domain::Domain;
use crate::sph::open::boundary_fluxes::BoundaryFluxes;
use crate::sph::open::profile::Shape;
use crate::sph::open::side::{Drive, OpenSide};
use crate::sph::particles::Phase;

/// How the given flow through a periodic side goes on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GivenFlow {
    /// The mean pressure gradient that drives it, in Pa/m along the way in.
    pub gradient: f64,
    /// The area in m² that came in since time zero, by the ways of all particles.
    pub passed: f64,
    /// The rate of the last step in m²/s.
    pub rate: f64,
    /// The largest relative error of the rate of a step.
    pub largest_error: f64,
}

/// Particles that move.
pub(crate) struct Moved<'a> {
    /// Where they were, in m.
    pub(crate) from: &'a [Vec2],
    /// Where they are, in m.
    pub(crate) to: &'a [Vec2],
    /// The area of each in m².
    pub(crate) volume: f64,
    /// How long it took them, in s.
    pub(crate) dt: f64,
}

impl OpenSide {
    /// The unit vector inwards.
    pub(crate) fn way(&self) -> Vec2 {
        self.velocity(1.0)
    }

    /// The velocity in m/s at `x` (m) of the parabola that is given, if one is.
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
    /// Counts what comes in through `side` as particles move, and changes the phase of those that come through it.
    pub(crate) fn pass(
        &mut self,
        side: &OpenSide,
        domain: &Domain,
        moved: &Moved,
        phase: &mut [Phase],
        fluxes: &mut BoundaryFluxes,
    ) {
        let (way, period) = (side.way(), domain.bounds.size()[side.axis()]);
        let mut gone = 0.0;
        for (a, (&from, &to)) in moved.from.iter().zip(moved.to).enumerate() {
            gone += domain.separation(to, from).dot(&way);
            let way_through = side.beyond(to) - side.beyond(from);
            if way_through.abs() > 0.5 * period {
                let inwards = way_through > 0.0;
                fluxes.leaves(if inwards { side.number ^ 1 } else { side.number }, phase[a]);
                if let (true, Some(enters)) = (inwards, side.enters) {
                    phase[a] = enters;
                }
                fluxes.comes(if inwards { side.number } else { side.number ^ 1 }, phase[a]);
            }
        }
        let passed = moved.volume * gone / period;
        let asked = side.flow_rate();
        self.passed += passed;
        self.rate = passed / moved.dt;
        self.largest_error = self.largest_error.max((self.rate / asked - 1.0).abs());
    }
}
