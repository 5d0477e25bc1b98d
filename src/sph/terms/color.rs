//! The color function and its gradient, the normal of the interface [Huber2013, Eq. 18].

use crate::math::Vec2;
use crate::sph::pairs::{Pairs, each};

/// ĉ_a = Σ_b V_b c_b W_ab / Σ_b V_b W_ab over fluid, the particle itself included (Shepard average).
///
/// Smoothing once before the gradient brings the curvature's error down; the paper is silent on it.
pub fn smoothed_color(pairs: &Pairs, fluid_volume: &[f64], color: &[f64], smoothed: &mut [f64]) {
    each(smoothed, |a| {
        let own = fluid_volume[a] * pairs.w_self;
        let (sum, norm) = pairs.of(a).fold((own * color[a], own), |(sum, norm), ab| {
            let weight = fluid_volume[ab.b] * ab.w;
            (sum + weight * color[ab.b], norm + weight)
        });
        if norm > 0.0 { sum / norm } else { color[a] }
    });
}

/// n_a = (1/\[c\]) Σ_b V_b (c_b − c_a) ∇_a W_ab in 1/m, \[c\] = 1, over fluid [Huber2013, Eq. 18]. Points into the wetting phase.
pub fn color_gradient(pairs: &Pairs, fluid_volume: &[f64], color: &[f64], normal: &mut [Vec2]) {
    pairs.sum_into(normal, |a, ab| fluid_volume[ab.b] * (color[ab.b] - color[a]) * ab.grad_w);
}
