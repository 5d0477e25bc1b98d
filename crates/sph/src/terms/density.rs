//! Density and volume of a particle [Huber2013, Eq. 17], after Hu & Adams 2006.

use crate::pairs::Pairs;
use crate::parallel::values;

/// V_a = 1/Σ_b W_ab in m², including the particle itself, so that ρ_a = m_a Σ_b W_ab [Huber2013, Eq. 17; HuAdams2006].
pub fn volume(pairs: &Pairs, count: usize) -> Vec<f64> {
    values(count, |a| 1.0 / (pairs.w_self + pairs.of(a).map(|ab| ab.w).sum::<f64>()))
}
