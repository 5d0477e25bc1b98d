//! Divergence of the intermediate velocity [Huber2013, Eq. 31].

use crate::pairs::Pairs;
use meniscus_core::math::Vec2;

/// (∇·v)_a = Σ_b V_b (v_b − v_a)·∇_a W_ab in 1/s, Δt times the right side of the pressure equation [Huber2013, Eq. 31].
pub fn divergence(pairs: &Pairs, volume: &[f64], velocity: &[Vec2], count: usize) -> Vec<f64> {
    pairs.sums(count, |a, ab| volume[ab.b] * (velocity[ab.b] - velocity[a]).dot(&ab.grad_w))
}
