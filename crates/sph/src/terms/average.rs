//! Averages of a field over the fluid around a particle.

use std::ops::{Add, Div, Mul};

use crate::pairs::Pairs;

/// ⟨f⟩_a = Σ_b V_b f_b W_ab / Σ_b V_b W_ab over fluid, including the particle itself (Shepard); f_a where no fluid is near.
///
/// `fluid_volume` in m², 0 on walls; both `fluid_volume` and `field` over particles and images.
pub(crate) fn over_fluid<T>(a: usize, pairs: &Pairs, fluid_volume: &[f64], field: &[T]) -> T
where
    T: Copy + Add<Output = T> + Mul<f64, Output = T> + Div<f64, Output = T>,
{
    let own = fluid_volume[a] * pairs.w_self;
    let (sum, norm) = pairs.of(a).fold((field[a] * own, own), |(sum, norm), ab| {
        let weight = fluid_volume[ab.b] * ab.w;
        (sum + field[ab.b] * weight, norm + weight)
    });
    if norm > 0.0 { sum / norm } else { field[a] }
}
