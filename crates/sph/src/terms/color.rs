//! The color function and its gradient, the normal of the interface [Huber2013, Eq. 18].

use crate::pairs::Pairs;
use crate::parallel::values;
use crate::terms::average;
use meniscus_core::math::{Mat2, Vec2};

/// Determinant of the moment matrix, 1 inside the fluid and about 1/4 in a right corner, below which its inverse is unreliable.
const SMALLEST_DETERMINANT: f64 = 0.05;

/// ĉ_a = Σ_b V_b c_b W_ab / Σ_b V_b W_ab over fluid, including the particle itself (Shepard average). Smoothing once before the gradient reduces the error of
/// the curvature; the paper does not mention it. Particles that are not `mixed`, with only one color in reach, keep theirs.
pub fn smoothed_color(pairs: &Pairs, fluid_volume: &[f64], color: &[f64], mixed: &[bool]) -> Vec<f64> {
    values(mixed.len(), |a| if mixed[a] { average::over_fluid(a, pairs, fluid_volume, color) } else { color[a] })
}

/// n_a = (1/\[c\]) Σ_b V_b (c_b − c_a) ∇_a W_ab in 1/m, \[c\] = 1, over fluid [Huber2013, Eq. 18]. Points into the wetting phase.
pub fn color_gradient(pairs: &Pairs, fluid_volume: &[f64], color: &[f64], count: usize) -> Vec<Vec2> {
    pairs.sums(count, |a, ab| fluid_volume[ab.b] * (color[ab.b] - color[a]) * ab.grad_w)
}

/// The color gradient made exact for linear fields \[Bonet1999\]: g_a = B_a Σ_b V_b (c_b − c_a) ∇_a W_ab in 1/m over fluid. B_a is the inverse of −Σ_b V_b r_ab
/// ⊗ ∇_a W_ab; where that is nearly singular the gradient is not corrected. `r_ab(a, b)` in m. Zero if a particle is not `near` the interface.
pub(crate) fn consistent_gradient(
    pairs: &Pairs,
    fluid_volume: &[f64],
    near: &[bool],
    color: &[f64],
    r_ab: impl Fn(usize, usize) -> Vec2 + Sync,
) -> Vec<Vec2> {
    values(near.len(), |a| {
        if !near[a] {
            return Vec2::zeros();
        }
        let plain: Vec2 = pairs.of(a).map(|ab| fluid_volume[ab.b] * (color[ab.b] - color[a]) * ab.grad_w).sum();
        let moment: Mat2 = pairs.of(a).map(|ab| -fluid_volume[ab.b] * ab.grad_w * r_ab(a, ab.b).transpose()).sum();
        let is_regular = moment.determinant() > SMALLEST_DETERMINANT;
        moment.try_inverse().filter(|_| is_regular).map_or(plain, |inverse| inverse * plain)
    })
}
