//! A periodic box of particles on a lattice, in order or shaken, with all that the terms of the method need.
#![allow(dead_code, reason = "each test file and benchmark uses its own part")]

use meniscus_core::math::{Bounds, Vec2};
use meniscus_sph::domain::Domain;
use meniscus_sph::fill::Lattice;
use meniscus_sph::images::Images;
use meniscus_sph::kernel::WendlandC2;
use meniscus_sph::pairs::Pairs;
use meniscus_sph::poisson::{Matrix, assemble};
use meniscus_sph::terms::density;

pub use super::dice::Dice;

/// Smoothing length over spacing, as cases have it by default.
pub const SMOOTHING_RATIO: f64 = 1.5;

/// Particles in the unit square.
pub struct Cloud {
    pub domain: Domain,
    pub kernel: WendlandC2,
    pub points: Vec<Vec2>,
    pub pairs: Pairs,
    pub images: Images,
    pub volume: Vec<f64>,
    /// Distance of neighbors on the lattice in m.
    pub spacing: f64,
    /// Volume of a particle on the lattice in m².
    pub lattice_volume: f64,
}

impl Cloud {
    /// `side` × `side` particles, each moved by up to `shake` of the spacing in both directions.
    pub fn new(side: usize, periodic: bool, shake: f64) -> Self {
        let bounds = Bounds { min: Vec2::zeros(), max: Vec2::repeat(1.0) };
        let domain = Domain::new(bounds, [periodic; 2], vec![]);
        let spacing = 1.0 / side as f64;
        let lattice = Lattice::fitting(bounds, spacing);
        let kernel = lattice.consistent(WendlandC2::new(SMOOTHING_RATIO * spacing));
        let mut dice = Dice::new(7);
        let middle = |i: usize| (i as f64 + 0.5) * spacing;
        let points: Vec<Vec2> = (0..side * side)
            .map(|i| domain.wrapped(Vec2::new(middle(i % side), middle(i / side)) + shake * spacing * dice.vector()))
            .collect();
        let mut all = points.clone();
        let images = Images::append(&mut all, &domain, kernel.support());
        let pairs = Pairs::find(&all, points.len(), &domain, &kernel);
        let volume = density::volume(&pairs, points.len());
        Self { domain, kernel, points, pairs, images, volume, spacing, lattice_volume: lattice.volume() }
    }

    /// x_a − x_b in m.
    pub fn separation(&self, a: usize, b: usize) -> Vec2 {
        self.domain.separation(self.points[a], self.points[b])
    }

    /// The particles farther from the sides of the box than twice the support, so that no neighbor misses one.
    pub fn inner(&self) -> Vec<usize> {
        let margin = 2.0 * self.kernel.support();
        let within = |x: &Vec2| x.iter().all(|&v| (margin..1.0 - margin).contains(&v));
        (0..self.points.len()).filter(|&a| within(&self.points[a])).collect()
    }
}

/// The matrix of the pressure equation.
pub fn pressure_matrix(cloud: &Cloud, density: &[f64]) -> Matrix {
    assemble(&cloud.pairs, &cloud.images, &cloud.volume, density, |_, _| true)
}

/// A right side of the pressure equation: numbers that look random and sum to zero.
pub fn right_side(count: usize) -> Vec<f64> {
    let mut dice = Dice::new(23);
    let values: Vec<f64> = (0..count).map(|_| dice.between(-1.0, 1.0)).collect();
    let mean = values.iter().sum::<f64>() / count as f64;
    values.iter().map(|value| value - mean).collect()
}
