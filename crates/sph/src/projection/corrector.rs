//! The corrector: the velocity at the end of a step [Huber2013, Eq. 26].

use super::given_flow::{add_responses, gradient_changes};
use super::intermediate::{Corrected, Predicted, Projected};
use crate::fields::Fields;
use crate::method::PressureGradient;
use crate::surface_force::SurfaceForce;
use crate::terms::pressure_gradient;
use crate::view::View;
use meniscus_core::math::Vec2;

impl View<'_, Fields> {
    /// The corrector: the velocity of fluid and buffers at the end of the step [Huber2013, Eq. 26], with the given flow rates through periodic sides.
    pub(super) fn correct(&self, predicted: &Predicted, mut projected: Projected) -> Corrected {
        let Projected { pressure, responses, .. } = &mut projected;
        let acceleration = self.pressure_acceleration(pressure);
        let corrected = acceleration.iter().zip(&*predicted.velocity).map(|(a, v)| v + predicted.dt * a);
        let mut velocity: Vec<Vec2> = corrected.collect();
        let gradient_changes = gradient_changes(self.config, &velocity, responses, predicted.dt);
        add_responses(&mut velocity, responses, &gradient_changes, predicted.dt);
        for (response, change) in responses.iter().zip(&gradient_changes) {
            pressure.iter_mut().zip(&response.potential).for_each(|(p, by)| *p += change * by);
        }
        velocity.extend(std::iter::repeat_n(Vec2::zeros(), self.state.particles.open));
        predicted.interior.set_buffer_velocity(&self.state.particles, &self.config.open.sides, &mut velocity);
        Corrected { velocity, gradient_changes, projected }
    }

    /// The acceleration of the fluid particles in m/s² by the gradient of a `pressure` (Pa), including the gravity that it balances and the
    /// jump across the interface.
    pub(super) fn pressure_acceleration(&self, pressure: &[f64]) -> Vec<Vec2> {
        let (fluids, f) = (self.state.particles.fluids, &self.fields.bulk);
        let mut p = pressure.to_vec();
        let form = self.config.method.pressure_gradient();
        if form != PressureGradient::Difference {
            // The constant matters in these forms: with all pressures at or above the background the particles remain ordered.
            let lowest = p.iter().fold(f64::INFINITY, |m, p| m.min(*p));
            let shift = self.config.method.background_pressure_at(self.state.particles.fluid_speed()) - lowest;
            p.iter_mut().for_each(|p| *p += shift);
        }
        let p = self.neighborhood.images.field(p);
        let (pairs, volume, density) = (&self.neighborhood.pairs, &f.volume, &f.density);
        match form {
            PressureGradient::Symmetric => pressure_gradient::symmetric(pairs, volume, density, &p, fluids),
            PressureGradient::Weighted => pressure_gradient::weighted(pairs, volume, density, &p, fluids),
            PressureGradient::Difference => {
                let hydrostatic = self.hydrostatic();
                let rise = |a: usize, b: usize| hydrostatic.difference(a, b);
                let mut acceleration = pressure_gradient::difference(pairs, volume, density, &p, rise, fluids);
                // Only with tension: without it the uncorrected sums give more accurate decay of vortices (docs/numerics/pressure.md).
                if let SurfaceForce::Jump { moment, .. } = &self.fields.interface.force {
                    pressure_gradient::correct_gradient(moment, &mut acceleration);
                }
                acceleration
            }
        }
    }
}
