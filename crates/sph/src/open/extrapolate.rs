//! Extrapolation of fluid fields beyond an open side along its normal: moving least squares at an interior point within the fluid.

use nalgebra::{Matrix4, Vector4};

use crate::cells::Cells;
use crate::domain::Domain;
use crate::kernel::WendlandC2;
use crate::open::side::OpenSide;
use crate::particles::Particles;
use meniscus_core::math::Vec2;

/// Distance of the interior points from the side, over h: there the stencil of the fit has fluid on both sides.
const INSET: f64 = 1.0;

/// Weights whose magnitudes sum to more than this would amplify the noise of single particles: the fit is rejected.
const LARGEST_SUM: f64 = 2.5;

/// For each buffer particle at a side with a given pressure the fluid particles around its interior point, with weights that sum to one.
#[derive(Debug, Clone, Default)]
pub(crate) struct InteriorPoints {
    start: Vec<usize>,
    terms: Vec<(u32, f64)>,
}

impl InteriorPoints {
    /// The interior points of all buffer particles; those of sides with a given velocity have none.
    pub(crate) fn new(particles: &Particles, sides: &[OpenSide], domain: &Domain, kernel: &WendlandC2) -> Self {
        let mut interior = Self { start: vec![0], terms: Vec::new() };
        let reach = (2.0 * INSET + 1.0) * kernel.support();
        let is_near = |x: Vec2| sides.iter().any(|side| side.given_pressure().is_some() && -side.overshoot(x) < reach);
        let fluid: Vec<u32> =
            (0..particles.fluids).filter(|&a| is_near(particles.position[a])).map(|a| a as u32).collect();
        let points: Vec<Vec2> = fluid.iter().map(|&a| particles.position[a as usize]).collect();
        let cells = Cells::build(&points, domain, kernel.support());
        let mut near = Vec::new();
        for b in particles.buffer() {
            let x = particles.position[b];
            if let Some(side) = sides.iter().find(|side| side.overshoot(x) >= 0.0 && side.given_pressure().is_some()) {
                let inside = side.projected(x, -INSET * kernel.h);
                near.clear();
                cells.visit_near(inside, |i, r| {
                    let w = kernel.w(r.norm());
                    if w > 0.0 {
                        near.push((fluid[i as usize], w, -r / kernel.h));
                    }
                });
                interior.terms.extend(weights(&near, 1 - side.axis()));
            }
            interior.start.push(interior.terms.len());
        }
        interior
    }

    /// The value of `field` at the interior point of the `i`-th buffer particle; `None` without fluid around it.
    pub(crate) fn value(&self, i: usize, field: &[Vec2]) -> Option<Vec2> {
        let terms = &self.terms[self.start[i]..self.start[i + 1]];
        (!terms.is_empty()).then(|| terms.iter().map(|&(a, w)| w * field[a as usize]).sum())
    }

    /// Sets the velocities of buffer particles in `velocity` (m/s): the given one at inlets; at sides with a given pressure the normal
    /// component at the interior point, so that it is constant along the normal.
    pub(crate) fn set_buffer_velocity(&self, particles: &Particles, sides: &[OpenSide], velocity: &mut [Vec2]) {
        self.set_buffers(particles, sides, velocity, OpenSide::given_velocity);
    }

    /// Sets the accelerations of buffer particles in `acceleration` (m/s²) consistently with [`Self::set_buffer_velocity`]: zero where the velocity is given.
    pub(crate) fn set_buffer_acceleration(&self, particles: &Particles, sides: &[OpenSide], acceleration: &mut [Vec2]) {
        self.set_buffers(particles, sides, acceleration, |side, x| side.given_velocity(x).map(|_| Vec2::zeros()));
    }

    fn set_buffers(
        &self,
        particles: &Particles,
        sides: &[OpenSide],
        field: &mut [Vec2],
        given: impl Fn(&OpenSide, Vec2) -> Option<Vec2>,
    ) {
        for (i, b) in particles.buffer().enumerate() {
            let x = particles.position[b];
            let Some(side) = sides.iter().find(|side| side.overshoot(x) >= 0.0) else { continue };
            field[b] = given(side, x).unwrap_or_else(|| {
                let inside = self.value(i, field).unwrap_or_default();
                side.velocity(side.inward_sign() * inside[side.axis()])
            });
        }
    }
}

/// Weights exact for fields that are linear along the normal and quadratic along the side: a plain average or linear fit would
/// flatten a parabola, and the pressure would have to compensate for the lost flow. Where the particles do not determine this fit,
/// the weights of a linear fit, then of the plain average. `r` is relative to the interior point, over h.
fn weights(near: &[(u32, f64, Vec2)], along: usize) -> Vec<(u32, f64)> {
    let sum: f64 = near.iter().map(|n| n.1).sum();
    let quadratic = |r: Vec2| Vector4::new(1.0, r[0], r[1], r[along] * r[along]);
    let linear = |r: Vec2| Vector4::new(1.0, r[0], r[1], 0.0);
    fitted(near, sum, quadratic)
        .or_else(|| fitted(near, sum, linear))
        .unwrap_or_else(|| near.iter().map(|&(a, w, _)| (a, w / sum)).collect())
}

/// The weights of the fit of a `basis` whose first function is 1 and whose others vanish at the interior point.
fn fitted(near: &[(u32, f64, Vec2)], sum: f64, basis: impl Fn(Vec2) -> Vector4<f64>) -> Option<Vec<(u32, f64)>> {
    let mut moments = Matrix4::zeros();
    for &(_, w, r) in near {
        let row = basis(r);
        moments += w / sum * row * row.transpose();
    }
    // A basis function that is zero has no moments.
    for i in 1..4 {
        if moments[(i, i)] == 0.0 {
            moments[(i, i)] = 1.0;
        }
    }
    let first = moments.cholesky()?.solve(&Vector4::x());
    let weights: Vec<(u32, f64)> = near.iter().map(|&(a, w, r)| (a, w / sum * first.dot(&basis(r)))).collect();
    (weights.iter().map(|(_, w)| w.abs()).sum::<f64>() < LARGEST_SUM).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_along_the_side_keeps_its_value_at_the_interior_point() {
        // Scattered points on one side of a wall at r.y = -0.3.
        let points = (0..40_u32).map(|i| {
            let t = f64::from(i);
            Vec2::new((1.7 * t).sin() * 1.8, (0.9 * t).cos().abs() * 1.5 - 0.3)
        });
        let near: Vec<(u32, f64, Vec2)> =
            points.enumerate().map(|(i, r)| (i as u32, 1.0 / (1.0 + r.norm()), r)).collect();
        let field = |r: Vec2| 2.0 + 0.5 * r.x - 3.0 * r.y + 4.0 * r.y * r.y;
        let value: f64 = weights(&near, 1).iter().map(|&(i, w)| w * field(near[i as usize].2)).sum();
        assert!((value - 2.0).abs() < 1e-12, "{value}");
    }
}
