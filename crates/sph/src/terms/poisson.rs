//! Coefficients of the pressure Poisson equation [Huber2013, Eq. 30].

use crate::pairs::Pair;

/// Coefficient A_ab ≥ 0 of the pressure equation in m³/kg per depth, symmetric in a and b [Huber2013, Eq. 30; Cummins1999]. A_ab = −V_a V_b 4/(ρ_a + ρ_b)
/// r_ab·∇_a W_ab/(|r_ab|² + ζ²). Eq. (30) times −V_a is then Σ_b A_ab (p_a − p_b): a symmetric matrix with non-negative eigenvalues.
#[inline]
pub(crate) fn coefficient(volumes: f64, densities: f64, ab: &Pair) -> f64 {
    -volumes * 4.0 / densities * ab.slope
}
