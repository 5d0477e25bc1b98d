//! Acceleration by the pressure gradient: the form of the paper, and forms for larger density ratios.

use crate::pairs::Pairs;
use meniscus_core::math::Vec2;

/// Moment below which a particle has too few neighbors to divide by it.
const SMALLEST_MOMENT: f64 = 0.5;

/// −(∇p/ρ)_a = −Σ_b m_b (p_a + p_b)/(ρ_a ρ_b) ∇_a W_ab in m/s² [Huber2013, Eq. 15], after Morris 2000. Conserves momentum; the constant in p matters, since it
/// orders the particles. Up to density ratios of about 5.
pub fn symmetric(pairs: &Pairs, volume: &[f64], density: &[f64], pressure: &[f64], count: usize) -> Vec<Vec2> {
    pairs.sums(count, |a, ab| -volume[ab.b] * (pressure[a] + pressure[ab.b]) / density[a] * ab.grad_w)
}

/// −(1/m_a) Σ_b (V_a² + V_b²) (ρ_b p_a + ρ_a p_b)/(ρ_a + ρ_b) ∇_a W_ab in m/s² [HuAdams2006, Eqs. 25, 29]. Conserves momentum and is continuous in ∇p/ρ across
/// the interface; the constant in p orders the particles as in [`symmetric`], to which it reduces for equal densities and volumes.
pub(crate) fn weighted(pairs: &Pairs, volume: &[f64], density: &[f64], pressure: &[f64], count: usize) -> Vec<Vec2> {
    pairs.sums(count, |a, ab| {
        let b = ab.b;
        let between = (density[b] * pressure[a] + density[a] * pressure[b]) / (density[a] + density[b]);
        let volumes = volume[a] * volume[a] + volume[b] * volume[b];
        -volumes * between / (density[a] * volume[a]) * ab.grad_w
    })
}

/// −Σ_b V_b 2 (p_b − p_a − `rise`)/(ρ_a + ρ_b) ∇_a W_ab in m/s², with the pressure jump at the interface in `rise` \[Fedkiw1999; Kang2000\].
///
/// The gradient whose Laplacian is Eq. (30). Continuous in ∇p/ρ across the interface, so valid at any density ratio; independent of the constant in p, while
/// momentum is conserved only as far as the particles are ordered. `rise(a, b)` = p_b − p_a in Pa in a fluid at rest.
pub fn difference(
    pairs: &Pairs,
    volume: &[f64],
    density: &[f64],
    pressure: &[f64],
    rise: impl Fn(usize, usize) -> f64 + Sync,
    count: usize,
) -> Vec<Vec2> {
    pairs.sums(count, |a, ab| {
        let b = ab.b;
        -volume[b] * 2.0 * (pressure[b] - pressure[a] - rise(a, b)) / (density[a] + density[b]) * ab.grad_w
    })
}

/// −½ Σ_b V_b r_ab·∇_a W_ab, 1 on the lattice and slightly less for disordered particles. `r_ab(a, b)` in m.
pub fn moment(pairs: &Pairs, volume: &[f64], r_ab: impl Fn(usize, usize) -> Vec2 + Sync, count: usize) -> Vec<f64> {
    pairs.sums(count, |a, ab| -0.5 * volume[ab.b] * r_ab(a, ab.b).dot(&ab.grad_w))
}

/// Divides the result of [`difference`] by the [`moment`] of its sums. Divergence, gradient and the Laplacian of Eq. (30) all have this factor. With the factor
/// removed from the gradient, the divergence of the gradient is the Laplacian, averaged over directions. A particle with few neighbors is not corrected.
pub fn correct_gradient(moment: &[f64], acceleration: &mut [Vec2]) {
    for (acceleration, &moment) in acceleration.iter_mut().zip(moment) {
        if moment > SMALLEST_MOMENT {
            *acceleration /= moment;
        }
    }
}

/// −∇φ/ρ of a potential φ without jumps, by [`difference`]: a displacement in m down the gradient for φ in kg/m.
pub(crate) fn descent(pairs: &Pairs, volume: &[f64], density: &[f64], potential: &[f64], count: usize) -> Vec<Vec2> {
    difference(pairs, volume, density, potential, |_, _| 0.0, count)
}

/// −2 (p_0/ρ_0) Σ_b V_b ∇_a W_ab in m/s²: the effect of a background pressure p_0 in [`symmetric`], as an acceleration
/// that is the same for light and heavy particles. `pressure_over_density` = p_0/ρ_0 in m²/s².
pub(crate) fn background(pairs: &Pairs, volume: &[f64], pressure_over_density: f64, count: usize) -> Vec<Vec2> {
    pairs.sums(count, |_, ab| -2.0 * pressure_over_density * volume[ab.b] * ab.grad_w)
}
