//! One open side: where it is, what is given there and what comes in.

use crate::math::Vec2;
use crate::sph::open::Profile;
use crate::sph::particles::Phase;

/// Depth of a buffer over h: particles within the support of the fluid have their own whole support within the buffer.
pub const DEPTH: f64 = 4.0;

/// What is given at an open side.
#[derive(Debug, Clone, PartialEq)]
pub enum Drive {
    /// Pressure in Pa, in the phase that comes in.
    Pressure(f64),
    /// Velocity inwards.
    Velocity(Profile),
}

/// An open side.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenSide {
    /// Left, right, bottom, top: 0 to 3.
    pub number: usize,
    /// Coordinate of the side in m.
    pub at: f64,
    /// What is given.
    pub drive: Drive,
    /// The phase that comes in; none: each file of particles goes on with its own.
    pub enters: Option<Phase>,
    /// The phase that the given pressure is that of.
    pub main: Phase,
    /// Depth of the buffer in m, a whole number of spacings.
    pub depth: f64,
    /// How the pressure rises.
    pub steps: Option<Staircase>,
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
    /// The pressure in Pa that begins at `time` (s), or holds then.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        /// The end of a step is told in whole multiples of its length, up to rounding.
        const ROUNDING: f64 = 1e-9;
        self.first + self.rise * (time / self.hold + ROUNDING).floor()
    }
}

impl OpenSide {
    /// Name in case files.
    #[must_use]
    pub fn name(&self) -> &'static str {
        ["left", "right", "bottom", "top"][self.number]
    }

    /// 0: normal along x, 1: along y.
    #[must_use]
    pub fn axis(&self) -> usize {
        self.number / 2
    }

    /// Sign of the direction inwards along the axis.
    #[must_use]
    pub fn inwards(&self) -> f64 {
        if self.number.is_multiple_of(2) { 1.0 } else { -1.0 }
    }

    /// How far `x` lies beyond the side in m; below 0 inside.
    #[must_use]
    pub fn beyond(&self, x: Vec2) -> f64 {
        self.inwards() * (self.at - x[self.axis()])
    }

    /// `x` moved along the normal to a place `beyond` (m) the side.
    #[must_use]
    pub fn placed(&self, x: Vec2, beyond: f64) -> Vec2 {
        let mut y = x;
        y[self.axis()] = self.at - self.inwards() * beyond;
        y
    }

    /// The velocity of the speed `inwards` in m/s along the normal.
    #[must_use]
    pub fn velocity(&self, inwards: f64) -> Vec2 {
        let mut v = Vec2::zeros();
        v[self.axis()] = self.inwards() * inwards;
        v
    }

    /// Sets the pressure that holds from `time` (s) on, where it rises in steps.
    pub fn take_step(&mut self, time: f64) {
        if let Some(steps) = self.steps {
            self.drive = Drive::Pressure(steps.at(time));
        }
    }

    /// The given velocity in m/s at `x`, none where a pressure is given.
    #[must_use]
    pub fn given_velocity(&self, x: Vec2) -> Option<Vec2> {
        match &self.drive {
            Drive::Velocity(profile) => Some(self.velocity(profile.at(x[1 - self.axis()]))),
            Drive::Pressure(_) => None,
        }
    }

    /// The given pressure in Pa, none where a velocity is given.
    #[must_use]
    pub fn given_pressure(&self) -> Option<f64> {
        match self.drive {
            Drive::Pressure(pressure) => Some(pressure),
            Drive::Velocity(_) => None,
        }
    }
}
