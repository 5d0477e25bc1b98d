//! Continuum surface force [Huber2013, Eq. 20], after Brackbill et al. 1992 and Morris 2000.

use crate::math::Vec2;
use crate::sph::pairs::each;

/// F_a = σ κ_a n_a · ρ_a/ρ̄ in N/m³ [Huber2013, Eq. 20], ρ̄ = (ρ_w + ρ_n)/2 in kg/m³, σ in N/m.
///
/// The factor ρ_a/ρ̄ is 1 for equal densities and keeps the light phase from being thrown about otherwise
/// (Brackbill et al. 1992, section 3): the force across the interface is the same, its acceleration is uniform.
pub fn surface_force(
    (tension, mean_density): (f64, f64),
    kappa: &[f64],
    normal: &[Vec2],
    density: &[f64],
    force: &mut [Vec2],
) {
    each(force, |a| tension * kappa[a] * density[a] / mean_density * normal[a]);
}
