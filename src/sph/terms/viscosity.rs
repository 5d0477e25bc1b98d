//! Viscous acceleration: the paper's form (Szewc et al. 2012) and that of Morris et al. 1997.

use crate::math::Vec2;
use crate::sph::pairs::{Pair, Pairs, each};

/// What the viscous sums need of the particles; slices over particles and images.
pub struct Viscous<'a> {
    /// Volume V in m².
    pub volume: &'a [f64],
    /// Density ρ in kg/m³.
    pub density: &'a [f64],
    /// Dynamic viscosity μ in Pa s; 0 on walls, which take that of the fluid particle that sees them.
    pub viscosity: &'a [f64],
    /// Length ζ = 0.01 h in m that keeps denominators above zero [Huber2013, Eq. 16].
    pub zeta: f64,
}

impl Viscous<'_> {
    /// r_ab·∇_a W_ab/(|r_ab|² + ζ²) in 1/m⁴, negative.
    fn slope(&self, r_ab: Vec2, ab: &Pair) -> f64 {
        r_ab.dot(&ab.grad_w) / (r_ab.norm_squared() + self.zeta * self.zeta)
    }

    /// (1/ρ_a) Σ_b V_b 2 μ_ab v_ab (r_ab·∇_a W_ab)/(|r_ab|² + ζ²), μ_ab the harmonic mean [Morris1997, Eq. 22].
    ///
    /// `v_ab(a, b)` in m/s is the velocity difference and `r_ab(a, b)` in m the separation. Keeps momentum.
    pub fn morris(
        &self,
        pairs: &Pairs,
        r_ab: impl Fn(usize, usize) -> Vec2 + Sync,
        v_ab: impl Fn(usize, usize) -> Vec2 + Sync,
        acceleration: &mut [Vec2],
    ) {
        pairs.sum_into(acceleration, |a, ab| {
            let mu = self.mean_viscosity(a, ab.b);
            let slope = self.slope(r_ab(a, ab.b), ab);
            2.0 * mu * self.volume[ab.b] * slope / self.density[a] * v_ab(a, ab.b)
        });
    }

    /// Σ_b 8 m_b (η_a + η_b)/(ρ_a + ρ_b) (v_ab·r_ab)/(|r_ab|² + ζ²) ∇_a W_ab with η = μ/ρ [Huber2013, Eq. 16].
    pub fn szewc(
        &self,
        pairs: &Pairs,
        r_ab: impl Fn(usize, usize) -> Vec2 + Sync,
        v_ab: impl Fn(usize, usize) -> Vec2 + Sync,
        acceleration: &mut [Vec2],
    ) {
        pairs.sum_into(acceleration, |a, ab| {
            let b = ab.b;
            let (rho_a, rho_b) = (self.density[a], self.density[b]);
            let eta_a = self.viscosity[a] / rho_a;
            let eta_b = if self.viscosity[b] > 0.0 { self.viscosity[b] / rho_b } else { eta_a };
            let m_b = rho_b * self.volume[b];
            let r = r_ab(a, b);
            let along = v_ab(a, b).dot(&r) / (r.norm_squared() + self.zeta * self.zeta);
            8.0 * m_b * (eta_a + eta_b) / (rho_a + rho_b) * along * ab.grad_w
        });
    }

    /// λ_a = Σ_b |coefficient of v_ab| in 1/s of Morris's form: an explicit step with Δt λ_a ≤ 1 for all a is stable.
    ///
    /// Gershgorin: the eigenvalues of the viscous operator lie in [−2 max λ, 0], and explicit Euler needs Δt·2 max λ ≤ 2.
    /// `stretch(a, b)` is |v_ab| over the velocity difference where a wall extrapolates it, else 1.
    pub fn rate(
        &self,
        pairs: &Pairs,
        r_ab: impl Fn(usize, usize) -> Vec2 + Sync,
        stretch: impl Fn(usize, usize) -> f64 + Sync,
        rate: &mut [f64],
    ) {
        each(rate, |a| {
            let sum: f64 = pairs
                .of(a)
                .map(|ab| {
                    let slope = self.slope(r_ab(a, ab.b), &ab);
                    -2.0 * self.mean_viscosity(a, ab.b) * self.volume[ab.b] * slope * stretch(a, ab.b)
                })
                .sum();
            sum / self.density[a]
        });
    }

    fn mean_viscosity(&self, a: usize, b: usize) -> f64 {
        let (mu_a, mu_b) = (self.viscosity[a], self.viscosity[b]);
        if mu_b > 0.0 { 2.0 * mu_a * mu_b / (mu_a + mu_b) } else { mu_a }
    }
}
