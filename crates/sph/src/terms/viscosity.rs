//! Viscous acceleration: the form of the paper (Szewc et al. 2012) and that of Morris et al. 1997.

use crate::pairs::{Pair, Pairs};
use crate::parallel::values;
use meniscus_core::math::Vec2;

/// Fields of the viscous sums; slices over particles and images.
pub struct Viscous<'a> {
    /// Volume V in m².
    pub volume: &'a [f64],
    /// Density ρ in kg/m³.
    pub density: &'a [f64],
    /// Dynamic viscosity μ in Pa s; 0 on walls, which have that of the fluid particle in each pair.
    pub viscosity: &'a [f64],
}

impl Viscous<'_> {
    /// Viscous acceleration in m/s² with the harmonic mean μ_ab of the viscosities [Morris1997, Eq. 22].
    ///
    /// (1/ρ_a) Σ_b V_b 2 μ_ab v_ab (r_ab·∇_a W_ab)/(|r_ab|² + ζ²), with the velocity difference `v_ab(a, b)` in m/s. Conserves momentum.
    pub fn morris(&self, pairs: &Pairs, v_ab: impl Fn(usize, usize) -> Vec2 + Sync, count: usize) -> Vec<Vec2> {
        values(count, |a| pairs.of(a).map(|ab| self.friction(a, &ab) * v_ab(a, ab.b)).sum::<Vec2>() / self.density[a])
    }

    /// Viscous acceleration of the paper in m/s² [Huber2013, Eq. 16; Szewc2012]. Σ_b 8 m_b (η_a + η_b)/(ρ_a + ρ_b) (v_ab·r_ab)/(|r_ab|² + ζ²) ∇_a W_ab with η =
    /// μ/ρ. r_ab and ∇_a W_ab are parallel, so that (v_ab·r_ab)/(|r_ab|² + ζ²) is (v_ab·∇_a W_ab) over |∇_a W_ab|², times the slope.
    pub fn szewc(&self, pairs: &Pairs, v_ab: impl Fn(usize, usize) -> Vec2 + Sync, count: usize) -> Vec<Vec2> {
        pairs.sums(count, |a, ab| {
            let b = ab.b;
            let (rho_a, rho_b) = (self.density[a], self.density[b]);
            let m_b = rho_b * self.volume[b];
            let steepness = ab.grad_w.norm_squared();
            // Coincident particles have no direction, and their force vanishes.
            let along = if steepness > 0.0 { v_ab(a, b).dot(&ab.grad_w) * ab.slope / steepness } else { 0.0 };
            8.0 * m_b * self.both_kinematic(a, b) / (rho_a + rho_b) * along * ab.grad_w
        })
    }

    /// −V_a V_b 2 μ_ab r_ab·∇_a W_ab/(|r_ab|² + ζ²) in Pa s, never below 0: the factor of v_ab in the force of b on a in Morris's form. Symmetric in a and b.
    #[inline]
    pub(crate) fn coupling(&self, a: usize, ab: &Pair) -> f64 {
        -self.volume[a] * self.friction(a, ab)
    }

    /// The coupling in Szewc's form, for the component of v_ab along the line of centers.
    #[inline]
    pub(crate) fn central_coupling(&self, a: usize, ab: &Pair) -> f64 {
        let b = ab.b;
        let (rho_a, rho_b) = (self.density[a], self.density[b]);
        let masses = rho_a * self.volume[a] * rho_b * self.volume[b];
        -8.0 * masses * self.both_kinematic(a, b) / (rho_a + rho_b) * ab.slope
    }

    /// η_a + η_b in m²/s; η_b = η_a on walls.
    #[inline]
    fn both_kinematic(&self, a: usize, b: usize) -> f64 {
        let eta_a = self.viscosity[a] / self.density[a];
        eta_a + if self.viscosity[b] > 0.0 { self.viscosity[b] / self.density[b] } else { eta_a }
    }

    /// λ_a = Σ_b |coefficient of v_ab| in 1/s of Morris's form: an explicit step with Δt λ_a ≤ 1 for all a is stable.
    ///
    /// Gershgorin: the eigenvalues of the viscous operator lie in [−2 max λ, 0], and explicit Euler needs Δt·2 max λ ≤ 2.
    /// `stretch(a, b)` is |v_ab| over the velocity difference where a wall extrapolates it, else 1.
    pub(crate) fn rate(&self, pairs: &Pairs, stretch: impl Fn(usize, usize) -> f64 + Sync, count: usize) -> Vec<f64> {
        values(count, |a| {
            -pairs.of(a).map(|ab| self.friction(a, &ab) * stretch(a, ab.b)).sum::<f64>() / self.density[a]
        })
    }

    /// 2 V_b μ_ab r_ab·∇_a W_ab/(|r_ab|² + ζ²) in kg/(m³ s), never above 0: the factor of v_ab in Morris's form.
    #[inline]
    fn friction(&self, a: usize, ab: &Pair) -> f64 {
        2.0 * self.mean_viscosity(a, ab.b) * self.volume[ab.b] * ab.slope
    }

    /// μ_ab = 2 μ_a μ_b/(μ_a + μ_b) in Pa s, which keeps the shear stress continuous across a viscosity step; μ_a at walls.
    #[inline]
    fn mean_viscosity(&self, a: usize, b: usize) -> f64 {
        let (mu_a, mu_b) = (self.viscosity[a], self.viscosity[b]);
        // Most neighbors are of the same fluid, and a division costs as much as all the rest.
        if mu_b == mu_a || mu_b == 0.0 { mu_a } else { 2.0 * mu_a * mu_b / (mu_a + mu_b) }
    }
}
