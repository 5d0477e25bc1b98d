//! Pressure differences of neighbors in a fluid at rest: the jump across the interface and the hydrostatic pressure.
//!
//! Pressure equation and pressure gradient use the same sums over the deviations from these differences. So in a single fluid at rest the force
//! on each particle vanishes, up to the walls and for any arrangement of particles (a well-balanced scheme); with two fluids and the pressure jump
//! only the error of the curvature remains. Without the jump the differences across an interface of two densities are not consistent.

use crate::boundary::shepard;
use crate::fields::Fields;
use crate::images::Field;
use crate::pairs::Pairs;
use crate::parallel::change_each;
use crate::poisson::Matrix;
use crate::surface_force::jump::Jump;
use crate::view::View;
use meniscus_core::math::Vec2;

/// Sources of pressure differences in a fluid at rest.
pub(super) struct HydrostaticDifference<'a> {
    jump: Option<&'a Jump>,
    tension: f64,
    /// In kg/m³, empty without gravity.
    density: Field<f64>,
    /// g·x in m²/s², empty without gravity.
    potential: Field<f64>,
    /// The mean gradient in Pa/m that drives given flows, with the flow for the separation of particles; `None` without one.
    driven: Option<(Vec2, &'a View<'a, Fields>)>,
}

impl View<'_, Fields> {
    /// The pressure differences at the present positions.
    pub(super) fn hydrostatic(&self) -> HydrostaticDifference<'_> {
        let gravity = self.config.balanced_gravity();
        let (mut potential, mut density) = (Field::default(), Field::default());
        if gravity != Vec2::zeros() {
            let of_particles = self.state.particles.position.iter().map(|x| gravity.dot(x)).collect();
            (potential, density) = (self.neighborhood.images.field(of_particles), self.density_at_rest());
        }
        let jump = self.fields.interface.force.jump();
        let driving = self.driving_gradient();
        let driven = (driving != Vec2::zeros() && self.gradient_in_pressure()).then_some((driving, self));
        HydrostaticDifference { jump, tension: self.config.method.tension, density, potential, driven }
    }

    /// The density in kg/m³ of the phase; on walls that of the side of the interface to which they are assigned, or of the fluid nearby.
    fn density_at_rest(&self) -> Field<f64> {
        let (particles, moving, method) = (&self.state.particles, self.state.particles.moving(), &self.config.method);
        if let Some(jump) = self.fields.interface.force.jump() {
            let (wetting, other) = (method.wetting_fluid.density, method.other_fluid.density);
            let of_side = jump.side[..particles.len()].iter().map(|&side| if side == 1.0 { wetting } else { other });
            return self.neighborhood.images.field(of_side.collect());
        }
        let of_phase = particles.phase[..moving].iter().map(|&phase| method.fluid(phase).density);
        let mut density: Vec<f64> = of_phase.collect();
        density.resize(particles.len(), method.mean_density());
        shepard::into_walls(self.neighborhood, &self.fields.bulk.fluid_volume, moving, density)
    }
}

impl HydrostaticDifference<'_> {
    /// p_b − p_a = σ κ̄_ab (c_b − c_a) + (ρ_a + ρ_b)/2 g·(x_b − x_a) + G·(x_b − x_a) in Pa; G drives given flows, and p excludes the mean gradient −G.
    #[inline]
    pub(super) fn difference(&self, a: usize, b: usize) -> f64 {
        let jump = self.jump.map_or(0.0, |jump| self.tension * jump.of(a, b));
        let jump = self.driven.map_or(jump, |(gradient, flow)| jump - gradient.dot(&flow.separation(a, b)));
        if self.potential.is_empty() {
            return jump;
        }
        jump + 0.5 * (self.density[a] + self.density[b]) * (self.potential[b] - self.potential[a])
    }

    /// Subtracts Σ_b A_ab (p_b − p_a) of the fluid at rest from the right-hand side of the pressure equation.
    pub(super) fn subtract_from(&self, right: &mut [f64], matrix: &Matrix, pairs: &Pairs) {
        if self.jump.is_none() && self.potential.is_empty() && self.driven.is_none() {
            return;
        }
        // The jump alone acts only between particles on opposite sides of the interface.
        let is_level = self.potential.is_empty() && self.driven.is_none();
        change_each(right, |a, right| {
            if is_level && self.jump.is_some_and(|jump| !jump.is_across[a]) {
                return;
            }
            let rises = pairs.of(a).zip(&matrix.coupling[pairs.row(a)]);
            *right -= rises.map(|(ab, coupling)| f64::from(*coupling) * self.difference(a, ab.b)).sum::<f64>();
        });
    }
}
