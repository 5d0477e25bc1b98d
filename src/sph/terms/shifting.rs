//! Particle shifting: particles drift from crowded to empty places, their velocity is carried along.
//!
//! After Xu et al. 2009 and Lind et al. 2012, with the coefficient of Skillen et al. 2013, which is independent of Δt.

use crate::math::Vec2;
use crate::sph::pairs::{Pairs, each};

/// Where the color gradient exceeds this, in units of 1/h, particles are shifted along the interface only.
const INTERFACE: f64 = 0.05;

/// A particle is shifted by at most this share of h per step.
const LARGEST_SHIFT: f64 = 0.1;

/// δr_a = −`diffusion` ∇C_a, ∇C_a = Σ_b V_b ∇_a W_ab, at most 0.1 h. `diffusion` in m², `h` and the result in m.
pub fn shift(pairs: &Pairs, volume: &[f64], diffusion: f64, h: f64, shift: &mut [Vec2]) {
    each(shift, |a| {
        let concentration: Vec2 = pairs.of(a).map(|ab| volume[ab.b] * ab.grad_w).sum();
        let by = -diffusion * concentration;
        by * (LARGEST_SHIFT * h / by.norm()).min(1.0)
    });
}

/// δv_a = δr_a·∇v_a = Σ_b 2ρ_b/(ρ_a + ρ_b) V_b (v_b − v_a) (∇_a W_ab·δr_a) in m/s: the velocity at the shifted place [Lind2012, Eq. 26].
///
/// Beside a light fluid a heavy one takes hardly any of its velocity, as it takes no momentum from it; in one fluid the weight is 1.
pub fn carried_velocity(
    pairs: &Pairs,
    (volume, density): (&[f64], &[f64]),
    velocity: &[Vec2],
    shift: &[Vec2],
    change: &mut [Vec2],
) {
    pairs.sum_into(change, |a, ab| {
        let b = ab.b;
        let weight = 2.0 * density[b] / (density[a] + density[b]);
        weight * volume[b] * ab.grad_w.dot(&shift[a]) * (velocity[b] - velocity[a])
    });
}

/// Takes the part across the interface out of `shift` (m), so that the interface keeps its place and shape; `normal` is
/// the color gradient in 1/m, `h` in m (method: Lind et al. 2012 at a free surface).
pub fn keep_along(normal: &[Vec2], h: f64, shift: &mut [Vec2]) {
    for (by, n) in shift.iter_mut().zip(normal) {
        if n.norm() > INTERFACE / h {
            *by -= by.dot(n) / n.norm_squared() * n;
        }
    }
}
