//! How the pressures of two neighbors differ in a fluid at rest: by the jump across its interface and by the weight between them.
//!
//! Pressure equation and pressure gradient weigh what is left of the differences by the same sums. So one fluid at rest feels no force,
//! particle by particle and up to its walls, however the particles lie (a well-balanced scheme), and two with the pressure jump none
//! but what their curvature errs by. Without a jump the rises across an interface of two densities do not close.

use rayon::prelude::*;

use crate::math::Vec2;
use crate::sph::boundary::shepard;
use crate::sph::flow::Flow;
use crate::sph::pairs::Pairs;
use crate::sph::parallel::GRAIN;
use crate::sph::poisson::Matrix;
use crate::sph::surface_force::jump::Jump;

/// What makes the pressure of a fluid at rest uneven.
pub(super) struct HydrostaticDifference<'a> {
    jump: Option<&'a Jump>,
    tension: f64,
    /// In kg/m³ over particles and images, empty without gravity.
    density: Vec<f64>,
    /// g·x in m²/s² over particles and images, empty without gravity.
    potential: Vec<f64>,
    /// The mean gradient in Pa/m that drives given flows, with the flow whose places it acts between; none without.
    driven: Option<(Vec2, &'a Flow)>,
}

impl Flow {
    /// The fluid at its present places, at rest.
    pub(super) fn hydrostatic(&self) -> HydrostaticDifference<'_> {
        let gravity = self.setting.balanced_gravity();
        let mut potential = Vec::new();
        if gravity != Vec2::zeros() {
            potential.extend(self.state.particles.position.iter().map(|x| gravity.dot(x)));
            self.neighborhood.images.extend(&mut potential);
        }
        let jump = self.fields.jump.as_ref();
        let density = if potential.is_empty() { Vec::new() } else { self.density_at_rest() };
        let driving = self.driving_gradient();
        let driven = (driving != Vec2::zeros() && self.gradient_in_pressure()).then_some((driving, self));
        HydrostaticDifference { jump, tension: self.setting.method.tension, density, potential, driven }
    }

    /// The density in kg/m³ of the phase, over particles and images; walls have that of the side they take, or of the fluid nearby.
    fn density_at_rest(&self) -> Vec<f64> {
        let (particles, moving, method) = (&self.state.particles, self.state.particles.moving(), &self.setting.method);
        if let Some(jump) = &self.fields.jump {
            let (wetting, other) = (method.wetting_fluid.density, method.other_fluid.density);
            return jump.side.iter().map(|&side| if side == 1.0 { wetting } else { other }).collect();
        }
        let of_phase = particles.phase[..moving].iter().map(|&phase| method.fluid(phase).density);
        let mut density: Vec<f64> = of_phase.collect();
        density.resize(particles.len(), method.mean_density());
        self.neighborhood.images.extend(&mut density);
        shepard::into_walls(&self.neighborhood.pairs, &self.fields.fluid_volume, moving, &mut density);
        self.neighborhood.images.extend(&mut density);
        density
    }
}

impl HydrostaticDifference<'_> {
    /// p_b − p_a = σ κ̄_ab (c_b − c_a) + (ρ_a + ρ_b)/2 g·(x_b − x_a) + G·(x_b − x_a) in Pa; G drives given flows, and the pressure is
    /// that without its mean gradient −G.
    #[inline]
    pub(super) fn difference(&self, a: usize, b: usize) -> f64 {
        let jump = self.jump.map_or(0.0, |jump| self.tension * jump.of(a, b));
        let jump = self.driven.map_or(jump, |(gradient, flow)| jump - gradient.dot(&flow.separation(a, b)));
        if self.potential.is_empty() {
            return jump;
        }
        jump + 0.5 * (self.density[a] + self.density[b]) * (self.potential[b] - self.potential[a])
    }

    /// Takes Σ_b A_ab (p_b − p_a) of the fluid at rest off the right side of the pressure equation.
    pub(super) fn subtract_from(&self, right: &mut [f64], matrix: &Matrix, pairs: &Pairs) {
        if self.jump.is_none() && self.potential.is_empty() && self.driven.is_none() {
            return;
        }
        // The jump alone acts between particles on the two sides of the interface.
        let is_level = self.potential.is_empty() && self.driven.is_none();
        right.par_iter_mut().enumerate().with_min_len(GRAIN).for_each(|(a, right)| {
            if is_level && self.jump.is_some_and(|jump| !jump.is_across[a]) {
                return;
            }
            let rises = pairs.of(a).zip(&matrix.coupling[pairs.row(a)]);
            *right -= rises.map(|(ab, coupling)| f64::from(*coupling) * self.difference(a, ab.b)).sum::<f64>();
        });
    }
}
