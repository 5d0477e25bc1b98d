//! Continuum surface force [Huber2013, Eq. 20], after Brackbill et al. 1992 and Morris 2000.

use crate::parallel::values;
use meniscus_core::math::Vec2;

/// F_a = σ κ_a n_a w_a in N/m³ [Huber2013, Eq. 20; Brackbill1992] with σ in N/m and weights w_a, 1 in the paper.
pub fn surface_force(tension: f64, kappa: &[f64], normal: &[Vec2], weight: &[f64]) -> Vec<Vec2> {
    values(weight.len(), |a| tension * kappa[a] * weight[a] * normal[a])
}
