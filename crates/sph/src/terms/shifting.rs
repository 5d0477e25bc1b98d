//! Particle shifting: particles drift from dense to sparse regions and away from close neighbors, with the velocity corrected accordingly.
//!
//! After Xu et al. 2009 and Lind et al. 2012, with the coefficient of Skillen et al. 2013, which is independent of Δt.

use crate::images::Images;
use crate::pairs::Pairs;
use crate::parallel::{each, values};
use crate::terms::average;
use meniscus_core::math::Vec2;

/// Where the color gradient exceeds this, in units of 1/h, particles are shifted down the concentration along the interface only.
const INTERFACE: f64 = 0.05;

/// A particle is shifted by at most this fraction of h per step.
const LARGEST_SHIFT: f64 = 0.1;

/// ∇C_a = Σ_b V_b ∇_a W_ab in 1/m, which points to denser regions \[Lind2012\].
pub(crate) fn concentration_gradient(pairs: &Pairs, volume: &[f64], count: usize) -> Vec<Vec2> {
    pairs.sums(count, |_, ab| volume[ab.b] * ab.grad_w)
}

/// Removes the component of a concentration gradient normal to the interface, as at a free surface \[Lind2012\]. The interface then keeps its position and
/// shape. `normal` is the color gradient in 1/m, `h` in m.
pub fn keep_along(normal: &[Vec2], h: f64, gradient: &mut [Vec2]) {
    for (gradient, n) in gradient.iter_mut().zip(normal) {
        if n.norm() > INTERFACE / h {
            *gradient -= gradient.dot(n) / n.norm_squared() * n;
        }
    }
}

/// s_a = R Σ_b (W_ab/W(dx))⁴ V_b ∇_a W_ab in 1/m, which grows steeply at distances below dx \[Monaghan2000; Lind2012\]. ∇C can vanish for particles clustered
/// in pairs or rows; this sum does not. `w_of_spacing` = W(dx) in 1/m².
pub fn anti_clustering(pairs: &Pairs, volume: &[f64], strength: f64, w_of_spacing: f64, count: usize) -> Vec<Vec2> {
    pairs.sums(count, |_, ab| strength * (ab.w / w_of_spacing).powi(4) * volume[ab.b] * ab.grad_w)
}

/// The anti-clustering force s_a \[Monaghan2000\] less its average over the surrounding fluid. The rest separates neighbors without collective displacement.
///
/// The mean of these short-range forces drives particles from strained regions to regions at rest. The pressure would have to return the fluid by
/// a spurious flow, also through interfaces. `fluid_volume` in m², 0 on walls, over particles and images.
pub fn take_out_mean(pairs: &Pairs, images: &Images, fluid_volume: &[f64], push: &mut [Vec2]) {
    let all = images.reflected_field(push.to_vec());
    each(push, |a| all[a] - average::over_fluid(a, pairs, fluid_volume, &all));
}

/// δr_a = −`diffusion` ∇C_a, at most 0.1 h \[Lind2012; Skillen2013\]. `shifting_vector` is ∇C with the anti-clustering force in 1/m, `diffusion` in m², `h` and
/// result in m.
pub(crate) fn shift(shifting_vector: &[Vec2], diffusion: f64, h: f64) -> Vec<Vec2> {
    values(shifting_vector.len(), |a| {
        let by = -diffusion * shifting_vector[a];
        by * (LARGEST_SHIFT * h / by.norm()).min(1.0)
    })
}

/// δv_a = δr_a·∇v_a = Σ_b 2ρ_b/(ρ_a + ρ_b) V_b (v_b − v_a) (∇_a W_ab·δr_a) in m/s: for the velocity at the shifted position [Lind2012, Eq. 26]. By the weight a
/// heavy fluid takes hardly any velocity from a light one next to it, as little as momentum; within one fluid it is 1.
pub fn carried_velocity(
    pairs: &Pairs,
    volume: &[f64],
    density: &[f64],
    velocity: &[Vec2],
    shift: &[Vec2],
) -> Vec<Vec2> {
    pairs.sums(shift.len(), |a, ab| {
        let b = ab.b;
        let weight = 2.0 * density[b] / (density[a] + density[b]);
        weight * volume[b] * ab.grad_w.dot(&shift[a]) * (velocity[b] - velocity[a])
    })
}
