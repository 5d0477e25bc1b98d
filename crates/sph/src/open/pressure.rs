//! The pressures of buffer particles at sides with a given pressure.
//!
//! The given value applies at the side. Beyond it the pressure is extrapolated with the gradient inside the side in the previous
//! step, separately in each phase: one value for the whole buffer would make the gradient vanish at the side.

use crate::open::side::{Drive, OpenSide};
use crate::particles::{Particles, Phase};

/// Width of the strip inside a side from which gradients are taken, over h.
const STRIP: f64 = 2.0;

/// Minimum number of particles of a phase in the strip for a gradient.
const FEWEST: usize = 5;

/// The given pressures of one step.
#[derive(Debug, Clone, Default)]
pub(crate) struct Prescribed {
    /// Pressure in Pa of each buffer particle, NaN where none is given.
    pub(crate) value: Vec<f64>,
    /// Reference pressure of the solve in Pa: the mean over the sides.
    pub(crate) reference: f64,
}

impl Prescribed {
    /// The pressures of the next step. `jump` is σκ in Pa at each buffer particle, NaN away from the interface.
    pub(crate) fn new(particles: &Particles, sides: &[OpenSide], jump: impl Fn(usize) -> f64, h: f64) -> Self {
        let mut value = vec![f64::NAN; particles.open];
        let (mut sum, mut count) = (0.0, 0.0);
        for side in sides {
            let Drive::Pressure(given) = side.drive else { continue };
            sum += given;
            count += 1.0;
            let beyond = |a: usize| side.overshoot(particles.position[a]);
            let buffer: Vec<usize> = particles.buffer().filter(|&b| beyond(b) >= 0.0).collect();
            let (total, found) = buffer
                .iter()
                .map(|&b| jump(b))
                .filter(|jump| jump.is_finite())
                .fold((0.0, 0.0), |(total, found), jump| (total + jump, found + 1.0));
            let jump = if found > 0.0 { total / found } else { 0.0 };
            let at_side = |phase: Phase| given + jump * (phase.color() - side.main.color());
            let strip: Vec<usize> = (0..particles.fluids).filter(|&a| (0.0..STRIP * h).contains(&-beyond(a))).collect();
            let slope = [Phase::Wetting, Phase::NonWetting].map(|phase| {
                let (mut top, mut bottom, mut count) = (0.0, 0.0, 0);
                for &a in strip.iter().filter(|&&a| particles.phase[a] == phase) {
                    top += (particles.pressure[a] - at_side(phase)) * beyond(a);
                    bottom += beyond(a) * beyond(a);
                    count += 1;
                }
                if count >= FEWEST { top / bottom } else { 0.0 }
            });
            for b in buffer {
                let phase = particles.phase[b];
                let slope = slope[usize::from(phase != Phase::Wetting)];
                value[b - particles.fluids] = at_side(phase) + slope * beyond(b);
            }
        }
        Self { value, reference: if count > 0.0 { sum / count } else { 0.0 } }
    }

    /// The given pressure in Pa of particle `a`, `None` if there is none; `fluids` fluid particles precede the buffer.
    #[inline]
    pub(crate) fn of(&self, a: usize, fluids: usize) -> Option<f64> {
        let value = *self.value.get(a.checked_sub(fluids)?)?;
        (!value.is_nan()).then_some(value)
    }
}
