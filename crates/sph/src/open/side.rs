//! An open side: its position, the condition given there and the phase that comes in.

use crate::open::profile::{Opening, Profile};
use crate::particles::Phase;
use meniscus_core::math::Vec2;

/// Depth of a buffer over h: its particles within the support of the fluid have a full support themselves.
pub const DEPTH: f64 = 4.0;

/// Condition at an open side.
#[derive(Debug, Clone, PartialEq)]
pub enum Drive {
    /// Pressure in Pa, in the phase that comes in.
    Pressure(f64),
    /// Inward velocity.
    Velocity(Profile),
}

/// An open side.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenSide {
    /// Left, right, bottom, top: 0 to 3.
    pub number: usize,
    /// Coordinate of the side in m.
    pub at: f64,
    /// The condition.
    pub drive: Drive,
    /// The phase that comes in; `None`: each row of particles continues with its own.
    pub inflow_phase: Option<Phase>,
    /// The phase to which the given pressure applies.
    pub main: Phase,
    /// The openings between solids, each with room for at least one row of particles.
    pub openings: Vec<Opening>,
    /// Nominal row spacing in m.
    pub row_spacing: f64,
    /// V_0 in m², the area of a particle.
    pub cell: f64,
    /// Minimum depth of the buffer in m.
    pub depth: f64,
    /// Steps in which the pressure rises.
    pub steps: Option<Staircase>,
    /// The mean velocity over time, where it rises.
    pub ramp: Option<Ramp>,
}

/// A mean velocity that rises linearly in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ramp {
    /// The velocity at time zero in m/s.
    pub first: f64,
    /// The acceleration in m/s².
    pub acceleration: f64,
}

/// A pressure that rises in equal steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Staircase {
    /// The first pressure in Pa.
    pub first: f64,
    /// Height of a step in Pa.
    pub rise: f64,
    /// Time for which each pressure is held in s.
    pub hold: f64,
}

impl Staircase {
    /// The pressure in Pa from `time` (s) on.
    pub(crate) fn at(&self, time: f64) -> f64 {
        /// Tolerance with which a time counts as an integer multiple of `hold`.
        const ROUNDING: f64 = 1e-9;
        self.first + self.rise * (time / self.hold + ROUNDING).floor()
    }
}

impl OpenSide {
    /// Name in case files.
    pub(crate) fn name(&self) -> &'static str {
        ["left", "right", "bottom", "top"][self.number]
    }

    /// 0: normal along x, 1: along y.
    pub fn axis(&self) -> usize {
        self.number / 2
    }

    /// Sign of the inward direction along the axis.
    pub fn inward_sign(&self) -> f64 {
        if self.number.is_multiple_of(2) { 1.0 } else { -1.0 }
    }

    /// Distance of `x` beyond the side in m; negative inside.
    pub fn overshoot(&self, x: Vec2) -> f64 {
        self.inward_sign() * (self.at - x[self.axis()])
    }

    /// `x` projected along the normal to the distance `beyond` (m) beyond the side.
    pub(crate) fn projected(&self, x: Vec2, beyond: f64) -> Vec2 {
        let mut y = x;
        y[self.axis()] = self.at - self.inward_sign() * beyond;
        y
    }

    /// The velocity along the normal with the inward speed `inwards` in m/s.
    pub(crate) fn velocity(&self, inwards: f64) -> Vec2 {
        let mut v = Vec2::zeros();
        v[self.axis()] = self.inward_sign() * inwards;
        v
    }

    /// The opening at the coordinate `y` (m) along the side, or the nearest one.
    pub(crate) fn opening(&self, y: f64) -> Option<&Opening> {
        self.openings.iter().min_by(|a, b| a.distance(y).total_cmp(&b.distance(y)))
    }

    /// Spacing in m of particles along a row of an opening: rows of equal width fill it, and each particle occupies the area `cell`.
    pub(crate) fn spacing_in(&self, opening: &Opening) -> f64 {
        self.cell * opening.rows(self.row_spacing).max(1) as f64 / opening.width()
    }

    /// Number of particles in each row of an opening.
    pub(crate) fn count_in(&self, opening: &Opening) -> usize {
        /// Tolerance with which a number counts as an integer.
        const ROUNDING: f64 = 1e-9;
        (self.depth / self.spacing_in(opening) - ROUNDING).ceil() as usize
    }

    /// Depth of the buffer in m at `x`: an integer number of particles along the rows there.
    pub(crate) fn depth_at(&self, x: Vec2) -> f64 {
        let of = |opening: &Opening| self.count_in(opening) as f64 * self.spacing_in(opening);
        self.opening(x[1 - self.axis()]).map_or(self.depth, of)
    }

    /// The given inward flow rate in m²/s, 0 where a pressure is given.
    pub fn flow_rate(&self) -> f64 {
        self.mean_velocity().unwrap_or(0.0) * self.openings.iter().map(Opening::width).sum::<f64>()
    }

    /// The given inward flow rate in m²/s, on average from time zero to `time` (s).
    pub(crate) fn average_flow_rate(&self, time: f64) -> f64 {
        let width = self.openings.iter().map(Opening::width).sum::<f64>();
        self.velocity_at(0.5 * time).unwrap_or(0.0) * width
    }

    /// The mean inward velocity in m/s that is given for the present step.
    fn mean_velocity(&self) -> Option<f64> {
        match &self.drive {
            Drive::Velocity(profile) => Some(profile.mean),
            Drive::Pressure(_) => None,
        }
    }

    /// The mean inward velocity in m/s that is given at `time` (s), `None` where a pressure is given.
    pub fn velocity_at(&self, time: f64) -> Option<f64> {
        self.ramp.map_or(self.mean_velocity(), |ramp| Some(ramp.first + ramp.acceleration * time))
    }

    /// Sets the pressure or the velocity that applies from `time` (s) on, where it rises.
    pub(crate) fn take_step(&mut self, time: f64) {
        if let Some(steps) = self.steps {
            self.drive = Drive::Pressure(steps.at(time));
        }
        if let (Some(mean), Drive::Velocity(profile)) = (self.velocity_at(time), &mut self.drive) {
            profile.mean = mean;
        }
    }

    /// The given velocity in m/s of the row at `x`, `None` where a pressure is given.
    pub(crate) fn given_velocity(&self, x: Vec2) -> Option<Vec2> {
        let Drive::Velocity(profile) = &self.drive else { return None };
        let (y, at_rest) = (x[1 - self.axis()], Some(Vec2::zeros()));
        self.opening(y)
            .map_or(at_rest, |opening| Some(self.velocity(profile.of_row(opening, opening.rows(self.row_spacing), y))))
    }

    /// The given pressure in Pa, `None` where a velocity is given.
    pub fn given_pressure(&self) -> Option<f64> {
        match self.drive {
            Drive::Pressure(pressure) => Some(pressure),
            Drive::Velocity(_) => None,
        }
    }
}
