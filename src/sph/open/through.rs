//! Periodic sides with a given flow: the velocity near the side is set anew in each step [Huber2013, section 4].
//!
//! What leaves through the opposite side comes back in, so that inflow equals outflow; it can change its phase there.

use crate::math::Vec2;
use crate::sph::domain::Domain;
use crate::sph::open::{Ledger, OpenSide};
use crate::sph::particles::Phase;

/// A periodic side that fluid comes in through at a given velocity.
#[derive(Debug, Clone, PartialEq)]
pub struct Through {
    /// Place, velocity and what comes in; its `depth` in m is the width of the strip inside in which the velocity is set.
    pub side: OpenSide,
}

impl Through {
    /// Width of the strip over h: what comes in is within reach of nothing else.
    pub const WIDTH: f64 = 2.0;

    /// Sets the velocities in the strip, and the phase of what came through the side from `old` to `new` (m).
    pub fn apply(
        &self,
        domain: &Domain,
        (old, new): (&[Vec2], &[Vec2]),
        (velocity, phase): (&mut [Vec2], &mut [Phase]),
        ledger: &mut Ledger,
    ) {
        let (side, half) = (&self.side, 0.5 * domain.bounds.size()[self.side.axis()]);
        for (a, &x) in new.iter().enumerate() {
            let moved = side.beyond(x) - side.beyond(old[a]);
            if moved.abs() > half {
                let inwards = moved > 0.0;
                ledger.leaves(if inwards { side.number ^ 1 } else { side.number }, phase[a]);
                if let (true, Some(enters)) = (inwards, side.enters) {
                    phase[a] = enters;
                }
                ledger.comes(if inwards { side.number } else { side.number ^ 1 }, phase[a]);
            }
            if -side.beyond(x) < side.depth
                && let Some(given) = side.given_velocity(x)
            {
                velocity[a] = given;
            }
        }
    }
}
